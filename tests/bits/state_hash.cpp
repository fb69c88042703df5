// SPDX-License-Identifier: MIT
#include <cstdio>
#include <string>

#include "oiler/core/state_hash.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/world/world.hpp"

// Prints a line for each method, scene, precision and number of axes with the state hash after 200
// steps of assorted bodies. The output must be the same with all compilers and options. All inputs
// are small integers over powers of two, so that only the engine's arithmetic can differ.

namespace {

using oiler::Vec3;
using oiler::World;

constexpr int bodies = 70;
constexpr int steps = 200;

/// A vector with coordinates from −12 to 12, in steps of 1/8.
Vec3 assorted(int i, int axes) {
    Vec3 numbers{};
    for (int axis = 0; axis < axes; ++axis)
        numbers[axis] = ((i * 37 + axis * 59 + 11) % 193 - 96) / 8.0;
    return numbers;
}

/// Bodies on springs of ω up to 5 rad/s at 256 Hz. Explicit Euler gains up to (ω·dt)²/2 per step;
/// the damping, at least 1/8 per s and kg, takes more: 1/8·dt > 25·dt².
oiler::Entity spawn_assorted(World& world, int i, bool linear) {
    const int axes = world.bodies().axes();
    const double mass = 1 + i % 3 / 2.0;
    const oiler::Body body{
        .mass = mass, .position = assorted(i, axes), .velocity = assorted(i + 7, axes)};
    const oiler::Entity entity = world.spawn(body);
    if (i % 4 != 3)
        world.attach(entity, oiler::Spring{.anchor = assorted(i + 13, axes),
                                           .stiffness = mass * (1 + i % 24),
                                           .damping = mass * (1 + i % 5) / 8.0});
    if (i % 3 == 1) world.attach(entity, oiler::LinearDrag{(1 + i % 7) / 64.0});
    if (linear) return entity;
    if (i % 5 == 2) world.attach(entity, oiler::QuadraticDrag{(1 + i % 3) / 128.0});
    if (i % 7 == 3)
        world.attach(entity, oiler::CoilSpring{.anchor = assorted(i + 17, axes),
                                               .stiffness = mass * (1 + i % 9),
                                               .damping = mass * (1 + i % 4) / 4.0,
                                               .rest_length = 60.0 + i % 5});
    if (i % 11 == 4) world.attach(entity, oiler::Attractor{.centre = {99}, .gm = 256});
    return entity;
}

/// The forces of a scene: linear ones, all, or all with links between neighbours.
enum class Scene { linear, forces, links };

void add_planes(World& world, int axes) {
    world.add_plane({.normal = {axes == 1 ? 1.0 : 0.25, axes == 1 ? 0.0 : 1.0},
                     .offset = -3,
                     .restitution = 0.75});
    world.add_plane({.normal = {-1}, .offset = -9, .restitution = 0.5, .friction = 0.25});
}

/// Circles, boxes and segments, which stand, turn, move, oscillate and are met from one side.
void add_obstacles(World& world, int axes) {
    for (int i = 0; i < 12; ++i) {
        oiler::Obstacle obstacle{.restitution = i % 4 / 4.0, .friction = i % 3 / 4.0};
        const Vec3 at = assorted(i + 3, axes);
        if (i % 3 == 0)
            obstacle.shape = oiler::CircleShape{at, 0.5};
        else if (i % 3 == 1)
            obstacle.shape = oiler::BoxShape{at, {1, 0.75, axes == 3 ? 0.5 : 0.0}, i / 8.0};
        else
            obstacle.shape = oiler::SegmentShape{at, at + Vec3{1.5, 1}};
        if (i % 5 == 1) obstacle.velocity = {0.5};
        if (i % 5 == 2) obstacle.swing = oiler::Swing{{0.75}, 1.5, 0.25};
        if (i % 7 == 3) obstacle.one_way = Vec3{1};
        if (axes == 2 && i % 4 == 2) obstacle.belt = 1.5;
        obstacle.solid = i % 6 != 5;
        world.add_obstacle(obstacle);
    }
}

/// What bodies meet.
enum class Ground { nothing, planes, obstacles };

std::uint64_t hash_after_run(const oiler::Method& method, oiler::Precision precision, int axes,
                             Scene scene, Ground ground) {
    World world(axes, {.method = &method, .rate = {256}, .precision = precision});
    world.set_gravity(assorted(5, axes));
    if (ground != Ground::nothing) add_planes(world, axes);
    if (ground == Ground::obstacles) add_obstacles(world, axes);
    oiler::Entity last;
    for (int i = 0; i < bodies; ++i) {
        const oiler::Entity entity = spawn_assorted(world, i, scene == Scene::linear);
        if (ground != Ground::nothing && i % 4 != 1)
            world.set_contact(entity, oiler::Contact{i % 3 / 4.0});
        if (scene == Scene::links && i % 3 != 0)
            world.link(last, entity,
                       {.stiffness = 1.0 + i % 5,
                        .damping = i % 4 / 8.0,
                        .rest_length = i % 2 * 60.0,
                        .pulls_only = i % 4 == 1});
        if (scene == Scene::links && i % 50 == 0)
            world.link_to_point(entity, {7}, {.stiffness = 2, .rest_length = i % 4 * 10.0});
        last = entity;
    }
    world.step(scene == Scene::links || ground == Ground::obstacles ? steps / 10 : steps);
    return world.state_hash();
}

bool takes(const oiler::Method& method, Scene scene) {
    return method.order != oiler::exact_order || scene == Scene::linear;
}

void print(const oiler::Method& method, Scene scene, Ground ground) {
    for (const auto precision : {oiler::Precision::single, oiler::Precision::double_})
        for (int axes = ground == Ground::obstacles ? 2 : 1; axes <= 3; ++axes)
            std::printf(
                "%s %d %d %s %d %s\n", std::string(method.name).c_str(), static_cast<int>(scene),
                static_cast<int>(ground), std::string(name_of(precision)).c_str(), axes,
                oiler::hash_text(hash_after_run(method, precision, axes, scene, ground)).c_str());
}

}  // namespace

int main() {
    for (const oiler::Method& method : oiler::methods())
        for (const Scene scene : {Scene::linear, Scene::forces, Scene::links})
            for (const Ground ground : {Ground::nothing, Ground::planes, Ground::obstacles})
                if (takes(method, scene)) print(method, scene, ground);
}
