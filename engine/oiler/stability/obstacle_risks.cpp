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

Vec3 centre_of(const CircleShape& circle) { return circle.centre; }
Vec3 centre_of(const SegmentShape& segment) { return (segment.from + segment.to) / 2; }
Vec3 centre_of(const BoxShape& box) { return box.centre; }
Vec3 centre_of(const HalfSpaceShape&) { return {}; }

/// "(1, 2.5)".
std::string place(const Vec3& x, int axes) {
    std::string at;
    for (int i = 0; i < axes; ++i) at += fmt::format("{}{:.4g}", i > 0 ? ", " : "", x[i]);
    return fmt::format("({})", at);
}

/// "the box at (1, 2.5)".
std::string describe(const Shape& shape, int axes) {
    return std::visit(
        [&](const auto& one) {
            return fmt::format("the {} at {}", name_of(one), place(centre_of(one), axes));
        },
        shape);
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

/// The place to which a first step lifts a body at rest out of all obstacles, m.
Vec3 lifted(const Bodies& bodies, std::size_t row) {
    Bodies copy(bodies.axes(), bodies.precision());
    copy.add({.position = bodies.position(row), .contact = bodies.contact(row)});
    for (const ObstacleHandle handle : bodies.obstacles())
        copy.add_obstacle(bodies.obstacle(handle));
    const auto diverged =
        copy.try_step(find_method("velocity_verlet"), {.rate = {StepClock::largest_rate}});
    return diverged ? bodies.position(row) : copy.position(0);
}

std::string start_inside(const Bodies& bodies, std::size_t row, const Obstacle& obstacle,
                         double depth) {
    const Vec3 to = lifted(bodies, row);
    return fmt::format(
        "body {{}} starts {:.3g} m inside {}, and is lifted out at once, by {:.3g} m to {}: move "
        "it",
        depth, describe(obstacle.shape, bodies.axes()), length(to - bodies.position(row)),
        place(to, bodies.axes()));
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
    const std::size_t rows = std::min(bodies.size(), most_pairs / obstacles.size());
    for (std::size_t row = 0; row < rows; ++row) {
        const auto contact = bodies.contact(row);
        if (!contact) continue;
        if (contact->radius == 0 && any_segment)
            tell(row,
                 "body {} is a point, which passes segments: give its contact a radius above 0");
        const Vec3 x = bodies.position(row);
        for (const Obstacle& obstacle : obstacles) {
            const double inside = -gap(obstacle.shape, x, contact->radius, bodies.axes());
            if (!(inside > hidden * (largest(x) + contact->radius))) continue;
            tell(row, start_inside(bodies, row, obstacle, inside));
            break;
        }
    }
}

}  // namespace oiler
