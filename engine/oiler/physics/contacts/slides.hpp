// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "oiler/physics/contacts/friction.hpp"
#include "oiler/physics/contacts/pinned.hpp"
#include "oiler/physics/response.hpp"

namespace oiler {

/// The motions of a body on the obstacles that bear it: held by friction, along them, or round a
/// curve.
template <std::floating_point T, int Axes, class Body>
class Slides : public Pinned<T, Axes, Body> {
public:
    using Base = Pinned<T, Axes, Body>;
    using typename Base::Leg;
    using typename Base::Near;
    using typename Base::State;
    using typename Base::Support;
    using typename Base::Vec;

protected:
    using Base::Base;

    /// The velocity of a body that is at rest on the obstacles that bear it, `tau` s from now.
    [[nodiscard]] Vec carrier(const Support& support, T tau = 0) const {
        const Near& first = near_of(support);
        const Vec v = tau == 0 || !first.is_moved()
                          ? first.velocity
                          : surface_velocity(first.obstacle, first.normal, start_ + tau);
        return support.size() == 1 ? v : support.following(v);
    }
    /// Their way from now on, m.
    [[nodiscard]] Vec carried(const Support& support, T tau) const {
        const Near& first = near_of(support);
        if (support.size() > 1) return carrier(support) * tau;
        const Course<T, Axes>& course = first.obstacle.course;
        return course.way(start_ + tau) - course.way(start_) +
               belt_velocity(first.obstacle, first.normal) * tau;
    }
    /// An acceleration `tau` s from now, less what the obstacle's own has changed by since now. The
    /// touches of the support know the obstacle's acceleration of now.
    [[nodiscard]] Vec as_of_now(const Support& support, const Vec& a, T tau) const {
        const Course<T, Axes>& course = near_of(support).obstacle.course;
        if (tau == 0 || !any_moves_ || !course.accelerates()) return a;
        return a - (course.acceleration_at(start_ + tau) - course.acceleration_at(start_));
    }
    /// The acceleration of a body that is not held by friction, relative to the surface, m/s².
    [[nodiscard]] Vec pull_along(const Support& support, const Vec& a, T tau = 0) const {
        Vec pull = support.without_push(as_of_now(support, a, tau));
        const Near& first = near_of(support);
        const Course<T, Axes>& course = first.obstacle.course;
        if (any_moves_ && course.accelerates()) pull -= course.acceleration_at(start_);
        // A belt turns the body round a curve.
        const bool turns = first.obstacle.belt != 0 && support.size() == 1;
        return turns ? pull - first.normal * dot(first.normal, pull) : pull;
    }
    /// Grip minus the pull along the obstacles, m/s²; negative if friction does not hold the body.
    [[nodiscard]] T surplus_of_grip(const Support& support, const Vec& a, T tau = 0) const {
        return support.grip(as_of_now(support, a, tau)) + 4 * epsilon * largest(a) -
               length(pull_along(support, a, tau));
    }
    [[nodiscard]] bool sticks(const Support& support, const State& state, const Vec& a) const {
        return state.v == carrier(support) && surplus_of_grip(support, a) >= 0;
    }
    /// Holds a body at rest, or where its obstacle carries it, until the forces let it slide or
    /// take it off.
    [[nodiscard]] std::optional<Leg> stick(const State& state, const Support& support,
                                           const Vec& a) {
        const bool stays = stands(support);
        const auto move = [&](T tau) {
            return stays ? state : State{state.x + carried(support, tau), carrier(support, tau)};
        };
        Leg leg{move(left_), left_};
        if (any_renewed_) end_at_others(state, support, a, leg, move);
        if (near_of(support).obstacle.belt != 0) end_at_features(state, support, leg, move);
        if (!body_.forces_change() && !near_of(support).obstacle.course.accelerates()) {
            settled_ = stays && leg.tau == left_;
            return leg;
        }
        const auto held = [&](const State& there, T tau) {
            const Vec pull = pressing(support, there, tau);
            return std::min(surplus_of_grip(support, pull, tau),
                            least_reaction(support, pull, tau));
        };
        end_where_negative(held, std::max(held(state, T(0)), T(0)), leg, move);
        return leg;
    }

    /// Carries a body that is at rest on a belt round the curve of its obstacle, unless it slips at
    /// once.
    [[nodiscard]] std::optional<Leg> ride_curve(const State& state, const Near& near,
                                                const Support& support) {
        const T radius = near.obstacle.rounding + radius_;
        const T turn = near.obstacle.belt / radius;
        const Course<T, Axes>& course = near.obstacle.course;
        const auto surface = [&](const Vec& x, T tau) {
            const Vec out = normal(near.obstacle, place_beside(near.obstacle, x, start_ + tau));
            return std::pair{out, surface_velocity(near.obstacle, out, start_ + tau)};
        };
        const auto move = [&](T tau) {
            // The normal turns as clockwise as the belt runs.
            const Vec along = belt_velocity(near.obstacle, near.normal) / near.obstacle.belt;
            const Response<T> turned = oscillator_response(T(1), T(0), turn * tau);
            const Vec out = near.normal * turned.decay + along * turned.reach;
            const Vec way = course.way(start_ + tau) - course.way(start_);
            const Vec x = state.x + way + (out - near.normal) * radius;
            return State{x, surface(x, tau).second};
        };
        const T tau = std::min(left_, most_turn / std::abs(turn));
        Leg leg{move(tau), tau};
        const Vec a = body_.accelerate(state, start_);
        end_at_others(state, support, a, leg, move);
        end_at_features(state, support, leg, move);
        const auto held = [&](const State& at, T later) {
            const Vec out = surface(at.x, later).first;
            const Vec a_there =
                body_.accelerate(at, start_ + later) - course.acceleration_at(start_ + later);
            const T away = dot(out, a_there);
            const T reaction = -(away + turn * turn * radius);
            const T noise = 4 * epsilon * largest(a_there);
            return std::min(reaction,
                            near.friction * reaction + noise - length(a_there - out * away));
        };
        end_where_negative(held, std::max(held(state, T(0)), T(0)), leg, move);
        return leg.tau > epsilon * left_ ? std::optional(leg) : std::nullopt;
    }

    [[nodiscard]] T least_reaction(const Support& support, const Vec& a, T tau = 0) const {
        const Vec reaction = support.reactions(as_of_now(support, a, tau));
        return *std::min_element(reaction.axis.begin(),
                                 reaction.axis.begin() + static_cast<int>(support.size()));
    }
    /// Whether a pull turns a velocity.
    [[nodiscard]] static bool is_across(const Vec& v, const Vec& pull) {
        const T square = dot(pull, pull);
        if (!(square > 0)) return false;
        return largest(v - pull * (dot(v, pull) / square)) > 64 * epsilon * largest(v);
    }

    [[nodiscard]] std::optional<Leg> slide(const State& state, const Support& support,
                                           const Vec& a) {
        if (enters_other(state, support)) return std::nullopt;
        const Vec rest = carrier(support);
        const Vec v = state.v - rest;
        const Vec pull = pull_along(support, a);
        const Vec direction = normalised(v == Vec{} ? pull : v);
        const T grip = support.grip(a);
        const bool free_to_turn = grip > 0 && support.size() + 2 <= Axes;
        const Course<T, Axes>& course = near_of(support).obstacle.course;
        const Friction<T, Axes> friction{direction, rest, free_to_turn && is_across(v, pull),
                                         any_moves_ && course.accelerates() ? &course : nullptr,
                                         start_};
        const auto move = [&](T tau) {
            State end = body_.slide(state, start_, tau, support, friction);
            if (!stands(support)) stay_beside(support, state.x, tau, end);
            return end;
        };
        if (free_to_turn && v != Vec{} && dot(pull, pull) < grip * grip)
            if (const auto end = slide_end(v, pull, grip); end.time <= left_) {
                Leg leg{
                    {state.x + end.way + carried(support, end.time), carrier(support, end.time)},
                    end.time};
                end_at_others(state, support, a, leg, move);
                return leg;
            }
        Leg leg{move(left_), left_};
        end_at_others(state, support, a, leg, move);
        end_at_features(state, support, leg, move);
        const auto borne = [&](const State& at, T tau) {
            return least_reaction(support, body_.accelerate(at, start_ + tau), tau);
        };
        end_where_negative(borne, least_reaction(support, a), leg, move);
        const auto speed = [&](const State& at, T tau) {
            return dot(at.v - carrier(support, tau), direction);
        };
        if (grip > 0 && v != Vec{} && end_where_negative(speed, dot(v, direction), leg, move)) {
            const Vec end = carrier(support, leg.tau);
            leg.end.v -= direction * dot(leg.end.v - end, direction);
            if (largest(leg.end.v - end) <= 64 * epsilon * largest(v)) leg.end.v = end;
        }
        return leg;
    }

    /// Moves the end of a slide of `tau` s onto the moving obstacles, with their normal speeds.
    void stay_beside(const Support& support, const Vec& from, T tau, State& end) const {
        std::array<TouchOf<T, Axes>, Axes> there;
        for (std::size_t i = 0; i < support.size(); ++i) {
            const Near& near = near_of(support, i);
            there[i] = near;
            there[i].velocity = surface_velocity(near.obstacle, near.normal, start_ + tau);
        }
        const Support then = support.with(there);
        end = {then.onto(end.x,
                         [&](const TouchOf<T, Axes>& touch) {
                             const auto index = static_cast<std::size_t>(&touch - there.data());
                             return gap_on_side(near_of(support, index), from, end.x, tau);
                         }),
               then.following(end.v)};
    }
    /// One step of `tau` s on the curve of an obstacle: a push along its normal, of a size that
    /// lets a free step end on the curve, then the rest of the normal speed is taken away. This is
    /// RATTLE (Andersen, 1983) with any method for its free step, and has order min(order, 2).
    /// Friction may exceed its limit in each of both parts, because only their sum is positive, but
    /// not `most_braked` m/s, and keeps its sense in a step beyond the stop, so that the speed
    /// passes 0 there.
    [[nodiscard]] State hop(const State& state, const Near& near, T reaction, T most_braked,
                            T tau) {
        const Vec slip = normalised(state.v - near.velocity);
        const auto braked = [&](T push) {
            return std::clamp(near.friction * push, -most_braked, most_braked);
        };
        const auto pushed = [&](T push) {
            const Vec by = near.normal * push - slip * braked(push);
            return body_.fly({state.x, state.v + by}, start_, tau);
        };
        T push = reaction * tau / 2;
        State end = pushed(push);
        T gap = gap_at(near, end.x, tau);
        T slope = tau;
        for (int i = 0; i < 8 && std::abs(gap) > gap_noise(near, state) / 16; ++i) {
            const T next = push - gap / slope;
            end = pushed(next);
            const T gap_next = gap_at(near, end.x, tau);
            if (next == push || gap_next == gap) break;
            slope = (gap_next - gap) / (next - push);
            push = next;
            gap = gap_next;
        }
        Near there = near;
        there.normal = normal(near.obstacle, place_beside(near.obstacle, end.x, start_ + tau));
        there.velocity = surface_velocity(near.obstacle, there.normal, start_ + tau);
        const T last = -leaving(there, end.v);
        const Vec along = end.v + there.normal * last;
        const Vec slip_there = normalised(along - there.velocity);
        const T sense = dot(slip_there, slip) < 0 ? T(-1) : T(1);
        end.v = along - slip_there * (sense * braked(last));
        return end;
    }
    [[nodiscard]] std::optional<Leg> follow_curve(State& state, Near near, const Support& support,
                                                  const Vec& a) {
        if (enters_other(state, support)) return std::nullopt;
        const Vec pull = pull_along(support, a);
        if (state.v == near.velocity) state.v += normalised(pull) * speed_noise(state);
        const T reaction = support.reactions(a).axis[0];
        const T slip = length(state.v - near.velocity);
        // Friction that stops the body at once does so in a millionth of the time that is left, so
        // that its impulses are no round-off.
        const T most_braking = T(1 << 20) * slip / left_;
        const T braking = std::min(near.friction * reaction - length(pull), most_braking);
        if (braking == most_braking) near.friction = (braking + length(pull)) / reaction;
        const auto move = [&](T tau) {
            return hop(state, near, reaction, slip + length(pull) * tau, tau);
        };
        const T radius = near.obstacle.rounding + radius_;
        const T most = most_turn * radius / (slip + length(pull) * left_);
        // The curve bears nothing at a speed of √(reaction·radius): friction changes the speed by a
        // part of that.
        const T tau = braking > 0 ? std::min({left_, most, 4 * slip / braking,
                                              std::sqrt(reaction * radius) / (32 * braking)})
                                  : std::min(left_, most);
        Leg leg{move(tau), tau};
        end_at_others(state, support, a, leg, move);
        end_at_features(state, support, leg, move);
        const auto borne = [&](const State& at, T later) {
            const Vec normal =
                oiler::normal(near.obstacle, place_beside(near.obstacle, at.x, start_ + later));
            const Vec v = at.v - near.obstacle.course.velocity_at(start_ + later);
            const T turn = turning(near.obstacle, normal, near.sides, v, radius_);
            const Vec a_there = body_.accelerate(at, start_ + later) -
                                near.obstacle.course.acceleration_at(start_ + later);
            return -(dot(normal, a_there) + turn);
        };
        end_where_negative(borne, reaction, leg, move);
        const Vec direction = normalised(state.v - near.velocity);
        const auto surface = [&](const State& at, T later) {
            const Vec seen = place_beside(near.obstacle, at.x, start_ + later);
            return surface_velocity(near.obstacle, normal(near.obstacle, seen), start_ + later);
        };
        const auto forwards = [&](const State& at, T later) {
            return dot(at.v - surface(at, later), direction);
        };
        if (near.friction > 0 && slip > 4 * speed_noise(state) &&
            end_where_negative(forwards, slip, leg, move))
            leg.end.v = surface(leg.end, leg.tau);
        return leg;
    }

    using Base::any_moves_;
    using Base::any_renewed_;
    using Base::body_;
    using Base::end_at_features;
    using Base::end_at_others;
    using Base::end_where_negative;
    using Base::enters_other;
    using Base::epsilon;
    using Base::gap_at;
    using Base::gap_noise;
    using Base::gap_on_side;
    using Base::leaving;
    using Base::left_;
    using Base::most_turn;
    using Base::near_of;
    using Base::nears_;
    using Base::place;
    using Base::pressing;
    using Base::radius_;
    using Base::settled_;
    using Base::speed_noise;
    using Base::stands;
    using Base::start_;
    using Base::touches;
};

}  // namespace oiler
