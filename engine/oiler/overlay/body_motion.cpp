// SPDX-License-Identifier: MIT
#include "oiler/overlay/body_motion.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "oiler/game/look.hpp"
#include "oiler/overlay/help.hpp"
#include "oiler/picture/shapes.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

State<double, 3> state_of(const Bodies& bodies, std::size_t row) {
    return {bodies.position(row), bodies.velocity(row)};
}

Vec3 acceleration_by_forces(const Bodies& bodies, std::size_t row, double time) {
    const State<double, 3> state = state_of(bodies, row);
    Vec3 sum{};
    for_each_force_on(bodies, row, [&](const auto& force) {
        if (acts(force)) sum = sum + accelerate(force, state, time);
    });
    return sum;
}

/// The force, N, of a link on its first end.
Vec3 force_of(const Bodies& bodies, std::size_t link) {
    const LinkEnds ends = bodies.link_ends(link);
    const Link numbers = bodies.link_at(link);
    const State<double, 3> first = state_of(bodies, ends.row);
    const State<double, 3> other =
        ends.other ? state_of(bodies, *ends.other) : State<double, 3>{ends.point, {}};
    const State<double, 3> between{first.x - other.x, first.v - other.v};
    if (numbers.rest_length == 0)
        return between.x * -numbers.stiffness - between.v * numbers.damping;
    return CoilSpring{{}, numbers.stiffness, numbers.damping, numbers.rest_length}.accelerate(
        between, 0);
}

}  // namespace

std::vector<BodyMotion> motions_of(const World& world, const std::vector<Entity>& bodies) {
    const Bodies& all = world.bodies();
    std::vector<BodyMotion> motions;
    std::unordered_map<std::size_t, std::size_t> place_of_row;
    for (const Entity body : bodies) {
        const std::size_t row = world.row(body);
        place_of_row[row] = motions.size();
        motions.push_back({body, all.position(row), all.velocity(row),
                           acceleration_by_forces(all, row, world.time())});
    }
    const auto push = [&](std::size_t row, const Vec3& force) {
        if (const auto found = place_of_row.find(row); found != place_of_row.end()) {
            Vec3& sum = motions[found->second].acceleration;
            sum = sum + force / all.mass(row);
        }
    };
    for (std::size_t i = 0; i < all.link_count(); ++i) {
        const LinkEnds ends = all.link_ends(i);
        const bool is_wanted =
            place_of_row.contains(ends.row) || (ends.other && place_of_row.contains(*ends.other));
        if (!is_wanted) continue;
        const Vec3 force = force_of(all, i);
        push(ends.row, force);
        if (ends.other) push(*ends.other, -force);
    }
    return motions;
}

std::vector<BodyMotion> between(const std::vector<BodyMotion>& before,
                                const std::vector<BodyMotion>& after, double alpha) {
    const auto mix = [&](const Vec3& from, const Vec3& to) { return from + (to - from) * alpha; };
    std::vector<BodyMotion> motions;
    for (const BodyMotion& to : after) {
        const auto from = std::ranges::find(before, to.body, &BodyMotion::body);
        if (from == before.end()) continue;
        motions.push_back({to.body, mix(from->position, to.position),
                           mix(from->velocity, to.velocity),
                           mix(from->acceleration, to.acceleration)});
    }
    return motions;
}

double largest(const std::vector<BodyMotion>& motions, Vec3 BodyMotion::*vector) {
    double most = 0;
    for (const BodyMotion& motion : motions) {
        const Vec3& one = motion.*vector;
        most = std::max(most, std::hypot(one[0], one[1], one[2]));
    }
    return most;
}

void add_arrows(Picture& picture, const DrawnBodies& bodies, const std::vector<BodyMotion>& motions,
                Vec3 BodyMotion::*vector, double per_metre, Colour colour) {
    const float width = 2 * picture.camera.height / canvas_height;
    for (const BodyMotion& motion : motions) {
        const DrawnBodies::Body* const body = bodies.find(motion.body);
        const Point from = body ? body->centre : to_point(motion.position);
        const Point way = to_point(motion.*vector / per_metre);
        if (!std::isfinite(way.x) || !std::isfinite(way.y)) continue;
        picture.polygons.push_back({.points = arrow(from, {from.x + way.x, from.y + way.y}, width),
                                    .colour = colour,
                                    .layer = overlay_layer});
    }
}

}  // namespace oiler
