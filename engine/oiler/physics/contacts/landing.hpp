// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "oiler/physics/contacts/plane.hpp"
#include "oiler/physics/contacts/root.hpp"
#include "oiler/physics/contacts/support.hpp"

namespace oiler {

/// How a step of a body that meets planes ended.
enum class Landed {
    moving,
    settled,    ///< the body stays in place until the forces change
    unresolved  ///< too many impacts
};

/// One step of one body that meets planes. Impacts, the end of sliding and the leaving of a plane
/// are located within the step, with shorter steps of the same method, so that a bounce keeps the
/// method's order. `Body` has
/// - `fly(state, start, tau)` and `slide(state, start, tau, support, friction)`: the state after a
///   step of `tau` s that begins `start` s after the start of the whole step;
/// - `accelerate(state, start)`, m/s²; `forces_change()`: whether forces depend on time.
/// `report(impact)` is called for each impact, in order.
template <std::floating_point T, int Axes, class Body, class Report>
class Landing {
public:
    using Plane = PlaneOf<T, Axes>;
    using Vec = oiler::Vec<T, Axes>;
    using State = oiler::State<T, Axes>;
    using Support = oiler::Support<T, Axes>;

    Landing(std::span<const Plane> planes, T radius, Body& body, Report report)
        : planes_(planes), radius_(radius), body_(body), report_(report) {}

    /// Steps the state by `duration` s.
    [[nodiscard]] Landed step(State& state, T duration) {
        duration_ = left_ = duration;
        const T speed = largest(body_.accelerate(state, T(0))) * duration;
        hidden_ = {8 * epsilon * speed, 8 * epsilon * speed * duration};
        lift(state);
        for (const Plane& plane : planes_)
            if (touches(plane, state) && leaving_speed(plane, state.v) <= speed_noise(state))
                resting_ |= bit_of(plane);
        for (int events = 0; left_ > 0; ++events) {
            if (events == 2 * most_events) return Landed::unresolved;
            if (events >= most_events) stop_in_corner(state);
            if (bounce(state)) continue;
            const Vec a = body_.accelerate(state, start_);
            const auto support = Support::against(a, planes_, bearing_planes(state, a));
            if (support.empty()) {
                take_off(~PlaneSet{0});
                fly(state);
            } else {
                report_rests(state, support);
                stay_on(state, support);
                if (settled_) return Landed::settled;
            }
        }
        return Landed::moving;
    }

private:
    static constexpr T epsilon = std::numeric_limits<T>::epsilon();
    /// After this many events in a step, a body that bounces in a corner stops there.
    static constexpr int most_events = 4096;
    /// After this many impacts at one instant, a body between planes loses all speed into them.
    static constexpr int most_bounces_at_once = 16;
    /// Flights shorter than this fraction of the rest of a step are not followed one by one.
    static constexpr T shortest_flight = T(1) / 64;
    /// At most so many are followed nevertheless, where friction stops the body between them.
    static constexpr int most_followed = 64;

    [[nodiscard]] T gap_noise(const Plane& plane, const State& state) const {
        return hidden_distance(plane, state, radius_, duration_) + hidden_.distance;
    }
    [[nodiscard]] T speed_noise(const State& state) const {
        return hidden_speed(state.v) + hidden_.speed;
    }
    [[nodiscard]] T gap_of(const Plane& plane, const Vec& x) const {
        return gap(plane, x, radius_);
    }
    [[nodiscard]] bool touches(const Plane& plane, const State& state) const {
        return gap_of(plane, state.x) <= gap_noise(plane, state);
    }
    [[nodiscard]] std::size_t index_of(const Plane& plane) const {
        return static_cast<std::size_t>(&plane - planes_.data());
    }
    [[nodiscard]] PlaneSet bit_of(const Plane& plane) const {
        return PlaneSet{1} << index_of(plane);
    }
    void report(Meeting kind, const Plane& plane, T after_start, const State& state,
                const Vec& before) {
        report_(ImpactOf<T, Axes>{kind, index_of(plane), after_start, state.x, before, state.v});
    }

    /// Moves a body that is below planes onto them.
    void lift(State& state) {
        PlaneSet reported = 0;
        lift_onto(
            planes_, state.x, [&](const Plane& plane, const Vec& x) { return gap_of(plane, x); },
            [&](const Plane& plane) { return gap_noise(plane, state); },
            [&](const Plane& plane) {
                if ((reported & bit_of(plane)) == 0)
                    report(Meeting::lifted, plane, start_, state, state.v);
                reported |= bit_of(plane);
            });
    }

    /// The first part of what is left of the step.
    struct Leg {
        State end;
        T tau;
    };
    /// Moves the body to the end of a leg, and returns its time.
    T advance(State& state, const Leg& leg) {
        state = leg.end;
        start_ += leg.tau;
        left_ = leg.tau < left_ ? left_ - leg.tau : T(0);
        if (leg.tau > 0) bounces_at_once_ = 0;
        if (rest_ && (rest_->after_start <= start_ || left_ == 0))
            report_(*std::exchange(rest_, std::nullopt));
        lift(state);
        return leg.tau;
    }
    /// Forgets the rests on planes that the body leaves, and a rest that was to come.
    void take_off(PlaneSet from) {
        if (rest_) from |= PlaneSet{1} << rest_->plane;
        resting_ &= ~from;
        rest_.reset();
    }
    void report_rests(const State& state, const Support& support) {
        for (std::size_t i = 0; i < support.size(); ++i) {
            const bool rested = (resting_ & bit_of(support[i])) != 0;
            if (!rested) report(Meeting::rest, support[i], start_, state, state.v);
            resting_ |= bit_of(support[i]);
        }
    }

    /// The planes that may bear the body: those that it touches without leaving them, or leaves for
    /// flights that round-off hides.
    [[nodiscard]] PlaneSet bearing_planes(const State& state, const Vec& a) const {
        PlaneSet set = 0;
        PlaneSet left = 0;
        for (const Plane& plane : planes_) {
            if (!touches(plane, state)) continue;
            const bool leaves = leaving_speed(plane, state.v) > speed_noise(state);
            (leaves ? left : set) |= bit_of(plane);
        }
        if (left == 0) return set;
        const Vec pulled = Support::against(a, planes_, set).without_push(a);
        for (const Plane& plane : planes_)
            if ((left & bit_of(plane)) != 0 && is_hidden_flight(plane, state, pulled))
                set |= bit_of(plane);
        return set;
    }
    /// Whether round-off hides the height of a flight off a plane under an acceleration.
    [[nodiscard]] bool is_hidden_flight(const Plane& plane, const State& state,
                                        const Vec& a) const {
        const T u = leaving_speed(plane, state.v);
        const T pull = -dot(plane.normal, a);
        return pull > 0 && u * u <= 2 * pull * gap_noise(plane, state);
    }

    /// Resolves the first impact on a plane that the body touches. Returns false if there is none.
    bool bounce(State& state) {
        for (const Plane& plane : planes_) {
            const T speed = -leaving_speed(plane, state.v);
            if (!(speed > speed_noise(state)) || !touches(plane, state)) continue;
            const Vec before = state.v;
            state.x -= plane.normal * gap_of(plane, state.x);
            met_ |= bit_of(plane);
            const T kept = plane.restitution * speed;
            take_off(bit_of(plane));
            if (++bounces_at_once_ > most_bounces_at_once) {
                state.v =
                    Support::against(before, planes_, touched_planes(state)).without_push(before);
                report(Meeting::bounce, plane, start_, state, before);
                return true;
            }
            const Vec along = landed(plane, before, speed);
            state.v = pushed_off(plane, along, kept);
            report(Meeting::bounce, plane, start_, state, before);
            follow_bounce(plane, state, along, kept);
            return true;
        }
        return false;
    }
    /// Puts a body that bounces between planes that bear it together onto all of them.
    void stop_in_corner(State& state) {
        const Vec a = body_.accelerate(state, start_);
        const auto corner = Support::against(a, planes_, met_);
        if (corner.size() >= 2) rest_on(corner, state);
    }
    [[nodiscard]] PlaneSet touched_planes(const State& state) const {
        PlaneSet set = 0;
        for (const Plane& plane : planes_)
            if (touches(plane, state)) set |= bit_of(plane);
        return set;
    }
    /// Ends bounces if all further flights are over within the step or hidden by round-off: with
    /// acceleration a towards the plane, all flights after a bounce to speed u last 2u/(a·(1 − e)).
    /// Skips flights that are much shorter than the step. In both cases the body slides with the
    /// velocity `along` that it had between landing and being pushed off. Under constant forces,
    /// this gives the same velocity and place as all the flights, unless friction stops it in an
    /// impact.
    void follow_bounce(const Plane& plane, State& state, const Vec& along, T kept) {
        const Vec a = body_.accelerate(state, start_);
        const PlaneSet others = bearing_planes(state, a) & ~bit_of(plane);
        const T pull = -dot(plane.normal, Support::against(a, planes_, others).without_push(a));
        if (!(pull > 0)) return;
        const T flight = 2 * kept / pull;
        const T lost = 1 - plane.restitution;
        const auto bearing = Support::against(a, planes_, others | bit_of(plane));
        if (is_stopped_between(plane, along, kept, bearing.without_push(a)) &&
            ++followed_ <= most_followed) {
            return;
        } else if (flight <= lost * left_) {
            state.v = along;
            report_rest(plane, state, bearing, a, lost > 0 ? flight / lost : T(0));
        } else if (kept * kept <= 2 * pull * gap_noise(plane, state)) {
            state.v = along;
            report_rest(plane, state, bearing, a, T(0));
        } else if (flight < shortest_flight * left_) {
            // Without its normal speed, the body may rest on further planes, or go into one.
            State sliding{state.x, along};
            const auto carried = Support::against(a, planes_, bearing_planes(sliding, a));
            if (!carried.has(plane) || enters_other(sliding, along, carried)) return;
            T tau = stay_on(sliding, carried);
            if (sliding.v == Vec{} && left_ > 0) tau += stay_on(sliding, carried);
            state = {sliding.x, pushed_off(plane, sliding.v, kept * (1 - tau * lost / flight))};
            settled_ = false;
        }
    }
    /// Whether friction stops the body in one of the impacts to come. From there on, it does not
    /// slide as with all the flights, because friction does not act between impacts.
    [[nodiscard]] static bool is_stopped_between(const Plane& plane, const Vec& along, T kept,
                                                 const Vec& pull) {
        if (plane.friction == 0 || (along == Vec{} && pull == Vec{})) return false;
        const T pushes = (1 + plane.restitution) * kept;
        return (1 - plane.restitution) * length(along) <= plane.friction * pushes;
    }
    /// Predicts the rest of a sliding body whose bounces end `after` s from now.
    void report_rest(const Plane& plane, const State& state, const Support& bearing, const Vec& a,
                     T after) {
        const T speed = length(state.v);
        State end = state;
        if (speed > 0) {
            const Vec direction = state.v * (1 / speed);
            const Vec slowing = bearing.without_push(a) - direction * bearing.grip(a);
            const T rate = -dot(slowing, direction);
            const T tau = rate * after > speed ? speed / rate : after;
            end = {state.x + (state.v + slowing * (tau / 2)) * tau, state.v + slowing * tau};
        }
        rest_ = {Meeting::rest, index_of(plane), start_ + after, end.x, end.v, end.v};
        resting_ |= bit_of(plane);
    }

    void fly(State& state) {
        const auto move = [&](T tau) { return body_.fly(state, start_, tau); };
        Leg leg{move(left_), left_};
        for (const Plane& plane : planes_) end_at_impact(plane, state, leg, move);
        advance(state, leg);
    }

    /// Steps a body on the planes that bear it, and returns the time until that ends, s.
    T stay_on(State& state, const Support& support) {
        rest_on(support, state);
        const Vec a = body_.accelerate(state, start_);
        return sticks(support, state, a) ? stick(state, support) : slide(state, support, a);
    }
    void rest_on(const Support& support, State& state) const {
        const T noise = speed_noise(state);
        state.v = support.without_push(state.v);
        if (largest(state.v) <= noise) state.v = {};
        state.x = support.onto(state.x, [&](const Plane& plane) { return gap_of(plane, state.x); });
    }
    /// Grip minus the pull along the planes, m/s²; negative if friction does not hold the body.
    [[nodiscard]] static T surplus_of_grip(const Support& support, const Vec& a) {
        return support.grip(a) + 4 * epsilon * largest(a) - length(support.without_push(a));
    }
    [[nodiscard]] static bool sticks(const Support& support, const State& state, const Vec& a) {
        return state.v == Vec{} && surplus_of_grip(support, a) >= 0;
    }
    /// Holds a body at rest until the forces let it slide or take it off.
    T stick(State& state, const Support& support) {
        const T whole = left_;
        if (!body_.forces_change()) {
            settled_ = true;
            return advance(state, {state, whole});
        }
        const auto held = [&](T tau) {
            const Vec a = body_.accelerate(state, start_ + tau);
            return std::min(surplus_of_grip(support, a), least_reaction(support, a));
        };
        const T at_end = held(whole);
        const T tau =
            at_end >= 0
                ? whole
                : narrow_bracket<T>(held, {0, whole}, std::max(held(0), T(0)), at_end, -1).after;
        return advance(state, {state, tau});
    }
    [[nodiscard]] static T least_reaction(const Support& support, const Vec& a) {
        const Vec reaction = support.reactions(a);
        return *std::min_element(reaction.axis.begin(),
                                 reaction.axis.begin() + static_cast<int>(support.size()));
    }

    /// Whether a pull turns a velocity.
    [[nodiscard]] static bool is_across(const Vec& v, const Vec& pull) {
        const T square = dot(pull, pull);
        if (!(square > 0)) return false;
        return largest(v - pull * (dot(v, pull) / square)) > 64 * epsilon * largest(v);
    }
    /// Whether a velocity goes into a plane that the body touches and that does not bear it.
    [[nodiscard]] bool enters_other(const State& state, const Vec& v,
                                    const Support& support) const {
        return std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
            return !support.has(plane) && touches(plane, state) &&
                   -leaving_speed(plane, v) > speed_noise(state);
        });
    }
    T slide(State& state, const Support& support, const Vec& a) {
        if (enters_other(state, state.v, support)) return 0;
        const Vec pull = support.without_push(a);
        const Vec direction = normalised(state.v == Vec{} ? pull : state.v);
        const T grip = support.grip(a);
        const bool free_to_turn = grip > 0 && support.size() + 2 <= Axes;
        const Friction<T, Axes> friction{direction, free_to_turn && is_across(state.v, pull)};
        const auto move = [&](T tau) { return body_.slide(state, start_, tau, support, friction); };
        if (free_to_turn && state.v != Vec{} && dot(pull, pull) < grip * grip)
            if (const auto end = slide_end(state.v, pull, grip); end.time <= left_) {
                Leg leg{{state.x + end.way, Vec{}}, end.time};
                end_at_other_planes(state, support, leg, move);
                return advance(state, leg);
            }
        Leg leg{move(left_), left_};
        end_at_other_planes(state, support, leg, move);
        const auto borne = [&](const State& at, T tau) {
            return least_reaction(support, body_.accelerate(at, start_ + tau));
        };
        end_where_negative(borne, least_reaction(support, a), leg, move);
        const auto speed = [&](const State& at, T) { return dot(at.v, direction); };
        if (grip > 0 && state.v != Vec{} &&
            end_where_negative(speed, dot(state.v, direction), leg, move)) {
            leg.end.v -= direction * dot(leg.end.v, direction);
            if (largest(leg.end.v) <= 64 * epsilon * largest(state.v)) leg.end.v = {};
        }
        return advance(state, leg);
    }
    template <class Move>
    void end_at_other_planes(const State& state, const Support& support, Leg& leg, Move move) {
        for (const Plane& plane : planes_)
            if (!support.has(plane)) end_at_impact(plane, state, leg, move);
    }
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
    void end_at_impact(const Plane& plane, const State& state, Leg& leg, Move move) {
        const auto bracket = impact(plane, state, leg, move);
        if (!bracket) return;
        leg = {move(bracket->before), bracket->before};
    }
    /// The time of the first impact on a plane within a leg, if there is one. A body that is above
    /// the plane at both ends may have been below it between them, where it turned.
    template <class Move>
    [[nodiscard]] std::optional<Bracket<T>> impact(const Plane& plane, const State& state,
                                                   const Leg& leg, Move move) const {
        const T noise = gap_noise(plane, state);
        const auto height = [&](T tau) { return gap_of(plane, move(tau).x); };
        const T start = gap_of(plane, state.x);
        const T end = gap_of(plane, leg.end.x);
        const T u_start = leaving_speed(plane, state.v);
        const T u_end = leaving_speed(plane, leg.end.v);
        const auto turning_time = [&](T sign) {
            const auto speed = [&](T tau) { return sign * leaving_speed(plane, move(tau).v); };
            return narrow_bracket<T>(speed, {0, leg.tau}, sign * u_start, sign * u_end, -1).before;
        };
        const auto between = [&](T before, T h_before, T after, T h_after) {
            return narrow_bracket<T>(height, {before, after}, h_before, h_after, noise / 16);
        };
        if (end < 0) {
            if (start > noise) return between(0, start, leg.tau, end);
            // It moves along the plane.
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

    std::span<const Plane> planes_;
    T radius_;
    Body& body_;
    Report report_;
    T duration_ = 0;  ///< s, of the step
    T start_ = 0;     ///< s, from the start of the step
    T left_ = 0;      ///< s
    int bounces_at_once_ = 0;
    int followed_ = 0;
    PlaneSet met_ = 0;  ///< the planes on which the body bounced in the step
    bool settled_ = false;
    PlaneSet resting_ = 0;  ///< the planes that the body has not left since its last rest on them
    std::optional<ImpactOf<T, Axes>> rest_;  ///< predicted, unless an event comes before
    /// The speed and the distance that round-off hides in a step from rest.
    struct {
        T speed = 0;     ///< m/s
        T distance = 0;  ///< m
    } hidden_;
};

}  // namespace oiler
