// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "bench/bounces.hpp"
#include "oiler/app/stills.hpp"
#include "oiler/lab/reference/exact_motion.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/plot/plot.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/scene/read.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::bench {
namespace {

constexpr int drawn_rate = 20;  // Hz
constexpr double drawn = 4;     // s, until it meets the wall

using Points = std::vector<DataPoint>;

DataPoint point_of(const World& world) {
    const Vec3 x = world.position(world.entity_of_row(0));
    return {x[0], x[1]};
}

World start(const Scene& scene) {
    return make_world(scene, {.stepping = {.method = &find_method("velocity_verlet"),
                                           .rate = {drawn_rate},
                                           .precision = Precision::double_}});
}

Points exact_path(const World& world) {
    constexpr int samples = 1000;  // per second
    const auto motions = lab::exact_motions(world.bodies(), drawn);
    Points path;
    for (int i = 0; motions && i <= drawn * samples; ++i) {
        const auto x = motions->front()(static_cast<long double>(i) / samples).x;
        path.push_back({static_cast<double>(x[0]), static_cast<double>(x[1])});
    }
    return path;
}

/// The positions after each step.
template <class Step>
Points path_of(World& world, Step step) {
    Points path{point_of(world)};
    while (world.time() < drawn) {
        step();
        path.push_back(point_of(world));
    }
    return path;
}

Points located_path(World world) {
    return path_of(world, [&] { world.step(); });
}

Points path_at_end(const Scene& scene) {
    World world = start(scene);
    world.clear_planes();
    return path_of(world, [&] {
        world.step();
        for (const ScenePlane& plane : scene.planes)
            bounce_at_end(world, world.entity_of_row(0), plane.plane,
                          scene.bodies.front().matter.contact.value_or(0));
    });
}

}  // namespace

void draw_ball_path(const std::filesystem::path& folder) {
    const Scene scene = read_scene(OILER_SOURCE "/assets/scenes/bouncing_ball.toml");
    const World world = start(scene);
    const Plot plot{
        .box = {{36, 56}, {628, 320}},
        .title = fmt::format("A bouncing ball at {} steps per second", drawn_rate),
        .remark = "velocity_verlet",
        .caption = "A mark for the centre of the ball after each step; its radius is 0.2 m.",
        .x_label = "x, m",
        .y_label = "y, m",
        .x = {0, 9},
        .y = {0, 4.2},
        .series = {{.name = "exact", .colour = palette::grey, .points = exact_path(world)},
                   {.name = "bounces at the end of a step",
                    .colour = palette::vermilion,
                    .points = path_at_end(scene),
                    .width = 1,
                    .mark = Mark::ring},
                   {.name = "bounces within the step",
                    .colour = palette::blue,
                    .points = located_path(world),
                    .width = 0,
                    .mark = Mark::disc}}};
    Picture picture;
    plot.draw(picture, {});
    Stills({1280, 720}).write(picture, folder / "bouncing_ball.png");
}

}  // namespace oiler::bench
