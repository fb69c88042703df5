// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "oiler/physics/contacts/crossing.hpp"
#include "oiler/physics/contacts/near.hpp"
#include "oiler/physics/contacts/root.hpp"
#include "oiler/physics/contacts/support.hpp"

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
class Landing {
public:
    using Near = oiler::Near<T, Axes>;
    using Vec = oiler::Vec<T, Axes>;
    using State = oiler::State<T, Axes>;
    using Support = oiler::Support<T, Axes>;

    /// `nears` are all obstacles that the body may meet within `way` m of its place.
    Landing(std::span<Near> nears, T way, T radius, Body& body, Report report)
        : nears_(nears), way_(way), radius_(radius), body_(body), report_(report) {
        for (const Near& near : nears) {
            any_renewed_ |= near.obstacle.bounded || near.is_moved();
            any_moves_ |= near.obstacle.course.moves();
            any_moved_ |= near.is_moved();
        }
    }

    /// Steps the state by `duration` s.
    [[nodiscard]] Landed step(State& state, T duration) {
        duration_ = left_ = duration;
        const T speed = largest(body_.accelerate(state, T(0))) * duration;
        T fastest = 0;
        for (const Near& near : nears_)
            fastest = std::max(fastest, near.obstacle.course.most_speed(duration));
        hidden_ = {8 * epsilon * (speed + 2 * fastest), 8 * epsilon * speed * duration};
        const Vec from = state.x;
        lift(state);
        renew(state);
        for (const Near& near : nears_)
            if (near.obstacle.course.jump != Vec{}) follow_jump(near, state);
        for (Near& near : nears_)
            near.resting = touches(near, state) && leaving(near, state.v) <= speed_noise(state);
        for (int events = 0; left_ > 0; ++events) {
            if (events == 2 * most_events) return Landed::unresolved;
            if (largest(state.x - from) > way_) return Landed::strayed;
            squeezed_ = any_moves_ && (events >= most_events || crowded_ > most_crowded);
            if (events >= most_events && !any_moves_) stop_in_corner(state);
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

private:
    static constexpr T epsilon = std::numeric_limits<T>::epsilon();
    /// After this many events in a step, a body that bounces in a corner stops there.
    static constexpr int most_events = 4096;
    static constexpr int squeezed_parts = 128;
    /// After this many such instants, a body between moving obstacles no longer bounces.
    static constexpr int most_crowded = 8;
    /// After this many impacts at one instant, a body between obstacles loses all speed into them.
    static constexpr int most_bounces_at_once = 16;
    /// Flights shorter than this fraction of the rest of a step are not followed one by one.
    static constexpr T shortest_flight = T(1) / 64;
    /// At most so many are followed nevertheless, where friction stops the body between them.
    static constexpr int most_followed = 64;
    /// After as many impacts on one moving obstacle in a step, a body no longer bounces off it.
    static constexpr int most_caught = 64;
    /// The largest angle of one step on a curve.
    static constexpr T most_turn = T(0.25);

    [[nodiscard]] T gap_noise(const Near& near, const State& state) const {
        return hidden_distance(near.obstacle, state, radius_, duration_) + hidden_.distance;
    }
    [[nodiscard]] T speed_noise(const State& state) const {
        return hidden_speed(state.v) + hidden_.speed;
    }
    [[nodiscard]] T gap_of(const Near& near, const Vec& x) const { return gap_at(near, x, T(0)); }
    /// The gap `tau` s from now.
    [[nodiscard]] T gap_at(const Near& near, const Vec& x, T tau) const {
        return gap(near, x, start_ + tau, radius_);
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
    void report(Meeting kind, const Near& near, T after_start, const State& state,
                const Vec& before) {
        report_(impact_of(kind, near, after_start, state, before));
    }
    [[nodiscard]] static ImpactOf<T, Axes> impact_of(Meeting kind, const Near& near, T after_start,
                                                     const State& state, const Vec& before) {
        return {kind, near.index, after_start, state.x, near.normal, before, state.v};
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
    [[nodiscard]] Vec place(const Near& near, const Vec& x) const {
        return place_beside(near.obstacle, x, start_);
    }

    /// Moves a body that is in obstacles out of them. If there is no room beside a moving one, the
    /// body stays, and that one passes.
    void lift(State& state) {
        for (Near& near : nears_) {
            near.lifted = false;
            renew_normal(near, state.x, start_);
        }
        const auto gap = [&](const Near& near, const Vec& x) {
            const T distance = gap_of(near, x);
            const bool is_passed = near.passed || distance < -near.deepest(T(0), radius_);
            return is_passed ? std::numeric_limits<T>::infinity() : distance;
        };
        const auto noise = [&](const Near& near) { return gap_noise(near, state); };
        const Vec before = state.x;
        do {
            lift_onto<T, Axes>(nears_, state.x, gap, noise, [&](Near& near) {
                near.lifted = true;
                for (Near& one : nears_) renew_normal(one, state.x, start_);
            });
        } while (any_moves_ && pass_if_caught(state, before, gap, noise));
        for (const Near& near : nears_)
            if (near.lifted && !squeezed_) report(Meeting::lifted, near, start_, state, state.v);
    }
    /// Whether a lifted body is back where it was `before`, because moving obstacles that it is in
    /// leave no room beside them, and now pass.
    template <class Gap, class Noise>
    bool pass_if_caught(State& state, const Vec& before, Gap gap, Noise noise) {
        const auto is_out = [&](const Near& near) {
            return gap(near, state.x) >= -4 * noise(near);
        };
        const auto pushes = [](const Near& near) {
            return near.lifted && near.obstacle.course.moves();
        };
        const bool has_room =
            largest(state.x - before) <= radius_ || std::ranges::none_of(nears_, pushes);
        if (has_room && std::ranges::all_of(nears_, is_out)) return false;
        state.x = before;
        bool any = false;
        for (Near& near : nears_) {
            near.lifted = false;
            renew_normal(near, state.x, start_);
            const bool is_in = near.obstacle.course.moves() && gap_of(near, state.x) < -noise(near);
            any |= is_in && !near.passed;
            near.passed |= is_in;
        }
        return any;
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
        const auto support = Support::against(a, nears_, bears);
        const Vec dragged = drag(state, a);
        if (dragged == Vec{}) return support;
        const auto pressed = Support::against(a + dragged, nears_, bears);
        return pressed.size() > support.size() ? pressed : support;
    }
    /// The acceleration by friction, which may press the body into other obstacles where one of
    /// them moves.
    [[nodiscard]] Vec drag(const State& state, const Vec& a) const {
        Vec sum{};
        if (!any_moved_) return sum;
        for (const Near& near : nears_) {
            if (near.friction == 0 || !touches(near, state)) continue;
            const Vec slip = state.v - near.velocity;
            const T reaction = -OfPull<T, Axes>{}(near, a);
            if (reaction > 0 && largest(slip) > speed_noise(state))
                sum -= normalised(slip) * (near.friction * reaction);
        }
        return sum;
    }
    /// The acceleration that presses a body onto the obstacles that bear it, `tau` s from now.
    [[nodiscard]] Vec pressing(const Support& support, const State& state, T tau = 0) const {
        const Vec a = body_.accelerate(state, start_ + tau);
        return support.size() > 1 ? a + drag(state, a) : a;
    }
    /// Whether round-off hides the height of a flight off an obstacle under an acceleration.
    [[nodiscard]] bool is_hidden_flight(const Near& near, const State& state, const Vec& a) const {
        const T u = leaving(near, state.v);
        const T pull = -OfPull<T, Axes>{}(near, a);
        return pull > 0 && u * u <= 2 * pull * gap_noise(near, state);
    }

    [[nodiscard]] bool goes_into(const Near& near, const State& state) const {
        return -leaving(near, state.v) > speed_noise(state) && touches(near, state);
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
            const bool is_caught = near.obstacle.course.moves() && ++near.bounces > most_caught;
            const T kept = is_caught ? T(0) : near.restitution * speed;
            take_off(near);
            if (++bounces_at_once_ > most_bounces_at_once) {
                ++crowded_;
                const auto touched = [&](const Near& one) { return touches(one, state); };
                state.v = Support::against_velocity(before, nears_, touched).following(before);
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
            if (near.obstacle.course.moves()) moving = &near;
            if (!slowest || length(near.velocity) < length(slowest->velocity)) slowest = &near;
        }
        if (!moving) return false;
        const Vec v = Support::against_velocity(state.v, nears_, touched).following(state.v);
        const T noise = 1024 * (speed_noise(state) + hidden_speed(moving->velocity));
        const auto is_left = [&](const Near& near) {
            return !touched(near) || leaving(near, v) >= -noise;
        };
        if (std::ranges::all_of(nears_, is_left)) return false;
        const Vec before = state.v;
        state.v = slowest->velocity;
        report(Meeting::crushed, *moving, start_, state, before);
        for (Near& near : nears_)
            if (near.obstacle.course.moves() && touched(near)) near.passed = true;
        return true;
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
    /// Moves a body by a part of the step in which it does not bounce and does not rub, where its
    /// impacts between obstacles that move have no end. This has order 1.
    void squeeze(State& state) {
        const T tau = std::min(left_, duration_ / squeezed_parts);
        const Vec a = body_.accelerate(state, start_);
        const Vec v = state.v + a * tau;
        const auto touched = [&](const Near& near) { return touches(near, state); };
        state.v = Support::against_velocity(v, nears_, touched).following(v);
        const auto move = [&](T part) { return State{state.x + state.v * part, state.v}; };
        Leg leg{move(tau), tau};
        for (Near& near : nears_)
            if (!touched(near)) end_at_impact(near, state, a, leg, move);
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
        } else if (kept * kept <= 2 * pull * gap_noise(near, state)) {
            state.v = along;
            report_rest(near, state, support, a, T(0));
        } else if (flight < shortest_flight * left_) {
            // Without its normal speed, the body may rest on further obstacles, or go into one.
            State sliding{state.x, along};
            const auto carried = bearing(sliding, a);
            if (!carried.has(near) || enters_other(sliding, carried)) return;
            T tau = stay_on(sliding, carried);
            if (sliding.v == Vec{} && left_ > 0) tau += stay_on(sliding, carried);
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
                const T depth = -std::min(gap_at(near, leg.end.x, leg.tau), T(0));
                leg.end.x += normal(near.obstacle,
                                    place_beside(near.obstacle, leg.end.x, start_ + leg.tau)) *
                             depth;
            }
        advance(state, leg);
    }

    /// Steps a body on the obstacles that bear it, and returns the time until that ends, s.
    T stay_on(State& state, const Support& support) {
        rest_on(support, state);
        const Vec a = pressing(support, state);
        if (sticks(support, state, a)) return stick(state, support, a);
        const bool on_curve = support.size() == 1 && is_round(near_of(support).sides);
        return on_curve ? follow_curve(state, near_of(support), support, a)
                        : slide(state, support, a);
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
        if (tau == 0 || !course.accelerates()) return a;
        return a - (course.acceleration_at(start_ + tau) - course.acceleration_at(start_));
    }
    /// The acceleration of a body that is not held by friction, relative to the surface, m/s².
    [[nodiscard]] Vec pull_along(const Support& support, const Vec& a, T tau = 0) const {
        const Vec pull = support.without_push(as_of_now(support, a, tau));
        const Course<T, Axes>& course = near_of(support).obstacle.course;
        return course.accelerates() ? pull - course.acceleration_at(start_) : pull;
    }
    /// Grip minus the pull along the obstacles, m/s²; negative if friction does not hold the body.
    [[nodiscard]] T surplus_of_grip(const Support& support, const Vec& a, T tau = 0) const {
        return support.grip(as_of_now(support, a, tau)) + 4 * epsilon * largest(a) -
               length(pull_along(support, a, tau));
    }
    [[nodiscard]] bool sticks(const Support& support, const State& state, const Vec& a) const {
        return state.v == carrier(support) && surplus_of_grip(support, a) >= 0;
    }
    [[nodiscard]] static bool stands(const Support& support) {
        for (std::size_t i = 0; i < support.size(); ++i)
            if (near_of(support, i).is_moved()) return false;
        return true;
    }
    /// Holds a body at rest, or where its obstacle carries it, until the forces let it slide or
    /// take it off.
    T stick(State& state, const Support& support, const Vec& a) {
        const bool stays = stands(support);
        const auto move = [&](T tau) {
            return stays ? state : State{state.x + carried(support, tau), carrier(support, tau)};
        };
        Leg leg{move(left_), left_};
        if (any_renewed_) end_at_others(state, support, a, leg, move);
        if (!body_.forces_change() && !near_of(support).obstacle.course.accelerates()) {
            settled_ = stays && leg.tau == left_;
            return advance(state, leg);
        }
        const auto held = [&](const State& there, T tau) {
            const Vec pull = pressing(support, there, tau);
            return std::min(surplus_of_grip(support, pull, tau),
                            least_reaction(support, pull, tau));
        };
        end_where_negative(held, std::max(held(state, T(0)), T(0)), leg, move);
        return advance(state, leg);
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
    /// Whether the body goes into an obstacle that it touches and that does not bear it.
    [[nodiscard]] bool enters_other(const State& state, const Support& support) const {
        return std::any_of(nears_.begin(), nears_.end(), [&](const Near& near) {
            return !support.has(near) && goes_into(near, state);
        });
    }
    T slide(State& state, const Support& support, const Vec& a) {
        if (enters_other(state, support)) return 0;
        const Vec rest = carrier(support);
        const Vec v = state.v - rest;
        const Vec pull = pull_along(support, a);
        const Vec direction = normalised(v == Vec{} ? pull : v);
        const T grip = support.grip(a);
        const bool free_to_turn = grip > 0 && support.size() + 2 <= Axes;
        const Friction<T, Axes> friction{direction, rest, free_to_turn && is_across(v, pull)};
        const auto move = [&](T tau) {
            State end = body_.slide(state, start_, tau, support, friction);
            if (!stands(support)) stay_beside(support, tau, end);
            return end;
        };
        if (free_to_turn && v != Vec{} && dot(pull, pull) < grip * grip)
            if (const auto end = slide_end(v, pull, grip); end.time <= left_) {
                Leg leg{
                    {state.x + end.way + carried(support, end.time), carrier(support, end.time)},
                    end.time};
                end_at_others(state, support, a, leg, move);
                return advance(state, leg);
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
        return advance(state, leg);
    }
    /// Moves the end of a slide of `tau` s onto the moving obstacles, with their normal speeds.
    void stay_beside(const Support& support, T tau, State& end) const {
        for (std::size_t i = 0; i < support.size(); ++i) {
            const Near& near = near_of(support, i);
            end.x -= near.normal * gap_at(near, end.x, tau);
            const Vec surface = surface_velocity(near.obstacle, near.normal, start_ + tau);
            end.v -= near.normal * dot(near.normal, end.v - surface);
        }
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

    /// One step of `tau` s on the curve of an obstacle: a push along its normal, of a size that
    /// lets a free step end on the curve, then the rest of the normal speed is taken away. This is
    /// RATTLE (Andersen, 1983) with any method for its free step, and has order min(order, 2).
    /// Friction is not limited in each of both parts, because only their sum is positive.
    [[nodiscard]] State hop(const State& state, const Near& near, T reaction, T tau) {
        const Vec back = normalised(state.v - near.velocity) * near.friction;
        const auto pushed = [&](T push) {
            return body_.fly({state.x, state.v + (near.normal - back) * push}, start_, tau);
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
        end.v = along - normalised(along - there.velocity) * (near.friction * last);
        return end;
    }
    T follow_curve(State& state, const Near& near, const Support& support, const Vec& a) {
        if (enters_other(state, support)) return 0;
        const Vec pull = pull_along(support, a);
        if (state.v == near.velocity) state.v += normalised(pull) * speed_noise(state);
        const T reaction = support.reactions(a).axis[0];
        const auto move = [&](T tau) { return hop(state, near, reaction, tau); };
        const T speed = length(state.v - near.velocity) + length(pull) * left_;
        const T most = most_turn * (near.obstacle.rounding + radius_) / speed;
        const T tau = std::min(left_, most);
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
        if (near.friction > 0 &&
            end_where_negative(forwards, length(state.v - near.velocity), leg, move))
            leg.end.v = surface(leg.end, leg.tau);
        return advance(state, leg);
    }

    template <class Move>
    void end_at_impact(Near& near, const State& state, const Vec& a, Leg& leg, Move move) {
        const bool is_fixed_plane =
            !near.obstacle.bounded && !near.obstacle.course.moves() && !near.obstacle.is_one_way();
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
        const T hidden = from.gap > noise ? T(0) : noise;
        const auto above = [&](T tau) {
            GapAt<T> one = at(tau);
            one.gap += hidden;
            return one;
        };
        from.gap += hidden;
        to.gap += hidden;
        const auto found = FirstCrossing<T, decltype(above)>(above, most, noise).between(from, to);
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

    std::span<Near> nears_;
    T way_;  ///< m
    T radius_;
    Body& body_;
    Report report_;
    bool any_renewed_ = false;
    bool any_moves_ = false;
    bool any_moved_ = false;  ///< also by a belt
    T duration_ = 0;          ///< s, of the step
    T start_ = 0;             ///< s, from the start of the step
    T left_ = 0;              ///< s
    int bounces_at_once_ = 0;
    int followed_ = 0;
    int crowded_ = 0;        ///< instants of the step with too many impacts
    bool squeezed_ = false;  ///< the body moves by parts of the step
    bool settled_ = false;
    std::optional<ImpactOf<T, Axes>> rest_;  ///< predicted, unless an event comes before
    std::size_t resting_on_ = 0;             ///< the index in `nears_` of the predicted rest
    /// The speed and the distance that round-off hides in a step from rest.
    struct {
        T speed = 0;     ///< m/s
        T distance = 0;  ///< m
    } hidden_;
};

}  // namespace oiler
