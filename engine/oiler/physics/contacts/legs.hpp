// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "oiler/physics/contacts/crossing.hpp"
#include "oiler/physics/contacts/root.hpp"
#include "oiler/physics/contacts/touching_body.hpp"

namespace oiler {

/// The parts of a step of a body that meets obstacles, and the events that end them, which are
/// located with shorter steps: `move(tau)` returns the state after a part of `tau` s.
template <std::floating_point T, int Axes, class Body>
class Legs : public TouchingBody<T, Axes, Body> {
public:
    using Base = TouchingBody<T, Axes, Body>;
    using typename Base::Near;
    using typename Base::State;
    using typename Base::Support;
    using typename Base::Vec;

protected:
    using Base::Base;

    /// The first part of what is left of the step.
    struct Leg {
        State end;
        T tau;
    };

    /// Ends the leg where a function of state and time is first negative, if it is at the end.
    template <class F, class Move>
    static bool end_where_negative(F f, T at_start, Leg& leg, Move move) {
        const T at_end = f(leg.end, leg.tau);
        if (!(at_end < 0) || at_start < 0) return false;
        const auto at = [&](T tau) { return f(move(tau), tau); };
        leg.tau = narrow_bracket<T>(at, {0, leg.tau}, at_start, at_end, -1).after;
        leg.end = move(leg.tau);
        return true;
    }
    template <class Move>
    void end_at_impact(Near& near, const State& state, const Vec& a, Leg& leg, Move move) {
        const bool is_fixed_plane =
            !near.obstacle.bounded && !near.moves && !near.obstacle.is_one_way();
        const auto bracket =
            is_fixed_plane ? impact(near, state, leg, move) : entry(near, state, a, leg, move);
        if (!bracket) return;
        leg = {move(bracket->before), bracket->before};
    }

    /// The first entry into a box within a leg, if there is one.
    template <class Move>
    [[nodiscard]] std::optional<Bracket<T>> entry(Near& near, const State& state, const Vec& a,
                                                  const Leg& leg, Move move) const {
        if (!may_meet(near.obstacle, radius_, {place(near, state.x), state.v},
                      {place_beside(near.obstacle, leg.end.x, start_ + leg.tau), leg.end.v},
                      leg.tau))
            return std::nullopt;
        const T noise = gap_noise(near, state);
        const auto sample = [&](const State& at, T tau) {
            const Vec seen = place_beside(near.obstacle, at.x, start_ + tau);
            const T speed = dot(normal(near.obstacle, seen),
                                at.v - near.obstacle.course.velocity_at(start_ + tau));
            return GapAt<T>{tau, gap(near.obstacle, seen, radius_), speed};
        };
        GapAt<T> from = sample(state, T(0));
        // A point on the border of a face has turned to an open one.
        if (radius_ == 0)
            from.speed = dot(near.normal, state.v - near.obstacle.course.velocity_at(start_));
        GapAt<T> to = sample(leg.end, leg.tau);
        if (near.passed && from.gap > noise) near.passed = false;
        const bool is_inside = from.gap < -near.deepest(2 * noise, radius_);
        if (near.passed || is_inside) return std::nullopt;
        const auto goes_along = [&](const GapAt<T>& one) {
            return std::abs(one.gap) <= noise && std::abs(one.speed) <= speed_noise(state);
        };
        if (goes_along(from) && goes_along(to)) return std::nullopt;

        const Vec at_end = body_.accelerate(leg.end, start_ + leg.tau);
        const T most = std::max(length(a), length(at_end)) * (a == at_end ? T(1) : T(1.5)) +
                       most_turning(state, leg) + near.obstacle.course.most_acceleration(duration_);
        const auto at = [&](T tau) { return sample(move(tau), tau); };
        if (from.gap <= noise && from.speed > speed_noise(state))
            for (T tau = from.speed / (2 * most); from.gap <= noise && tau < leg.tau; tau *= 2)
                if (const auto clear = at(tau); clear.gap > noise) from = clear;
        // A body that does not leave an obstacle that it touches may be in it as far as round-off.
        // A point does not fall between two that are joined.
        const bool falls_as_point = radius_ == 0 && from.gap > noise;
        const T hidden = falls_as_point ? -noise / 2 : from.gap > noise ? T(0) : noise;
        const auto above = [&](T tau) {
            GapAt<T> one = at(tau);
            one.gap += hidden;
            return one;
        };
        from.gap += hidden;
        to.gap += hidden;
        const auto found =
            FirstCrossing(above, most, falls_as_point ? noise / 4 : noise).between(from, to);
        // The longer steps of a method of order 1 may enter what their own speeds leave.
        near.dips = found && hidden > 0 && at(found->before).speed >= 0;
        if (near.dips) return std::nullopt;
        if (!found || !near.obstacle.is_one_way()) return found;
        const Vec seen = place_beside(near.obstacle, move(found->before).x, start_ + found->before);
        near.passed = !bears_from(near.obstacle, normal(near.obstacle, seen));
        return near.passed ? std::nullopt : found;
    }

    /// The acceleration of a way along the curves that the body follows, m/s².
    [[nodiscard]] T most_turning(const State& start, const Leg& leg) const {
        T most = 0;
        const T speed = std::max(length(start.v), length(leg.end.v));
        for (const Near& near : nears_)
            if (near.bears && is_round(near.sides))
                most = std::max(most, speed * speed / (near.obstacle.rounding + radius_));
        return most;
    }

    /// The time of the first impact on a half-space within a leg, if there is one. A body that is
    /// above it at both ends may have been below it between them, where it turned.
    template <class Move>
    [[nodiscard]] std::optional<Bracket<T>> impact(const Near& near, const State& state,
                                                   const Leg& leg, Move move) const {
        const T noise = gap_noise(near, state);
        const auto height = [&](T tau) { return gap_at(near, move(tau).x, tau); };
        const T start = gap_of(near, state.x);
        const T end = gap_at(near, leg.end.x, leg.tau);
        const T u_start = leaving(near, state.v);
        const T u_end = leaving(near, leg.end.v);
        const auto turning_time = [&](T sign) {
            const auto speed = [&](T tau) { return sign * leaving(near, move(tau).v); };
            return narrow_bracket<T>(speed, {0, leg.tau}, sign * u_start, sign * u_end, -1).before;
        };
        const auto between = [&](T before, T h_before, T after, T h_after) {
            return narrow_bracket<T>(height, {before, after}, h_before, h_after, noise / 16);
        };
        if (end < 0) {
            if (start > noise) return between(0, start, leg.tau, end);
            // It moves along the surface.
            if (u_start <= speed_noise(state) && end >= -noise) return std::nullopt;
            const T turn = u_end < 0 ? turning_time(1) : leg.tau / 2;
            T top = turn;
            T h_top = height(top);
            while (h_top <= 0 && top > epsilon * leg.tau) h_top = height(top /= 2);
            if (h_top > 0) return between(top, h_top, leg.tau, end);
            // Round-off hides the height of the flight: it ends as long after its turn as it began.
            const T back = std::min(2 * turn, leg.tau);
            return Bracket<T>{back, back};
        }
        if (start <= noise || !may_dip(start, u_start, end, u_end, leg.tau)) return std::nullopt;
        const T lowest = turning_time(-1);
        const T h_lowest = height(lowest);
        if (h_lowest >= 0) return std::nullopt;
        return between(0, start, lowest, h_lowest);
    }

    using Base::body_;
    using Base::duration_;
    using Base::epsilon;
    using Base::gap_at;
    using Base::gap_noise;
    using Base::gap_of;
    using Base::leaving;
    using Base::nears_;
    using Base::place;
    using Base::radius_;
    using Base::speed_noise;
    using Base::start_;
    using Base::touches;
};

}  // namespace oiler
