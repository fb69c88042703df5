// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "oiler/physics/contacts/legs.hpp"

namespace oiler {

/// The motion of a body that as many obstacles bear as there are axes, some of which move. Their
/// surfaces alone determine its way, so that no method is needed; the forces and friction decide
/// how long they all bear it.
template <std::floating_point T, int Axes, class Body>
class Pinned : public Legs<T, Axes, Body> {
public:
    using Base = Legs<T, Axes, Body>;
    using typename Base::Leg;
    using typename Base::Near;
    using typename Base::State;
    using typename Base::Support;
    using typename Base::Vec;

protected:
    using Base::Base;

    /// The largest angle of one step on a curve.
    static constexpr T most_turn = T(0.25);

    [[nodiscard]] static bool stands(const Support& support) {
        for (std::size_t i = 0; i < support.size(); ++i)
            if (near_of(support, i).is_moved()) return false;
        return true;
    }
    [[nodiscard]] static bool moves(const Support& support) {
        for (std::size_t i = 0; i < support.size(); ++i)
            if (near_of(support, i).moves) return true;
        return false;
    }
    [[nodiscard]] static bool is_pinned(const Support& support) {
        return Axes > 1 && support.size() == Axes && !stands(support);
    }
    [[nodiscard]] std::optional<Leg> ride_between(const State& state, const Support& support) {
        if (enters_other(state, support)) return std::nullopt;
        T tau = left_;
        for (std::size_t i = 0; i < Axes; ++i) {
            const Near& near = near_of(support, i);
            if (!near.obstacle.bounded || !is_round(near.sides)) continue;
            const T most = most_turn * (near.obstacle.rounding + radius_);
            tau = std::min(tau, most / length(state.v - near.velocity));
        }
        const auto move = [&](T part) { return between(state, support, part); };
        const auto borne = [&](const State& at, T part) { return least_push(support, at, part); };
        Leg leg{move(tau), tau};
        end_where_negative(borne, std::max(borne(state, T(0)), T(0)), leg, move);
        const Vec a = body_.accelerate(state, start_);
        end_at_others(state, support, a, leg, move);
        end_at_features(state, support, leg, move);
        return leg.tau > epsilon * left_ ? std::optional(leg) : std::nullopt;
    }

    /// Which touches bear a pinned body `tau` s from now; null if it is locked: no pushes with
    /// friction do.
    [[nodiscard]] std::optional<std::array<bool, Axes>> bearers(const Support& support,
                                                                const State& at, T tau) const {
        const Touches there = touches_of(support, at, tau);
        const Vec a = body_.accelerate(at, start_ + tau);
        const auto found = support.with(there).bearing(
            at.v, [&](const TouchOf<T, Axes>& touch) { return -OfPull<T, Axes>{}(touch, a); });
        if (!found) return std::nullopt;
        std::array<bool, Axes> bear;
        for (std::size_t i = 0; i < Axes; ++i) bear[i] = found->has(there[i]);
        return bear;
    }
    /// A touch that a pinned body leaves now; null if there is none.
    [[nodiscard]] const TouchOf<T, Axes>* loosening(const State& state,
                                                    const Support& support) const {
        const T soon = left_ / 1024;
        const auto bear = bearers(support, between(state, support, soon), soon);
        if (!bear) return nullptr;
        const auto loose = std::find(bear->begin(), bear->end(), false);
        return loose == bear->end() ? nullptr
                                    : &support[static_cast<std::size_t>(loose - bear->begin())];
    }
    /// Holds a body between obstacles that draw it in so much that no pushes with friction bear it:
    /// wherever else it went, it would go into one of them.
    [[nodiscard]] std::optional<Leg> stay_locked(const State& state, const Support& support) {
        const auto is_locked = [&](const State& at, T tau) {
            return touches_all(support, at, tau) && !bearers(support, at, tau);
        };
        if (enters_other(state, support) || !is_locked(state, T(0))) return std::nullopt;
        const bool stays = !moves(support);
        const auto move = [&](T tau) {
            return stays ? State{state.x, {}} : between(state, support, tau);
        };
        Leg leg{move(left_), left_};
        end_at_others(state, support, body_.accelerate(state, start_), leg, move);
        if (!stays) end_at_features(state, support, leg, move);
        if (stays && !body_.forces_change()) {
            settled_ = leg.tau == left_;
            return leg;
        }
        const auto locks = [&](const State& at, T tau) {
            return is_locked(at, tau) ? T(1) : T(-1);
        };
        end_where_negative(locks, T(1), leg, move);
        return leg;
    }

    template <class Move>
    void end_at_others(const State& state, const Support& support, const Vec& a, Leg& leg,
                       Move move) {
        for (Near& near : nears_)
            if (!support.has(near)) end_at_impact(near, state, a, leg, move);
    }
    /// Ends the leg where the body gets past the end of a face, or from a corner onto a face.
    template <class Move>
    void end_at_features(const State& state, const Support& support, Leg& leg, Move move) {
        for (std::size_t i = 0; i < support.size(); ++i) {
            const Near& near = near_of(support, i);
            if (!near.obstacle.bounded) continue;
            const Feature sides = feature(near.obstacle, place(near, state.x), leg.end.x - state.x,
                                          gap_noise(near, state));
            const T noise = gap_noise(near, state);
            const auto left = [&](const State& at, T tau) {
                return left_of_feature(near.obstacle,
                                       place_beside(near.obstacle, at.x, start_ + tau), sides);
            };
            const T at_start = left(state, T(0));
            // A body that has just come to a feature may be beside it as far as round-off.
            const T hidden = at_start > noise ? T(0) : noise;
            const auto shown = [&](const State& at, T tau) { return left(at, tau) + hidden; };
            end_where_negative(shown, std::max(at_start + hidden, T(0)), leg, move);
        }
    }

private:
    using Touches = std::array<TouchOf<T, Axes>, Axes>;

    /// The touches of a support `tau` s from now, for a body there.
    [[nodiscard]] Touches touches_of(const Support& support, const State& at, T tau) const {
        const T then = start_ + tau;
        Touches touches;
        for (std::size_t i = 0; i < Axes; ++i) {
            Near near = near_of(support, i);
            if (is_round(near.sides)) renew_normal(near, at.x, then);
            near.velocity = surface_velocity(near.obstacle, near.normal, then);
            near.inwards = -dot(near.normal, near.obstacle.course.acceleration_at(then));
            if (near.obstacle.bounded)
                near.inwards += turning(near.obstacle, near.normal, near.sides,
                                        at.v - near.obstacle.course.velocity_at(then), radius_);
            touches[i] = near;
        }
        return touches;
    }
    /// The state where the body touches all obstacles of its support, `tau` s from now.
    [[nodiscard]] State between(const State& state, const Support& support, T tau) const {
        State at{state.x + state.v * tau, state.v};
        for (int i = 0; i < 8; ++i) {
            const Touches there = touches_of(support, at, tau);
            const Support then = support.with(there);
            const Vec x = then.onto(at.x, [&](const TouchOf<T, Axes>& touch) {
                const auto index = static_cast<std::size_t>(&touch - there.data());
                return gap_on_side(near_of(support, index), state.x, at.x, tau);
            });
            at = {x, then.following(state.v)};
            if (touches_all(support, at, tau)) break;
        }
        return std::isfinite(largest(at.x)) ? at : State{state.x + state.v * tau, state.v};
    }
    [[nodiscard]] bool touches_all(const Support& support, const State& at, T tau) const {
        for (std::size_t i = 0; i < Axes; ++i) {
            const Near& near = near_of(support, i);
            if (!(std::abs(gap_at(near, at.x, tau)) <= gap_noise(near, at))) return false;
        }
        return true;
    }
    /// The pushes of the obstacles, m/s², with friction.
    [[nodiscard]] Vec pushes(const Support& support, const State& at, T tau) const {
        const Touches there = touches_of(support, at, tau);
        const Vec a = body_.accelerate(at, start_ + tau);
        return support.with(there).pushes(
            at.v, [&](const TouchOf<T, Axes>& touch) { return -OfPull<T, Axes>{}(touch, a); });
    }
    /// The least of them; negative if it does not bear the body.
    [[nodiscard]] T least_push(const Support& support, const State& at, T tau) const {
        if (!touches_all(support, at, tau)) return T(-1);
        const Vec push = pushes(support, at, tau);
        return *std::min_element(push.axis.begin(), push.axis.end());
    }

protected:
    bool settled_ = false;  ///< the body stays in place until the forces change

    using Base::body_;
    using Base::end_at_impact;
    using Base::end_where_negative;
    using Base::enters_other;
    using Base::epsilon;
    using Base::gap_at;
    using Base::gap_noise;
    using Base::gap_on_side;
    using Base::left_;
    using Base::near_of;
    using Base::nears_;
    using Base::place;
    using Base::radius_;
    using Base::start_;
};

}  // namespace oiler
