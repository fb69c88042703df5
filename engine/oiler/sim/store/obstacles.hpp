// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "oiler/core/copy_on_write.hpp"
#include "oiler/physics/contacts/near.hpp"
#include "oiler/physics/rate.hpp"
#include "oiler/sim/store/standing_obstacles.hpp"

namespace oiler {

/// The motion of an obstacle over several steps: a velocity and an oscillation from a place at an
/// earlier tick, or the next place that the game has given.
template <std::floating_point T, int Axes>
struct ObstacleMotion {
    using Vec = oiler::Vec<T, Axes>;

    /// A motion to a place within one step.
    struct Move {
        Vec to{};                            ///< m, of the centre
        std::optional<Vec> arrival{};        ///< m/s; absent: with the velocity of a straight way
        std::optional<std::int64_t> tick{};  ///< of the step; absent until it is taken
        Vec departure{};                     ///< m/s
    };

    ObstacleOf<T, Axes> from{};  ///< at tick `since`
    std::int64_t since = 0;
    Vec velocity{};        ///< m/s
    Vec sway{};            ///< m
    double frequency = 0;  ///< Hz
    double turns = 0;      ///< phase at time 0, in turns
    Vec jump{};            ///< m/s, of the velocity at tick `since`
    std::optional<Move> move{};
};

/// The obstacles of a world, by slot. The place of a moving one is computed from its place at an
/// earlier tick and the time, so that it does not depend on the number of steps per call.
template <std::floating_point T, int Axes>
class Obstacles {
public:
    using Vec = oiler::Vec<T, Axes>;
    using Obstacle = ObstacleOf<T, Axes>;
    using Motion = ObstacleMotion<T, Axes>;

    /// A ball that a moving obstacle stays in during a step, m.
    struct Ball {
        Vec centre{};
        T reach = 0;

        [[nodiscard]] bool is_near(const Vec& x, T most) const {
            const T distance = reach + most;
            return squared_length(x - centre) <= distance * distance;
        }
    };

    [[nodiscard]] bool empty() const { return standing_->empty() && motions_.empty(); }
    [[nodiscard]] bool any_moves() const { return !motions_.empty(); }
    [[nodiscard]] bool any_bounded() const {
        return standing_->any_boxes() || std::ranges::any_of(motions_, [](const auto& one) {
                   return one.second.from.bounded;
               });
    }
    [[nodiscard]] const StandingObstacles<T, Axes>& standing() const { return *standing_; }

    /// Adds an obstacle where it is now, or replaces one. The motion begins with the next step.
    void set(std::size_t slot, const Obstacle& to, const Motion& motion) {
        remove(slot);
        if (motion.velocity == Vec{} && motion.sway == Vec{}) {
            standing_.write().add(slot, to);
        } else {
            Motion& moving = motions_[slot] = motion;
            moving.from = to;
            moving.since = tick_;
        }
    }
    void remove(std::size_t slot) {
        motions_.erase(slot);
        if (standing_->has(slot)) standing_.write().remove(slot);
    }
    /// Changes the velocity from the next step on.
    void set_velocity(std::size_t slot, const Vec& velocity) {
        const Vec before = velocity_now(slot);
        Motion& motion = stopped(slot);
        motion.velocity = velocity;
        motion.jump = velocity - before;
    }
    /// Lets the obstacle arrive at a place at the end of the next step, and stand there.
    void move(std::size_t slot, const Vec& to, const std::optional<Vec>& arrival) {
        const Vec departure = velocity_now(slot);
        stopped(slot).move = {to, arrival, std::nullopt, departure};
    }
    void teleport(std::size_t slot, const Vec& to) {
        const Obstacle from = at_rest(slot);
        set(slot, displaced(from, to - from.centre), {});
    }

    /// The obstacle at tick `tick`, with its course over the step from there.
    [[nodiscard]] Obstacle at(std::size_t slot, std::int64_t tick) const {
        const auto found = motions_.find(slot);
        return found == motions_.end() ? (*standing_)[slot] : at(found->second, tick);
    }
    /// The obstacle after the last step.
    [[nodiscard]] Obstacle now(std::size_t slot) const { return at(slot, tick_); }

    /// The motion of an obstacle; none of one that stands.
    [[nodiscard]] const Motion* motion(std::size_t slot) const {
        const auto found = motions_.find(slot);
        return found == motions_.end() ? nullptr : &found->second;
    }
    /// Its velocity at the end of the last step, m/s.
    [[nodiscard]] Vec velocity_now(std::size_t slot) const {
        const auto found = motions_.find(slot);
        if (found == motions_.end()) return {};
        if (const auto& move = found->second.move)
            return move->tick && tick_ == *move->tick + 1 ? -now(slot).course.jump : Vec{};
        return now(slot).course.velocity_at(T(0));
    }
    [[nodiscard]] std::int64_t tick() const { return tick_; }
    [[nodiscard]] double time() const { return rate_.time(tick_); }
    [[nodiscard]] T dt() const { return rate_.template dt<T>(); }

    /// Begins steps from a tick on. With another rate or tick than after the last steps, moving
    /// obstacles go on from where they are.
    void begin(const Rate& rate, std::int64_t tick) {
        if (!(rate == rate_ && tick == tick_)) {
            for (auto& [slot, motion] : motions_) go_on_from(motion, tick);
            rate_ = rate;
            tick_ = tick;
        }
        for (auto it = motions_.begin(); it != motions_.end();) {
            auto& [slot, motion] = *it++;
            if (motion.move && !motion.move->tick) motion.move->tick = tick;
            if (has_ended(motion)) set(slot, at_rest(slot), {});
        }
        if (standing_->is_listed_long()) standing_.write().build();
    }
    void end(std::int64_t tick) { tick_ = tick; }

    /// Adds the obstacles that are no standing half-spaces, where they are.
    void hash_into(StateHash& hash) const {
        std::uint64_t sum = standing_->digest();
        for (const auto& [slot, motion] : motions_) {
            const Vec v = velocity_now(slot);
            if (motion.from.bounded || v != Vec{}) sum += digest_of(slot, now(slot));
            StateHash of_motion;
            for (const T& number : v.axis) of_motion.add(static_cast<double>(number));
            if (v != Vec{}) sum += of_motion.value();
        }
        if (sum != 0) hash.add(sum);
    }

    [[nodiscard]] bool any_half_space_moves() const {
        return std::ranges::any_of(motions_,
                                   [](const auto& one) { return !one.second.from.bounded; });
    }
    /// Lists the balls of the moving boxes in a step of `dt` s from tick `tick`.
    void list_moving(std::int64_t tick, T dt, std::vector<Ball>& balls) const {
        balls.clear();
        for (const auto& [slot, motion] : motions_)
            if (motion.from.bounded) balls.push_back(ball_of(at(motion, tick), dt));
    }
    /// Lists the obstacles in the layers `meets` that a body of `radius` m gets near within `way` m
    /// of x, in a step of `dt` s from tick `tick`, in the order of their slots.
    void find_near(const Vec& x, T way, T radius, std::uint32_t meets, std::int64_t tick, T dt,
                   std::vector<Near<T, Axes>>& nears) const {
        nears.clear();
        const auto add = [&](const Obstacle& one, std::size_t slot) {
            if ((one.layers & meets) != 0) nears.emplace_back(one, slot);
        };
        const T most = way + radius + hidden_way(x, radius);
        for (const std::size_t slot : standing_->half_spaces()) add((*standing_)[slot], slot);
        const std::size_t sorted = nears.size();
        standing_->for_each_box_near(x, most, [&](std::size_t slot, const Obstacle& box) {
            if (gap(box, x, most) <= hidden_way(box.centre, reach(box))) add(box, slot);
        });
        for (const auto& [slot, motion] : motions_) {
            const Obstacle moving = at(motion, tick);
            if (!moving.bounded || ball_of(moving, dt).is_near(x, most)) add(moving, slot);
        }
        if (nears.size() == sorted) return;
        std::ranges::sort(nears, {}, &Near<T, Axes>::index);
        const auto is_same = [](const auto& a, const auto& b) { return a.index == b.index; };
        nears.erase(std::unique(nears.begin(), nears.end(), is_same), nears.end());
    }
    /// Calls f(slot, obstacle) for each obstacle within `most` m of x after the last step, for some
    /// of them several times, and for some that are farther.
    template <class F>
    void for_each_now(const Vec& x, T most, F f) const {
        for (const std::size_t slot : standing_->half_spaces()) f(slot, (*standing_)[slot]);
        standing_->for_each_box_near(x, most, f);
        for (const auto& [slot, motion] : motions_) f(slot, at(motion, tick_));
    }
    /// The distance that round-off hides of a body of `radius` m at x, m.
    [[nodiscard]] static T hidden_way(const Vec& x, T radius) {
        return 16 * std::numeric_limits<T>::epsilon() * (largest(x) + radius);
    }

private:
    [[nodiscard]] static Ball ball_of(const Obstacle& box, T dt) {
        return {box.centre,
                reach(box) + hidden_way(box.centre, T(0)) + box.course.most_speed(dt) * dt};
    }
    [[nodiscard]] static Obstacle displaced(Obstacle obstacle, const Vec& way) {
        obstacle.centre += way;
        obstacle.surface.offset += dot(obstacle.surface.normal, way);
        return obstacle;
    }
    [[nodiscard]] Obstacle at(const Motion& motion, std::int64_t tick) const {
        if (motion.move) return at(motion.from, *motion.move, tick);
        const auto elapsed = static_cast<T>(rate_.time(tick - motion.since));
        const auto phase = phase_at(motion, tick);
        Obstacle obstacle =
            displaced(motion.from, motion.velocity * elapsed + motion.sway * sine_of_turns(phase));
        obstacle.course = {.velocity = motion.velocity,
                           .sway = motion.sway,
                           .frequency = static_cast<T>(motion.frequency),
                           .turns = phase,
                           .jump = tick == motion.since ? motion.jump : Vec{}};
        return obstacle;
    }
    /// The phase of an oscillation, in turns. Round-off that grew with time would part an obstacle
    /// from its rider.
    [[nodiscard]] T phase_at(const Motion& motion, std::int64_t tick) const {
        const auto seconds = static_cast<double>(tick * rate_.seconds);
        const auto steps = static_cast<double>(rate_.steps);
        const double product = motion.frequency * seconds;
        const double lost = std::fma(motion.frequency, seconds, -product);
        const double quotient = product / steps;
        const double rest = std::fma(-quotient, steps, product) + lost;
        const double turns = motion.turns + (quotient - std::floor(quotient)) + rest / steps;
        return static_cast<T>(turns - std::floor(turns));
    }
    /// An obstacle that arrives at a place in the step from one tick, and stands later.
    [[nodiscard]] Obstacle at(const Obstacle& from, const typename Motion::Move& move,
                              std::int64_t tick) const {
        const Vec way = move.to - from.centre;
        const T dt = rate_.template dt<T>();
        const Vec& v = move.departure;
        const Vec mean = way / dt;
        // Round-off of the places, and of a game that computes them in double, does not change the
        // velocity of an obstacle that goes on evenly.
        constexpr T round_off =
            std::numeric_limits<T>::epsilon() + 3 * T(std::numeric_limits<double>::epsilon());
        const T noise = round_off * (largest(from.centre) + largest(move.to)) / dt;
        const auto is_as_before = [&](const Vec& one) { return largest(one - v) <= noise; };
        const bool goes_on = is_as_before(mean) && is_as_before(move.arrival.value_or(mean));
        const Vec straight = goes_on ? v : mean;
        const bool is_straight = goes_on || !move.arrival;
        if (!move.tick || tick < *move.tick) return from;
        if (tick > *move.tick) {
            Obstacle there = displaced(from, way);
            if (tick == *move.tick + 1)
                there.course.jump = -(is_straight ? straight : *move.arrival);
            return there;
        }
        Obstacle moving = from;
        if (is_straight) {
            moving.course = {.velocity = straight, .jump = straight - v};
        } else {
            // The cubic through both places with both velocities.
            const Vec& arrival = *move.arrival;
            moving.course = {.velocity = v,
                             .acceleration = (straight * T(6) - v * T(4) - arrival * T(2)) / dt,
                             .jerk = (v + arrival - straight * T(2)) * T(6) / (dt * dt)};
        }
        return moving;
    }
    /// The obstacle where it is, without its motion.
    [[nodiscard]] Obstacle at_rest(std::size_t slot) const {
        Obstacle obstacle = now(slot);
        obstacle.course = {};
        return obstacle;
    }
    /// Whether the obstacle stands from now on, without a change of its velocity.
    [[nodiscard]] bool has_ended(const Motion& motion) const {
        if (motion.move) return motion.move->tick && tick_ > *motion.move->tick + 1;
        return motion.velocity == Vec{} && motion.sway == Vec{} && motion.since < tick_;
    }
    /// A new motion of an obstacle, from rest where it is.
    Motion& stopped(std::size_t slot) {
        const Obstacle from = at_rest(slot);
        remove(slot);
        return motions_[slot] = {.from = from, .since = tick_};
    }
    void go_on_from(Motion& motion, std::int64_t tick) {
        if (motion.move && !motion.move->tick) return;
        Obstacle from = at(motion, tick_);
        from.course = {};
        // The oscillation goes on by the time of the world.
        if (motion.sway != Vec{})
            from = displaced(from, motion.sway * -sine_of_turns(phase_at(motion, tick_)));
        motion.from = from;
        motion.since = tick;
        motion.move.reset();
    }

    CopyOnWrite<StandingObstacles<T, Axes>> standing_;
    std::map<std::size_t, Motion> motions_{};  ///< by slot, of those that move
    Rate rate_{};
    std::int64_t tick_ = 0;
};

}  // namespace oiler
