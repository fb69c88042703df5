// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "oiler/physics/contacts/slides.hpp"

namespace oiler {

/// How a step of a body that meets obstacles ended.
enum class Landed {
    moving,
    settled,    ///< the body stays in place until the forces change
    strayed,    ///< the body got farther than the obstacles near it are known
    unresolved  ///< too many impacts
};

/// One step of one body that meets obstacles. Impacts, the end of sliding and the leaving of an
/// obstacle are located within the step, with shorter steps of the same method, so that a bounce
/// keeps the method's order. `Body` has
/// - `fly(state, start, tau)` and `slide(state, start, tau, support, friction)`: the state after a
///   step of `tau` s that begins `start` s after the start of the whole step;
/// - `accelerate(state, start)`, m/s²; `forces_change()`: whether forces depend on time.
/// `report(impact)` is called for each impact, in order.
template <std::floating_point T, int Axes, class Body, class Report>
class Landing : Slides<T, Axes, Body> {
public:
    using Base = Slides<T, Axes, Body>;
    using typename Base::Leg;
    using typename Base::Near;
    using typename Base::State;
    using typename Base::Support;
    using typename Base::Vec;

    /// `nears` are all obstacles that the body may meet within `way` m of its place.
    Landing(std::span<oiler::Near<T, Axes>> nears, T way, T radius, Body& body, Report report)
        : Base(nears, radius, body), way_(way), report_(report) {}

    /// Lets the obstacles pass, in the next step, that have crushed the body and still overlap it.
    /// A standing half-space never does.
    void stay_crushed(const State& state, T duration) {
        this->begin(state, duration);
        for (Near& near : nears_) {
            if (!near.obstacle.bounded && !near.moves) continue;
            near.yields = true;
            const T noise = gap_noise(near, state);
            const T least = near.moves ? noise : -16 * noise;
            near.passed = gap_of(near, state.x) <= least;
        }
    }
    /// Steps the state by `duration` s.
    [[nodiscard]] Landed step(State& state, T duration) {
        this->begin(state, duration);
        const Vec from = state.x;
        lift(state);
        renew(state);
        for (const Near& near : nears_)
            if (near.obstacle.course.jump != Vec{}) follow_jump(near, state);
        for (Near& near : nears_)
            near.resting = touches(near, state) && leaving(near, state.v) <= speed_noise(state);
        for (events_ = 0; left_ > 0; ++events_) {
            if (events_ == 2 * most_events) return Landed::unresolved;
            if (largest(state.x - from) > way_) return Landed::strayed;
            squeezed_ = any_moved_ ? events_ >= most_moved_events || crowded_ > most_crowded
                                   : crowded_ > most_crowded_at_rest;
            if (events_ >= most_events && !any_moved_) stop_in_corner(state);
            renew(state);
            if (any_renewed_ && crush(state)) continue;
            if (squeezed_) {
                squeeze(state);
                continue;
            }
            if (bounce(state)) continue;
            const Vec a = body_.accelerate(state, start_);
            const auto support = bearing(state, a);
            if (support.empty()) {
                take_off();
                fly(state, a);
            } else {
                report_rests(state, support);
                stay_on(state, support);
                if (settled_) return Landed::settled;
            }
        }
        return largest(state.x - from) > way_ ? Landed::strayed : Landed::moving;
    }

    /// Whether the body is in an obstacle that it passes, because that one left it no room.
    [[nodiscard]] bool is_crushed(const State& state) const {
        return crushed_ || std::ranges::any_of(nears_, [&](const Near& near) {
                   if (near.obstacle.is_one_way() || !(near.passed || near.yields)) return false;
                   const T noise = gap_noise(near, state);
                   const T most = near.passed ? noise : -near.deepest(noise, radius_);
                   return gap_of(near, state.x) <= most;
               });
    }

private:
    /// After this many events in a step, a body that bounces in a corner stops there.
    static constexpr int most_events = 4096;
    /// Fewer, if an obstacle moves: the body is then moved by parts of the step.
    static constexpr int most_moved_events = 512;
    static constexpr int squeezed_parts = 128;
    /// After this many such instants, a body between moving obstacles no longer bounces.
    static constexpr int most_crowded = 8;
    /// The same between standing ones, such as the edges of a hole that is as wide as the body.
    static constexpr int most_crowded_at_rest = 256;
    /// After this many impacts at one instant, a body between obstacles loses all speed into them.
    static constexpr int most_bounces_at_once = 16;
    /// Moves out of obstacles by this many times their round-off are not listed.
    static constexpr int hidden_lifts = 64;
    /// Flights shorter than this fraction of the rest of a step are not followed one by one.
    static constexpr T shortest_flight = T(1) / 64;
    /// At most so many are followed nevertheless, where friction stops the body between them.
    static constexpr int most_followed = 64;
    /// After as many impacts on one moving obstacle in a step, a body no longer bounces off it.
    static constexpr int most_caught = 64;

    void report(Meeting kind, const Near& near, T after_start, const State& state,
                const Vec& before) {
        report_(impact_of(kind, near, after_start, state, before));
    }
    [[nodiscard]] static ImpactOf<T, Axes> impact_of(Meeting kind, const Near& near, T after_start,
                                                     const State& state, const Vec& before) {
        return {kind, near.index, after_start, state.x, near.normal, before, state.v};
    }

    /// Moves a body that is in obstacles out of them. If they leave no room, the body stays, and
    /// moving ones pass, or that bounded one in which it is deepest.
    void lift(State& state) {
        for (Near& near : nears_) {
            near.lifted = false;
            if (any_renewed_) renew_normal(near, state.x, start_);
        }
        const auto noise = [&](const Near& near) { return gap_noise(near, state); };
        const auto gap = [&](const Near& near, const Vec& x) {
            const T distance = gap_of(near, x);
            const bool is_passed =
                near.passed || (distance < 0 && distance < -near.deepest(noise(near), radius_));
            return is_passed ? std::numeric_limits<T>::infinity() : distance;
        };
        const Vec before = state.x;
        do {
            lift_onto<T, Axes>(nears_, state.x, gap, noise, [&](Near& near) {
                near.lifted = true;
                for (Near& one : nears_) renew_normal(one, state.x, start_);
            });
        } while (any_renewed_ && pass_if_caught(state, before, gap, noise));
        if (state.x == before) return;
        const T way = largest(state.x - before);
        for (const Near& near : nears_)
            if (near.lifted && !squeezed_ && way > hidden_lifts * noise(near))
                report(Meeting::lifted, near, start_, state, state.v);
    }
    /// Whether a lifted body is back where it was `before`, because obstacles that it is in leave
    /// no room beside them, and now pass.
    template <class Gap, class Noise>
    bool pass_if_caught(State& state, const Vec& before, Gap gap, Noise noise) {
        if (state.x == before || has_room(state.x, before, gap, noise)) return false;
        state.x = before;
        bool any = false;
        Near* deepest = nullptr;
        T least = -radius_ / 16;
        for (Near& near : nears_) {
            near.lifted = false;
            renew_normal(near, state.x, start_);
            const T distance = gap(near, state.x);
            if (distance >= -noise(near)) continue;
            if (near.moves) {
                near.passed = any = true;
            } else if (near.obstacle.bounded && distance < least) {
                deepest = &near;
                least = distance;
            }
        }
        if (any || !deepest) return any;
        return deepest->passed = true;
    }
    /// Whether a body at x, lifted from `before`, is out of all obstacles: not far from one that
    /// moves, and on its side of each segment.
    template <class Gap, class Noise>
    [[nodiscard]] bool has_room(const Vec& x, const Vec& before, Gap gap, Noise noise) const {
        const bool is_far = largest(x - before) > radius_;
        return std::ranges::all_of(nears_, [&](const Near& near) {
            if (is_far && near.lifted && near.moves) return false;
            const T least = any_moves_ ? 4 * noise(near) : std::max(4 * noise(near), radius_ / 16);
            if (gap(near, x) < -least) return false;
            return !near.obstacle.is_thin() || near.passed || gap(near, before) < -noise(near) ||
                   dot(near.normal, normal(near.obstacle, place(near, before))) >= 0;
        });
    }

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
    /// Forgets the rest on an obstacle that the body leaves, and a rest that was to come.
    void take_off(Near& from) {
        if (rest_) nears_[resting_on_].resting = false;
        from.resting = false;
        rest_.reset();
    }
    void take_off() {
        for (Near& near : nears_) near.resting = false;
        rest_.reset();
    }
    void report_rests(const State& state, const Support& support) {
        for (std::size_t i = 0; i < support.size(); ++i) {
            Near& near = nears_[index_of(near_of(support, i))];
            const auto joins = [&](const Near& one) { return one.resting && one.hidden; };
            if (!near.resting && std::none_of(nears_.begin(), nears_.end(), joins))
                report(Meeting::rest, near, start_, state, state.v);
            near.resting = true;
        }
    }

    /// Resolves the first impact on an obstacle that the body touches, and those at the same
    /// instant with a box. Returns false if there is none.
    bool bounce(State& state) {
        for (Near& near : nears_) {
            if (!goes_into(near, state)) continue;
            const Vec before = state.v;
            const T speed = -leaving(near, before);
            state.x -= near.normal * gap_of(near, state.x);
            near.met = true;
            // Between obstacles that close in on the body, bounces would have no end.
            const bool is_caught = near.moves && ++near.bounces > most_caught;
            const T kept = is_caught ? T(0) : near.restitution * speed;
            take_off(near);
            if (++bounces_at_once_ > most_bounces_at_once) {
                ++crowded_;
                if (!give_way(state)) return true;
                report(Meeting::bounce, near, start_, state, before);
                return true;
            }
            if (any_renewed_ && bounce_off_several(near, state)) return true;
            const Vec along = landed(near, before - near.velocity, speed);
            state.v = with_surface(near, pushed_off(near, along, kept));
            report(Meeting::bounce, near, start_, state, before);
            follow_bounce(near, state, with_surface(near, along), kept);
            return true;
        }
        return false;
    }

    /// Lets moving obstacles pass that leave a body no velocity, between others that it touches.
    /// The body takes the velocity of the slowest one. Returns whether there were any.
    bool crush(State& state) {
        const auto touched = [&](const Near& near) { return touches(near, state); };
        const Near* slowest = nullptr;
        const Near* moving = nullptr;
        for (const Near& near : nears_) {
            if (!touched(near)) continue;
            if (near.moves) moving = &near;
            if (!slowest || length(near.velocity) < length(slowest->velocity)) slowest = &near;
        }
        if (!moving) return false;
        const Vec v = Support::against_velocity(state.v, nears_, touched).following(state.v);
        const T noise = 1024 * (speed_noise(state) + hidden_speed(moving->velocity));
        const auto is_left = [&](const Near& near) {
            return !touched(near) || leaving(near, v) >= -noise;
        };
        if (std::ranges::all_of(nears_, is_left)) return false;
        crush_by(*moving, slowest->velocity, state);
        return true;
    }
    /// Lets the moving obstacles that the body touches pass.
    void crush_by(const Near& moving, const Vec& v, State& state) {
        crushed_ = true;
        const Vec before = std::exchange(state.v, v);
        report(Meeting::crushed, moving, start_, state, before);
        for (Near& near : nears_)
            if (near.moves && touches(near, state)) near.passed = true;
    }
    /// Gives a body the velocity along all obstacles that it touches. Returns false if friction
    /// holds it between them: then moving ones pass.
    bool give_way(State& state) {
        const auto touched = [&](const Near& near) { return touches(near, state); };
        const auto support = Support::against_velocity(state.v, nears_, touched);
        const Vec along = support.following(state.v);
        const Near* const moving = any_moves_ ? moving_of(support) : nullptr;
        if (moving && support.jams(state.v, along)) {
            crush_by(*moving, support.slowest().velocity, state);
            return false;
        }
        state.v = along;
        return true;
    }
    [[nodiscard]] static const Near* moving_of(const Support& support) {
        for (std::size_t i = 0; i < support.size(); ++i)
            if (near_of(support, i).moves) return &near_of(support, i);
        return nullptr;
    }
    /// Bounces off all obstacles that the body goes into at this instant with one solve, which
    /// keeps mirror symmetry: off the velocity along all of them, with the least restitution.
    bool bounce_off_several(const Near& first, State& state) {
        const auto into = [&](const Near& near) { return goes_into(near, state); };
        const auto support = Support::against_velocity(state.v, nears_, into);
        if (support.size() < 2) return false;
        const Vec before = state.v;
        const Vec along = support.following(before);
        T restitution = 1;
        for (std::size_t i = 0; i < support.size(); ++i)
            restitution = std::min(restitution, support[i].restitution);
        state.v = along + (along - before) * restitution;
        for (Near& near : nears_)
            if (support.has(near)) near.met = true;
        report(Meeting::bounce, first, start_, state, before);
        return true;
    }
    /// Puts a body that bounces between obstacles that bear it together onto all of them.
    void stop_in_corner(State& state) {
        const Vec a = body_.accelerate(state, start_);
        const auto corner =
            Support::against(a, nears_, [](const Near& near) { return near.met && !near.hidden; });
        if (corner.size() >= 2) rest_on(corner, state);
    }
    /// Moves a body by a part of the step in which it does not bounce and slips without friction,
    /// where its impacts between obstacles that move have no end. This has order 1.
    void squeeze(State& state) {
        const T tau = std::min(left_, duration_ / squeezed_parts);
        const Vec a = body_.accelerate(state, start_);
        state.v += a * tau;
        if (!give_way(state)) return;
        const auto touched = [&](const Near& near) { return touches(near, state); };
        const auto move = [&](T part) { return State{state.x + state.v * part, state.v}; };
        Leg leg{move(tau), tau};
        for (Near& near : nears_)
            if (!touched(near) && !near.hidden) end_at_impact(near, state, a, leg, move);
        advance(state, leg);
    }
    /// Ends bounces if all further flights are over within the step or hidden by round-off: with
    /// acceleration a towards the obstacle, all flights after a bounce to speed u last
    /// 2u/(a·(1 − e)). Skips flights that are much shorter than the step. In both cases the body
    /// slides with the velocity `along` that it had between landing and being pushed off. Under
    /// constant forces, this gives the same velocity and place as all the flights, unless friction
    /// stops it in an impact.
    void follow_bounce(Near& near, State& state, const Vec& along, T kept) {
        renew(state);
        Vec a = body_.accelerate(state, start_);
        a += drag(state, a);
        const T pull = -OfPull<T, Axes>{}(near, bearing(state, a, &near).without_push(a));
        if (!(pull > 0)) return;
        const T flight = 2 * kept / pull;
        const T lost = 1 - near.restitution;
        const auto support = bearing(state, a, nullptr, &near);
        if (is_stopped_between(near, along - near.velocity, kept, support.without_push(a)) &&
            ++followed_ <= most_followed) {
            return;
        } else if (flight <= lost * left_) {
            state.v = along;
            report_rest(near, state, support, a, lost > 0 ? flight / lost : T(0));
        } else if (kept * kept <= 2 * pull * hidden_height(near, state)) {
            state.v = along;
            report_rest(near, state, support, a, T(0));
        } else if (flight < shortest_flight * left_) {
            // Without its normal speed, the body may rest on further obstacles, or go into one.
            State sliding{state.x, along};
            const auto bearers = bearing(sliding, a);
            if (!bearers.has(near) || enters_other(sliding, bearers)) return;
            T tau = stay_on(sliding, bearers);
            if (sliding.v == Vec{} && left_ > 0) tau += stay_on(sliding, bearers);
            renew(sliding);
            const T rest = kept * (1 - tau * lost / flight);
            state = {sliding.x,
                     with_surface(near, pushed_off(near, sliding.v - near.velocity, rest))};
            settled_ = false;
        }
    }
    /// Whether friction stops the body in one of the impacts to come. From there on, it does not
    /// slide as with all the flights, because friction does not act between impacts.
    [[nodiscard]] static bool is_stopped_between(const Near& near, const Vec& along, T kept,
                                                 const Vec& pull) {
        if (near.friction == 0 || (along == Vec{} && pull == Vec{})) return false;
        const T pushes = (1 + near.restitution) * kept;
        return (1 - near.restitution) * length(along) <= near.friction * pushes;
    }
    /// Predicts the rest of a sliding body whose bounces end `after` s from now.
    void report_rest(Near& near, const State& state, const Support& support, const Vec& a,
                     T after) {
        const T speed = length(state.v);
        State end = state;
        if (speed > 0) {
            const Vec direction = state.v * (1 / speed);
            const Vec slowing = support.without_push(a) - direction * support.grip(a);
            const T rate = -dot(slowing, direction);
            const T tau = rate * after > speed ? speed / rate : after;
            end = {state.x + (state.v + slowing * (tau / 2)) * tau, state.v + slowing * tau};
        }
        // Of a body that goes round a curve or past an end, only this instant is known.
        const bool stays =
            !near.obstacle.bounded || std::abs(gap_at(near, end.x, after)) <= gap_noise(near, end);
        rest_ = stays ? impact_of(Meeting::rest, near, start_ + after, end, end.v)
                      : impact_of(Meeting::rest, near, start_, state, state.v);
        resting_on_ = index_of(near);
        near.resting = true;
    }

    void fly(State& state, const Vec& a) {
        const auto move = [&](T tau) { return body_.fly(state, start_, tau); };
        Leg leg{move(left_), left_};
        for (Near& near : nears_) end_at_impact(near, state, a, leg, move);
        for (Near& near : nears_)
            if (std::exchange(near.dips, false)) {
                const T gap = gap_on_side(near, state.x, leg.end.x, leg.tau);
                const Vec out =
                    normal(near.obstacle, place_beside(near.obstacle, leg.end.x, start_ + leg.tau));
                const bool is_past = dot(out, near.normal) < 0;
                leg.end.x -= (is_past ? near.normal : out) * std::min(gap, T(0));
            }
        advance(state, leg);
    }

    /// Steps a body on the obstacles that bear it, and returns the time until that ends, s.
    T stay_on(State& state, const Support& support) {
        rest_on(support, state);
        if (is_pinned(support)) {
            if (const auto leg = stay_locked(state, support)) return advance(state, *leg);
            if (const auto leg = ride_between(state, support)) return advance(state, *leg);
            if (const auto* const loose = loosening(state, support))
                return stay_on(state, support.without_touch(*loose));
        }
        const Vec a = pressing(support, state);
        const bool on_curve = support.size() == 1 && is_round(near_of(support).sides);
        const bool is_held = sticks(support, state, a);
        const bool rides = on_curve && near_of(support).obstacle.belt != 0;
        std::optional<Leg> leg;
        if (is_held)
            leg = rides ? ride_curve(state, near_of(support), support) : stick(state, support, a);
        if (!leg)
            leg = on_curve ? follow_curve(state, near_of(support), support, a)
                           : slide(state, support, a);
        return leg ? advance(state, *leg) : T(0);
    }
    void rest_on(const Support& support, State& state) const {
        const T noise = speed_noise(state);
        state.v = support.following(state.v);
        const Vec rest = carrier(support);
        if (largest(state.v - rest) <= noise) state.v = rest;
        state.x = support.onto(state.x, [&](const TouchOf<T, Axes>& touch) {
            return gap_of(static_cast<const Near&>(touch), state.x);
        });
    }
    /// Keeps a body that rested on an obstacle there if the obstacle's velocity has changed between
    /// steps: that change is an acceleration over the step, which the forces may still exceed.
    void follow_jump(const Near& near, State& state) {
        const Vec& jump = near.obstacle.course.jump;
        const Vec slip = state.v - (near.velocity - jump);
        const T noise = speed_noise(state) + hidden_speed(near.velocity);
        if (!touches(near, state) || std::abs(dot(near.normal, slip)) > noise) return;
        const Vec a = body_.accelerate(state, T(0));
        const T push = dot(near.normal, jump);
        const T reaction = push - dot(near.normal, a) * duration_;
        if (!(reaction > 0)) return;
        state.v += near.normal * push;
        const Vec along = jump - near.normal * push;
        if (largest(slip) > noise) return;
        const T most = near.friction * reaction;
        const T size = length(along);
        state.v += size <= most ? along : along * (most / size);
    }

    using Base::any_moved_;
    using Base::any_moves_;
    using Base::any_renewed_;
    using Base::bearing;
    using Base::body_;
    using Base::carried;
    using Base::carrier;
    using Base::drag;
    using Base::duration_;
    using Base::end_at_impact;
    using Base::enters_other;
    using Base::events_;
    using Base::follow_curve;
    using Base::gap_at;
    using Base::gap_noise;
    using Base::gap_of;
    using Base::gap_on_side;
    using Base::goes_into;
    using Base::hidden_height;
    using Base::index_of;
    using Base::is_pinned;
    using Base::leaving;
    using Base::left_;
    using Base::loosening;
    using Base::near_of;
    using Base::nears_;
    using Base::place;
    using Base::pressing;
    using Base::radius_;
    using Base::renew;
    using Base::ride_between;
    using Base::ride_curve;
    using Base::settled_;
    using Base::slide;
    using Base::speed_noise;
    using Base::start_;
    using Base::stay_locked;
    using Base::stick;
    using Base::sticks;
    using Base::touches;

    T way_;  ///< m
    Report report_;
    int bounces_at_once_ = 0;
    int followed_ = 0;
    int crowded_ = 0;                        ///< instants of the step with too many impacts
    bool crushed_ = false;                   ///< in this step
    bool squeezed_ = false;                  ///< the body moves by parts of the step
    std::optional<ImpactOf<T, Axes>> rest_;  ///< predicted, unless an event comes before
    std::size_t resting_on_ = 0;             ///< the index in `nears_` of the predicted rest
};

}  // namespace oiler
