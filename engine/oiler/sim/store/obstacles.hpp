// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "oiler/core/state_hash.hpp"
#include "oiler/physics/contacts/near.hpp"
#include "oiler/physics/rate.hpp"

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

    std::int64_t since = 0;  ///< the tick at which the obstacle is stored
    Vec velocity{};          ///< m/s
    Vec sway{};              ///< m
    double frequency = 0;    ///< Hz
    double turns = 0;        ///< phase at time 0, in turns
    Vec jump{};              ///< m/s, of the velocity at tick `since`
    std::optional<Move> move{};
};

/// The obstacles of a world, in the order of their slots; removed ones have no layers. The place of
/// a moving one is computed from its place at an earlier tick and the time, so that it does not
/// depend on the number of steps per call.
template <std::floating_point T, int Axes>
class Obstacles {
public:
    using Vec = oiler::Vec<T, Axes>;
    using Obstacle = ObstacleOf<T, Axes>;
    using Motion = ObstacleMotion<T, Axes>;

    [[nodiscard]] bool empty() const { return count_ == 0; }
    [[nodiscard]] bool any_moves() const { return !motions_.empty(); }
    [[nodiscard]] bool any_bounded() const { return bounded_ > 0; }
    [[nodiscard]] std::size_t slots() const { return all_.size(); }

    /// Adds an obstacle where it is now, or replaces one. The motion begins with the next step.
    void set(std::size_t slot, const Obstacle& to, const Motion& motion) {
        if (slot >= all_.size()) {
            all_.resize(slot + 1, removed());
            balls_.resize(slot + 1);
        }
        count(slot, all_[slot], -1);
        all_[slot] = to;
        count(slot, to, +1);
        motions_.erase(slot);
        if (motion.velocity != Vec{} || motion.sway != Vec{}) {
            motions_[slot] = motion;
            motions_[slot].since = tick_;
        }
        renew_ball(slot);
    }
    void remove(std::size_t slot) { set(slot, removed(), {}); }
    /// Changes the velocity from the next step on.
    void set_velocity(std::size_t slot, const Vec& velocity) {
        const Vec before = velocity_now(slot);
        stop(slot);
        Motion& motion = motions_[slot];
        motion.velocity = velocity;
        motion.jump = velocity - before;
    }
    /// Lets the obstacle arrive at a place at the end of the next step, and stand there.
    void move(std::size_t slot, const Vec& to, const std::optional<Vec>& arrival) {
        const Vec departure = velocity_now(slot);
        stop(slot);
        motions_[slot].move = {to, arrival, std::nullopt, departure};
    }
    void teleport(std::size_t slot, const Vec& to) {
        stop(slot);
        motions_.erase(slot);
        all_[slot] = displaced(all_[slot], to - all_[slot].centre);
        renew_ball(slot);
    }

    /// The obstacle at tick `tick`, with its course over the step from there.
    [[nodiscard]] Obstacle at(std::size_t slot, std::int64_t tick) const {
        const auto found = motions_.find(slot);
        if (found == motions_.end()) return all_[slot];
        const Motion& motion = found->second;
        if (motion.move) return at(all_[slot], *motion.move, tick);
        const auto elapsed = static_cast<T>(rate_.time(tick - motion.since));
        const double turns = motion.turns + motion.frequency * rate_.time(tick);
        const auto phase = static_cast<T>(turns - std::floor(turns));
        Obstacle obstacle =
            displaced(all_[slot], motion.velocity * elapsed + motion.sway * sine_of_turns(phase));
        obstacle.course = {.velocity = motion.velocity,
                           .sway = motion.sway,
                           .frequency = static_cast<T>(motion.frequency),
                           .turns = phase,
                           .jump = tick == motion.since ? motion.jump : Vec{}};
        return obstacle;
    }
    /// The obstacle after the last step.
    [[nodiscard]] Obstacle now(std::size_t slot) const { return at(slot, tick_); }

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
            for (auto& [slot, motion] : motions_) go_on_from(slot, motion, tick);
            rate_ = rate;
            tick_ = tick;
        }
        for (auto it = motions_.begin(); it != motions_.end();) {
            auto& [slot, motion] = *it++;
            if (motion.move && !motion.move->tick) motion.move->tick = tick;
            if (has_ended(motion)) set(slot, standing(slot), {});
        }
    }
    void end(std::int64_t tick) { tick_ = tick; }

    /// Adds the obstacles that are no standing half-spaces, where they are.
    void hash_into(StateHash& hash) const {
        for (std::size_t slot = 0; slot < all_.size(); ++slot) {
            if (all_[slot].layers == 0) continue;
            const Obstacle now = this->now(slot);
            if (!now.bounded && !now.course.moves()) continue;
            const auto numbers = [&](const Vec& vector) {
                for (const T& one : vector.axis) hash.add(static_cast<double>(one));
            };
            hash.add(slot);
            for (const T one : {now.surface.offset, now.surface.restitution, now.surface.friction,
                                now.rounding, now.belt})
                hash.add(static_cast<double>(one));
            for (const Vec& vector : {now.centre, now.half, now.one_way, velocity_now(slot)})
                numbers(vector);
            for (const Vec& row : now.frame.row) numbers(row);
        }
    }

    /// Calls f(plane) for each half-space, as it stands without its motion.
    template <class F>
    void for_each_half_space(F f) const {
        for (const std::size_t slot : half_spaces_) f(all_[slot].surface);
    }
    [[nodiscard]] bool any_half_space_moves() const {
        return std::ranges::any_of(motions_,
                                   [&](const auto& one) { return !all_[one.first].bounded; });
    }
    /// Whether any box comes within `most` m of x in a step of `dt` s from tick `tick`.
    [[nodiscard]] bool any_box_near(const Vec& x, T most, std::int64_t tick, T dt) const {
        for (const Ball& ball : balls_)
            if (ball.is_near(x, most)) return true;
        for (const auto& [slot, motion] : motions_)
            if (all_[slot].bounded && ball_of(at(slot, tick), dt).is_near(x, most)) return true;
        return false;
    }
    /// Lists the obstacles that a body of `radius` m gets near within `way` m of x, in a step of
    /// `dt` s from tick `tick`, in the order of their slots.
    void find_near(const Vec& x, T way, T radius, std::int64_t tick, T dt,
                   std::vector<Near<T, Axes>>& nears) const {
        nears.clear();
        const T most = way + radius + hidden_way(x, radius);
        for (const std::size_t slot : half_spaces_) nears.emplace_back(at(slot, tick), slot);
        for (std::size_t slot = 0; slot < balls_.size(); ++slot)
            if (balls_[slot].is_near(x, most)) nears.emplace_back(all_[slot], slot);
        for (const auto& [slot, motion] : motions_) {
            if (!all_[slot].bounded) continue;
            const Obstacle moving = at(slot, tick);
            if (ball_of(moving, dt).is_near(x, most)) nears.emplace_back(moving, slot);
        }
        if (nears.size() > half_spaces_.size()) std::ranges::sort(nears, {}, &Near<T, Axes>::index);
    }
    /// The distance that round-off hides of a body of `radius` m at x, m.
    [[nodiscard]] static T hidden_way(const Vec& x, T radius) {
        return 16 * std::numeric_limits<T>::epsilon() * (largest(x) + radius);
    }

private:
    static Obstacle removed() {
        Obstacle none;
        none.layers = 0;
        return none;
    }
    /// A ball that a box stays in, m.
    struct Ball {
        Vec centre{};
        T reach = -std::numeric_limits<T>::infinity();

        [[nodiscard]] bool is_near(const Vec& x, T most) const {
            const T distance = reach + most;
            return distance >= 0 && squared_length(x - centre) <= distance * distance;
        }
    };
    [[nodiscard]] static Ball ball_of(const Obstacle& box, T dt) {
        const T round_off = 16 * std::numeric_limits<T>::epsilon() * largest(box.centre);
        return {box.centre, reach(box) + round_off + box.course.most_speed(dt) * dt};
    }
    void count(std::size_t slot, const Obstacle& one, int by) {
        if (one.layers == 0) return;
        count_ += by;
        bounded_ += one.bounded ? by : 0;
        if (one.bounded) return;
        const auto at = std::ranges::lower_bound(half_spaces_, slot);
        if (by > 0)
            half_spaces_.insert(at, slot);
        else
            half_spaces_.erase(at);
    }
    /// Lists a standing box among the balls.
    void renew_ball(std::size_t slot) {
        const bool stands =
            all_[slot].bounded && all_[slot].layers != 0 && !motions_.contains(slot);
        balls_[slot] = stands ? ball_of(all_[slot], T(0)) : Ball{};
    }
    [[nodiscard]] static Obstacle displaced(Obstacle obstacle, const Vec& way) {
        obstacle.centre += way;
        obstacle.surface.offset += dot(obstacle.surface.normal, way);
        return obstacle;
    }
    /// An obstacle that arrives at a place in the step from one tick, and stands later.
    [[nodiscard]] Obstacle at(const Obstacle& from, const typename Motion::Move& move,
                              std::int64_t tick) const {
        const Vec way = move.to - from.centre;
        const T dt = rate_.template dt<T>();
        const Vec straight = way / dt;
        const Vec arrival = move.arrival.value_or(straight);
        if (!move.tick || tick < *move.tick) return from;
        if (tick > *move.tick) {
            Obstacle there = displaced(from, way);
            if (tick == *move.tick + 1) there.course.jump = -arrival;
            return there;
        }
        Obstacle moving = from;
        if (!move.arrival) {
            moving.course = {.velocity = straight, .jump = straight - move.departure};
        } else {
            // The cubic through both places with both velocities.
            const Vec& v = move.departure;
            moving.course = {.velocity = v,
                             .acceleration = (straight * T(6) - v * T(4) - arrival * T(2)) / dt,
                             .jerk = (v + arrival - straight * T(2)) * T(6) / (dt * dt)};
        }
        return moving;
    }
    /// The obstacle where it is, without its motion.
    [[nodiscard]] Obstacle standing(std::size_t slot) const {
        Obstacle obstacle = now(slot);
        obstacle.course = {};
        return obstacle;
    }
    /// Whether the obstacle stands from now on, without a change of its velocity.
    [[nodiscard]] bool has_ended(const Motion& motion) const {
        if (motion.move) return motion.move->tick && tick_ > *motion.move->tick + 1;
        return motion.velocity == Vec{} && motion.sway == Vec{} && motion.since < tick_;
    }
    /// Lets the obstacle stand where it is.
    void stop(std::size_t slot) {
        all_[slot] = standing(slot);
        motions_[slot] = {.since = tick_};
        renew_ball(slot);
    }
    void go_on_from(std::size_t slot, Motion& motion, std::int64_t tick) {
        if (motion.move && !motion.move->tick) return;
        Obstacle standing = this->standing(slot);
        if (motion.sway != Vec{}) {
            // The oscillation goes on by the time of the world.
            const double turns = motion.turns + motion.frequency * rate_.time(tick_);
            const auto phase = static_cast<T>(turns - std::floor(turns));
            standing = displaced(standing, motion.sway * -sine_of_turns(phase));
        }
        all_[slot] = standing;
        motion.since = tick;
        motion.move.reset();
    }

    std::vector<Obstacle> all_;                ///< by slot
    std::vector<Ball> balls_;                  ///< by slot, of standing boxes
    std::vector<std::size_t> half_spaces_;     ///< slots, in order
    std::map<std::size_t, Motion> motions_{};  ///< by slot, of those that move
    int count_ = 0;
    int bounded_ = 0;
    Rate rate_{};
    std::int64_t tick_ = 0;
};

}  // namespace oiler
