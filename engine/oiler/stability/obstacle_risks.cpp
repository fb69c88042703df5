// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/stability/obstacle_gap.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

/// Limit of bodies × obstacles that are tried.
constexpr std::size_t most_pairs = 4'000'000;

std::string_view name_of(const CircleShape&) { return "circle"; }
std::string_view name_of(const SegmentShape&) { return "segment"; }
std::string_view name_of(const BoxShape&) { return "box"; }
std::string_view name_of(const HalfSpaceShape&) { return "plane"; }

/// "(1, 2.5)".
std::string place(const Vec3& x, int axes) {
    std::string at;
    for (int i = 0; i < axes; ++i) at += fmt::format("{}{:.4g}", i > 0 ? ", " : "", x[i]);
    return fmt::format("({})", at);
}

/// "the box at (1, 2.5)".
std::string describe(const Shape& shape, int axes) {
    const auto name = std::visit([](const auto& one) { return name_of(one); }, shape);
    return fmt::format("the {} at {}", name, place(centre_of(shape), axes));
}

std::vector<Obstacle> met_from_all_sides(const Bodies& bodies) {
    std::vector<Obstacle> met;
    for (const ObstacleHandle handle : bodies.obstacles()) {
        Obstacle one = bodies.obstacle(handle);
        const bool is_plane = std::holds_alternative<HalfSpaceShape>(one.shape);
        if (one.solid && !is_plane && !one.one_way) met.push_back(std::move(one));
    }
    return met;
}

/// A body that starts in an obstacle.
struct Inside {
    std::size_t row;
    const Obstacle* obstacle;
    double depth;  ///< m
};

/// The bodies after a first step from rest, which lifts them out of the obstacles. Where it
/// diverges, they are in place.
Bodies lifted(const Bodies& bodies, const std::vector<Inside>& all) {
    Bodies copy(bodies.axes(), bodies.precision());
    for (const Inside& one : all)
        copy.add({.position = bodies.position(one.row), .contact = bodies.contact(one.row)});
    const Bodies in_place = copy;
    for (const ObstacleHandle handle : bodies.obstacles())
        copy.add_obstacle(bodies.obstacle(handle));
    const auto diverged =
        copy.try_step(find_method("velocity_verlet"), {.rate = {StepClock::largest_rate}});
    return diverged ? in_place : copy;
}

std::string describe(const Inside& one, const Vec3& from, const Vec3& to, int axes) {
    return fmt::format(
        "body {{}} starts {:.3g} m inside {}, and is lifted out at once, by {:.3g} m to {}: move "
        "it",
        one.depth, describe(one.obstacle->shape, axes), length(to - from), place(to, axes));
}

bool is_segment(const Obstacle& obstacle) {
    return std::holds_alternative<SegmentShape>(obstacle.shape);
}

/// A swing of two steps or less per period, which moves between steps alone.
std::string fast_swing(const Obstacle& obstacle, const Rate& rate, int axes) {
    constexpr double enough = 4;
    const double steps_per_period = obstacle.swing->period / rate.dt();
    if (!(steps_per_period <= 2 * (1 + 1e-9))) return {};
    const double hertz = std::ceil(enough / obstacle.swing->period * (1 - 1e-9));
    return fmt::format(
        "{} swings with {:.3g} steps per period, and bodies on it may leave it late or not at all: "
        "{}",
        describe(obstacle.shape, axes), steps_per_period,
        hertz <= highest_rate ? fmt::format("rate ≥ {:.0f} Hz", hertz) : "give it a longer period");
}

void add_swing_risks(const Bodies& bodies, const Rate& rate, std::vector<Risk>& risks) {
    if (!meets_obstacles(bodies)) return;
    for (const ObstacleHandle handle : bodies.obstacles()) {
        const Obstacle one = bodies.obstacle(handle);
        if (!one.solid || !one.swing || squared_length(one.swing->way) == 0) continue;
        std::string message = fast_swing(one, rate, bodies.axes());
        if (!message.empty())
            risks.push_back({.row = 0, .of = Risk::Of::told, .message = std::move(message)});
    }
}

}  // namespace

void add_obstacle_risks(const Bodies& bodies, const Rate& rate, std::vector<Risk>& risks) {
    add_swing_risks(bodies, rate, risks);
    // Of the numbers of the gap.
    const double hidden = bodies.precision() == Precision::single ? 1e-6 : 1e-9;
    const std::vector<Obstacle> obstacles = met_from_all_sides(bodies);
    if (obstacles.empty()) return;
    const bool any_segment = std::ranges::any_of(obstacles, is_segment);
    const auto tell = [&](std::size_t row, std::string message) {
        risks.push_back({.row = row, .of = Risk::Of::told, .message = std::move(message)});
    };
    std::vector<Inside> all;
    const std::size_t rows = std::min(bodies.size(), most_pairs / obstacles.size());
    for (std::size_t row = 0; row < rows; ++row) {
        const auto contact = bodies.contact(row);
        if (!contact) continue;
        if (contact->radius == 0 && any_segment)
            tell(row,
                 "body {} is a point, which passes segments: give its contact a radius above 0");
        const Vec3 x = bodies.position(row);
        for (const Obstacle& obstacle : obstacles) {
            if ((contact->meets & obstacle.layers) == 0) continue;
            const double depth = -gap(obstacle.shape, x, contact->radius, bodies.axes());
            if (!(depth > hidden * (largest(x) + contact->radius))) continue;
            all.push_back({row, &obstacle, depth});
            break;
        }
    }
    if (all.empty()) return;
    const Bodies there = lifted(bodies, all);
    for (std::size_t i = 0; i < all.size(); ++i)
        tell(all[i].row,
             describe(all[i], bodies.position(all[i].row), there.position(i), bodies.axes()));
}

}  // namespace oiler
