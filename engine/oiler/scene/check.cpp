// SPDX-License-Identifier: MIT
#include "oiler/scene/check.hpp"

#include <algorithm>

#include "oiler/core/error.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/sim/limits.hpp"

namespace oiler {
namespace {

/// Adds place and key to the error that `f` throws.
template <class F>
void at(const Place& place, std::string_view key, F f) {
    try {
        f();
    } catch (const Error& error) {
        refuse(place, "{}: {}", key, error.what());
    }
}

/// Checks values against the limits of the scene's precision.
template <class... Checked>
void check_at(const Scene& scene, const Section& section, std::string_view key,
              const Checked&... checked) {
    at(section.place(key), fmt::format("{}.{}", section.name(), key),
       [&] { Limits(scene.stepping.precision, scene.axes).check(checked...); });
}

void check_size(const Scene& scene, const Section& section) {
    if (scene.body_count() > most_bodies)
        refuse(section.place("count"),
               "{}.count: expected at most {} bodies in the scene, got {}; give fewer",
               section.name(), most_bodies, scene.body_count());
}

/// Checks a box from `low` to `high`.
void check_box(const Scene& scene, const Section& section, std::string_view key, const Vec3& low,
               const Vec3& high) {
    check_numbers(scene, section, key, high);
    check_numbers(scene, section, key, high - low);
    for (int i = 0; i < scene.axes; ++i)
        if (high[i] < low[i])
            refuse(section.place(key), "{}.{}: expected at least {} along {}, got {}",
                   section.name(), key, low[i], axis_names[static_cast<std::size_t>(i)], high[i]);
}

}  // namespace

void check_number(const Scene& scene, const Section& section, std::string_view key, double number) {
    check_at(scene, section, key, number, key);
}

void check_numbers(const Scene& scene, const Section& section, std::string_view key,
                   const Vec3& vector) {
    check_at(scene, section, key, vector, key);
}

void check_matter(const Scene& scene, const Section& section, const SceneMatter& matter) {
    check_number(scene, section, "mass", matter.mass);
    check_at(scene, section, "mass", 1 / matter.mass, "the inverse mass");
    check_at(scene, section, "linear_drag", given(LinearDrag{matter.linear_drag}), matter.mass);
    check_at(scene, section, "quadratic_drag", given(QuadraticDrag{matter.quadratic_drag}),
             matter.mass);
    if (matter.contact) check_at(scene, section, "contact", Contact{*matter.contact});
}

void check_spring(const Scene& scene, const Section& section, const SceneSpring& spring) {
    const double mass = scene.bodies[spring.body].matter.mass;
    check_numbers(scene, section, "anchor", spring.anchor);
    check_at(scene, section, "stiffness", given(Spring{.stiffness = spring.stiffness}), mass);
    check_at(scene, section, "damping", given(Spring{.damping = spring.damping}), mass);
    check_at(scene, section, "rest_length",
             Link{spring.stiffness, spring.damping, spring.rest_length});
}

void check_force(const Scene& scene, const Section& section, const SceneForce& force) {
    const double mass = scene.bodies[force.body].matter.mass;
    std::visit(
        [&]<class Force>(const Force& all) {
            for_each_field<Force>([&](const auto& field) {
                Force one{};
                one.*field.member = all.*field.member;
                check_at(scene, section, field.key, given(one), mass);
            });
        },
        force.force);
}

void check_plane(const Scene& scene, const Section& section, const Plane& plane) {
    if (scene.planes.size() > most_planes)
        refuse(section.place(), "plane: expected at most {} planes; leave some out", most_planes);
    check_at(scene, section, "normal", Plane{.normal = plane.normal});
    check_at(scene, section, "offset", Plane{.normal = plane.normal, .offset = plane.offset});
    check_at(scene, section, "friction", plane);
}

void check_grid(const Scene& scene, const Section& section, const SceneGrid& grid) {
    check_size(scene, section);
    if (scene.axes == 1 && grid.count[1] > 1)
        refuse(section.place("count"),
               "grid.count: expected one row with one axis, got {} rows; give axes = 2",
               grid.count[1]);
    check_matter(scene, section, grid.matter);
    check_numbers(scene, section, "origin", grid.origin);
    check_numbers(scene, section, "velocity", grid.velocity);
    check_numbers(scene, section, "spacing",
                  node_position(grid, grid.count[0] - 1, grid.count[1] - 1));
    const Spring hung{.stiffness = grid.stiffness, .damping = grid.damping};
    check_at(scene, section, "stiffness", given(hung), grid.matter.mass);
    for (const GridLink& link : links_of(grid)) check_at(scene, section, "rest_length", link.link);
}

void check_scatter(const Scene& scene, const Section& section, const SceneScatter& scatter) {
    check_size(scene, section);
    check_matter(scene, section, scatter.matter);
    check_numbers(scene, section, "position_from", scatter.position_from);
    check_numbers(scene, section, "velocity_from", scatter.velocity_from);
    check_box(scene, section, "position_to", scatter.position_from, scatter.position_to);
    check_box(scene, section, "velocity_to", scatter.velocity_from, scatter.velocity_to);
}

void check_forces(const Scene& scene, const Place& place) {
    std::vector<std::int64_t> springs(scene.bodies.size() + 1);
    for (const SceneSpring& spring : scene.springs)
        if (!spring.to) ++springs[spring.body];
    for (const SceneForce& force : scene.forces) ++springs[force.body];
    const std::int64_t forces = std::ranges::max(springs) + std::ssize(scene.attractors);
    if (forces * scene.body_count() > most_forces)
        refuse(place,
               "expected at most {} forces, got {} forces of one body and attractors for "
               "each of {} bodies; give fewer",
               most_forces, forces, scene.body_count());
}

void check_method(const Scene& scene, const Place& place) {
    Scene small = scene;  // with few bodies: the method depends on the forces alone
    for (SceneGrid& grid : small.grids)
        for (std::int64_t& count : grid.count) count = std::min<std::int64_t>(count, 2);
    for (SceneScatter& scatter : small.scatters) scatter.count = 1;
    at(place, "scene.method",
       [&] { make_world(small, Settings{small.stepping}).require_applicable(); });
}

}  // namespace oiler
