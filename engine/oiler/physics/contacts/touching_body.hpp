// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "oiler/physics/contacts/near.hpp"
#include "oiler/physics/contacts/support.hpp"

namespace oiler {

/// A body at an instant of a step, and the obstacles near it: which of them it touches, and which
/// of those bear it.
template <std::floating_point T, int Axes, class Body>
class TouchingBody {
public:
    using Near = oiler::Near<T, Axes>;
    using Vec = oiler::Vec<T, Axes>;
    using State = oiler::State<T, Axes>;
    using Support = oiler::Support<T, Axes>;

protected:
    TouchingBody(std::span<Near> nears, T radius, Body& body)
        : nears_(nears), radius_(radius), body_(body) {
        for (const Near& near : nears) {
            any_renewed_ |= near.obstacle.bounded || near.is_moved();
            any_moves_ |= near.moves;
            any_moved_ |= near.is_moved();
        }
    }

    /// Begins a step of `duration` s.
    void begin(const State& state, T duration) {
        duration_ = left_ = duration;
        const T speed = largest(body_.accelerate(state, T(0))) * duration;
        T fastest = 0;
        for (const Near& near : nears_)
            if (near.moves) fastest = std::max(fastest, near.obstacle.course.most_speed(duration));
        hidden_ = {8 * epsilon * (speed + 2 * fastest), 8 * epsilon * speed * duration};
    }

    static constexpr T epsilon = std::numeric_limits<T>::epsilon();

    [[nodiscard]] T gap_noise(const Near& near, const State& state) const {
        if (!any_renewed_)
            return hidden_distance(near.obstacle.surface, state, radius_, duration_) +
                   hidden_.distance;
        return hidden_distance(near.obstacle, state, radius_, duration_) + hidden_.distance;
    }
    [[nodiscard]] T speed_noise(const State& state) const {
        return hidden_speed(state.v) + hidden_.speed;
    }
    [[nodiscard]] T gap_of(const Near& near, const Vec& x) const { return gap_at(near, x, T(0)); }
    /// The gap `tau` s from now.
    [[nodiscard]] T gap_at(const Near& near, const Vec& x, T tau) const {
        if (!any_renewed_) return gap(near.obstacle.surface, x, radius_);
        return gap(near, x, start_ + tau, radius_);
    }
    /// The gap `tau` s from now of a body that was at `from` and touched an obstacle there: below
    /// its surface there if it got past the middle.
    [[nodiscard]] T gap_on_side(const Near& near, const Vec& from, const Vec& x, T tau) const {
        const auto& obstacle = near.obstacle;
        const T then = start_ + tau;
        if (dot(near.normal, normal(obstacle, place_beside(obstacle, x, then))) >= 0)
            return gap_at(near, x, tau);
        const Vec way = obstacle.course.way(then) - obstacle.course.way(start_);
        return dot(near.normal, x - from - way);
    }
    [[nodiscard]] static T leaving(const Near& near, const Vec& v) {
        return leaving_speed(near, v - near.velocity);
    }
    [[nodiscard]] bool touches(const Near& near, const State& state) const {
        const T gap = gap_of(near, state.x);
        const T noise = gap_noise(near, state);
        if (gap > noise || near.hidden || near.passed) return false;
        if (gap < -near.deepest(2 * noise, radius_)) return false;
        return !near.obstacle.is_one_way() || bears_from(near.obstacle, near.normal);
    }
    [[nodiscard]] std::size_t index_of(const Near& near) const {
        return static_cast<std::size_t>(&near - nears_.data());
    }
    [[nodiscard]] static const Near& near_of(const Support& support, std::size_t i = 0) {
        return static_cast<const Near&>(support[i]);
    }
    [[nodiscard]] Vec place(const Near& near, const Vec& x) const {
        return place_beside(near.obstacle, x, start_);
    }

    /// Renews the touches of boxes and moving obstacles where the body is.
    void renew(const State& state) {
        if (!any_renewed_) return;
        for (Near& near : nears_) {
            renew_normal(near, state.x, start_);
            if (near.obstacle.bounded)
                renew_sides(near, place(near, state.x),
                            state.v - near.obstacle.course.velocity_at(start_),
                            gap_noise(near, state));
        }
        hide_joints(nears_, state.x, start_, radius_,
                    [&](const Near& near) { return touches(near, state); });
        for (Near& near : nears_) {
            near.inwards = -dot(near.normal, near.obstacle.course.acceleration_at(start_));
            if (near.obstacle.bounded)
                near.inwards +=
                    turning(near.obstacle, near.normal, near.sides,
                            state.v - near.obstacle.course.velocity_at(start_), radius_);
        }
    }

    /// The obstacles that bear a body under an acceleration, of those that it touches without
    /// leaving them, or leaves for flights that round-off hides.
    [[nodiscard]] Support bearing(const State& state, const Vec& a, const Near* without = nullptr,
                                  const Near* with = nullptr) {
        bool any_left = false;
        for (Near& near : nears_) {
            near.bears = near.leaves = false;
            if (!touches(near, state)) continue;
            near.leaves = leaving(near, state.v) > speed_noise(state);
            near.bears = !near.leaves;
            any_left |= near.leaves;
        }
        const auto bears = [](const Near& near) { return near.bears; };
        if (any_left) {
            const Vec pulled = Support::against(a, nears_, bears).without_push(a);
            for (Near& near : nears_)
                near.bears |= near.leaves && is_hidden_flight(near, state, pulled);
        }
        for (Near& near : nears_) near.bears = (near.bears && &near != without) || &near == with;
        if (const auto slipped = bearing_slips(state, a)) return *slipped;
        const auto support = Support::against(a, nears_, bears);
        const Vec dragged = drag(state, a);
        if (dragged == Vec{}) return support;
        const auto pressed = Support::against(a + dragged, nears_, bears);
        const bool drags_on = std::ranges::all_of(nears_, [&](const Near& near) {
            return !near.bears || !rubs(near, state, a) || pressed.has(near);
        });
        return drags_on || pressed.size() > support.size() ? pressed : support;
    }
    /// Which of several obstacles bear a body that slips along all of them: it is locked between
    /// all if no pushes with friction do. Null if there are not several, or too many.
    [[nodiscard]] std::optional<Support> bearing_slips(const State& state, const Vec& a) const {
        if (!any_moved_) return std::nullopt;
        Support all;
        for (const Near& near : nears_) {
            if (!near.bears) continue;
            const bool slips = largest(state.v - near.velocity) > speed_noise(state);
            if (all.size() == Axes || !slips) return std::nullopt;
            all.add(near);
        }
        if (all.size() < 2) return std::nullopt;
        const auto needed = [&](const TouchOf<T, Axes>& touch) {
            return -OfPull<T, Axes>{}(touch, a);
        };
        return all.bearing(state.v, needed).value_or(all);
    }
    /// Whether friction acts on the body where it slips along an obstacle that bears it.
    [[nodiscard]] bool rubs(const Near& near, const State& state, const Vec& a) const {
        return near.friction > 0 && touches(near, state) && -OfPull<T, Axes>{}(near, a) > 0 &&
               largest(state.v - near.velocity) > speed_noise(state);
    }
    /// The acceleration by friction, which may press the body into other obstacles, or off them,
    /// where one of them moves.
    [[nodiscard]] Vec drag(const State& state, const Vec& a) const {
        Vec sum{};
        if (!any_moved_) return sum;
        for (const Near& near : nears_) {
            if (!rubs(near, state, a)) continue;
            sum +=
                normalised(state.v - near.velocity) * (near.friction * OfPull<T, Axes>{}(near, a));
        }
        return sum;
    }
    /// The acceleration that presses a body onto the obstacles that bear it, `tau` s from now.
    [[nodiscard]] Vec pressing(const Support& support, const State& state, T tau = 0) const {
        const Vec a = body_.accelerate(state, start_ + tau);
        return support.size() > 1 ? a + drag(state, a) : a;
    }
    /// The height, m, that round-off hides, also that of many events in the step.
    [[nodiscard]] T hidden_height(const Near& near, const State& state) const {
        return gap_noise(near, state) * static_cast<T>(std::max(events_ / 64, 1));
    }
    /// Whether round-off hides the height of a flight off an obstacle under an acceleration.
    [[nodiscard]] bool is_hidden_flight(const Near& near, const State& state, const Vec& a) const {
        const T u = leaving(near, state.v);
        const T pull = -OfPull<T, Axes>{}(near, a);
        return pull > 0 && u * u <= 2 * pull * hidden_height(near, state);
    }
    [[nodiscard]] bool goes_into(const Near& near, const State& state) const {
        return -leaving(near, state.v) > speed_noise(state) && touches(near, state);
    }
    /// Whether the body goes into an obstacle that it touches and that does not bear it.
    [[nodiscard]] bool enters_other(const State& state, const Support& support) const {
        return std::any_of(nears_.begin(), nears_.end(), [&](const Near& near) {
            return !support.has(near) && goes_into(near, state);
        });
    }

    std::span<Near> nears_;
    T radius_;  ///< m
    Body& body_;
    bool any_renewed_ = false;
    bool any_moves_ = false;
    bool any_moved_ = false;  ///< also by a belt
    T duration_ = 0;          ///< s, of the step
    T start_ = 0;             ///< s, from the start of the step
    T left_ = 0;              ///< s
    int events_ = 0;          ///< in the step so far
    /// The speed and the distance that round-off hides in a step from rest.
    struct {
        T speed = 0;     ///< m/s
        T distance = 0;  ///< m
    } hidden_;
};

}  // namespace oiler
