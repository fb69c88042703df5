// SPDX-License-Identifier: MIT
#include "oiler/scene/trails.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "oiler/scene/draw_obstacles.hpp"

namespace oiler {
namespace {

constexpr std::size_t most_points = 32768;  // of all bodies: a window copies games to go back
constexpr std::size_t most_samples = 256;
constexpr std::size_t shades = 8;

}  // namespace

SceneTrails::SceneTrails(const Scene& scene, const World& world)
    : duration_(scene.view.trails.value_or(0)), bodies_(scene.bodies.size()) {
    if (duration_ <= 0 || bodies_ == 0) return;
    most_samples_ = std::clamp(most_points / bodies_, shades, most_samples);
    add_sample(world);
}

/// A whole number of steps, so that paths do not depend on how many steps are taken per call.
std::int64_t SceneTrails::stride(const World& world) const {
    const double steps = duration_ / world.dt() / static_cast<double>(most_samples_);
    return std::max<std::int64_t>(1, std::llround(std::min(std::ceil(steps), 1e15)));
}

std::int64_t SceneTrails::steps_to_sample(const World& world) const {
    if (most_samples_ == 0) return std::numeric_limits<std::int64_t>::max();
    const std::int64_t every = stride(world);
    return every - world.tick() % every;
}

void SceneTrails::sample(const World& world) {
    if (most_samples_ > 0 && world.tick() % stride(world) == 0) add_sample(world);
}

std::size_t SceneTrails::most(const World& world) const {
    const double between = static_cast<double>(stride(world)) * world.dt();
    return std::min(most_samples_, static_cast<std::size_t>(duration_ / between));
}

void SceneTrails::add_sample(const World& world) {
    for (std::size_t body = 0; body < bodies_; ++body) points_.push_back(now(world, body));
    const std::size_t kept = (most(world) + 1) * bodies_;
    if (points_.size() > kept)
        points_.erase(points_.begin(), points_.end() - static_cast<std::ptrdiff_t>(kept));
}

void SceneTrails::draw(const Scene& scene, const World& world, Picture& picture) const {
    for (std::size_t body = 0; most_samples_ > 0 && body < bodies_; ++body)
        draw_path(world, body, scene.bodies[body].matter.colour, picture);
}

Point SceneTrails::now(const World& world, std::size_t body) {
    return point_of(world.position_of_row(body));
}

Point SceneTrails::then(const World& world, std::size_t body, std::size_t sample,
                        float camera_height) const {
    constexpr double reach = 0.45;  // of the camera's height
    Point at = points_[sample * bodies_ + body];
    if (world.axes() > 1) return at;
    const std::int64_t every = stride(world);
    const auto later = static_cast<std::int64_t>(points_.size() / bodies_ - 1 - sample);
    const double age =
        static_cast<double>(later * every + world.tick() % every) * world.dt() / duration_;
    at.y -= static_cast<float>(reach * age) * camera_height;
    return at;
}

/// Pieces are counted from the newest on, and the body ends the first one, so that each slides
/// along the path from step to step. They fade to the background, because transparent lines would
/// show where they overlap.
void SceneTrails::draw_path(const World& world, std::size_t body, Colour colour,
                            Picture& picture) const {
    const std::size_t samples = points_.size() / bodies_;
    const std::size_t length = most(world) / shades + 1;
    std::uint32_t piece = 0;
    for (std::size_t end = samples; end > 1 || piece == 0; end -= std::min(end, length), ++piece) {
        const std::size_t begin = end > length ? end - length - 1 : 0;
        const float age = static_cast<float>(piece) / static_cast<float>(shades);
        Polyline line{.key = {.object = world.entity_of_row(body).id(), .part = ~piece},
                      .width = 1.5F,
                      .colour = palette::mix(picture.background, colour, 0.75F - 0.5F * age)};
        for (std::size_t i = begin; i < end; ++i)
            line.points.push_back(then(world, body, i, picture.camera.height));
        if (piece == 0) line.points.push_back(now(world, body));
        picture.polylines.push_back(std::move(line));
    }
}

}  // namespace oiler
