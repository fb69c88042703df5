// SPDX-License-Identifier: MIT
#include "bench/scenes.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace oiler::bench {
namespace {

constexpr std::size_t line = 64;  // bytes that memory moves in

constexpr std::size_t stagger = 5 * line;

/// The start of column `i`. Columns start at different offsets within a page, so that they do not
/// compete for the same cache sets.
template <class T>
T* place(std::vector<T>& column, std::size_t i) {
    const auto address = reinterpret_cast<std::uintptr_t>(column.data());
    return column.data() + ((line - address % line) % line + i * stagger) / sizeof(T);
}

template <class World>
void fill(World& world, Scene scene, int axes, std::size_t bodies) {
    Spring spring = soft_spring;
    spring.anchor = within(spring.anchor, axes);
    if (scene == Scene::projectiles) world.set_gravity(within(gravity, axes));
    const auto add = [&](const auto&... force) {
        for (std::size_t i = 0; i < bodies; ++i) {
            if constexpr (requires { world.spawn(Body{}, force...); })
                world.spawn(start_of(i, axes), force...);
            else
                world.add(start_of(i, axes), force...);
        }
    };
    if (scene == Scene::springs)
        add(spring);
    else
        add();
}

}  // namespace

std::string_view name_of(Scene scene) {
    return scene == Scene::projectiles ? "projectiles" : "springs";
}

std::string columns(Precision precision, int axes) {
    return fmt::format("{}, {} {}", oiler::name_of(precision), axes, axes == 1 ? "axis" : "axes");
}

Vec3 within(const Vec3& vector, int axes) {
    return {vector[0], axes > 1 ? vector[1] : 0, axes > 2 ? vector[2] : 0};
}

Body start_of(std::size_t i, int axes) {
    const auto number = [i](std::size_t prime) { return 1 + static_cast<double>(i % prime) / 256; };
    return {.position = within({number(251), -number(241), number(239)}, axes),
            .velocity = within({number(233), number(229), -number(227)}, axes)};
}

World make_world(Scene scene, int axes, std::size_t bodies, const Settings& settings) {
    World world(axes, settings);
    world.reserve(bodies);
    fill(world, scene, axes, bodies);
    return world;
}

Bodies make_bodies(Scene scene, int axes, std::size_t count, Precision precision) {
    Bodies bodies(axes, precision);
    bodies.reserve(count);
    fill(bodies, scene, axes, count);
    return bodies;
}

template <class T>
HandBodies<T>::HandBodies(int axes, std::size_t bodies) {
    constexpr std::size_t multiple = HandLoops<T>::row_multiple;
    scene_.rows = (bodies + multiple - 1) / multiple * multiple;
    scene_.axes = axes;
    scene_.dt = rate.dt<T>();
    scene_.stiffness = static_cast<T>(soft_spring.stiffness);
    scene_.damping = static_cast<T>(soft_spring.damping);
    columns_.reserve(6);
    for (int a = 0; a < axes; ++a) {
        scene_.gravity[a] = static_cast<T>(gravity[a]);
        scene_.anchor[a] = static_cast<T>(soft_spring.anchor[a]);
        for (T** const column : {&scene_.x[a], &scene_.v[a]}) {
            const std::size_t i = columns_.size();
            columns_.emplace_back(scene_.rows + (line + 5 * stagger) / sizeof(T));
            *column = place(columns_.back(), i);
        }
        for (std::size_t i = 0; i < scene_.rows; ++i) {
            const Body body = start_of(i, axes);
            scene_.x[a][i] = static_cast<T>(body.position[a]);
            scene_.v[a][i] = static_cast<T>(body.velocity[a]);
        }
    }
}

template class HandBodies<float>;
template class HandBodies<double>;

}  // namespace oiler::bench
