// SPDX-License-Identifier: MIT
#include "oiler/scene/draw.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "oiler/picture/shapes.hpp"
#include "oiler/picture/theme.hpp"
#include "oiler/scene/draw_air.hpp"
#include "oiler/scene/draw_obstacles.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

/// Radii of discs, as fractions of the camera's height.
constexpr float large_radius = 1 / 40.0F;
constexpr float small_radius = 1 / 200.0F;

Point position_of(const World& world, std::size_t row) {
    return point_of(world.position_of_row(row));
}

ElementKey key_of(const World& world, std::size_t row, std::size_t part = 0) {
    return {.object = world.entity_of_row(row).id(), .part = static_cast<std::uint32_t>(part)};
}

/// The smallest box around points.
struct Box {
    Point low{std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};
    Point high{std::numeric_limits<float>::lowest(), std::numeric_limits<float>::lowest()};

    void add(Point point) {
        low = {std::min(low.x, point.x), std::min(low.y, point.y)};
        high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
};

/// Adds the corners of all obstacles that have an end.
void add_obstacles(const World& world, Box& box) {
    for (const ObstacleHandle handle : world.bodies().obstacles()) {
        const Obstacle obstacle = world.bodies().obstacle(handle);
        if (const auto* const circle = std::get_if<CircleShape>(&obstacle.shape))
            for (const double sign : {-1.0, 1.0})
                box.add(point_of(circle->centre + sign * circle->radius * Vec3{1, 1}));
        if (const auto* const solid = std::get_if<BoxShape>(&obstacle.shape))
            for (const Point corner : rectangle(point_of(solid->centre), point_of(solid->size),
                                                static_cast<float>(solid->angle)))
                box.add(corner);
        if (const auto* const segment = std::get_if<SegmentShape>(&obstacle.shape))
            for (const Vec3& end : {segment->from, segment->to}) box.add(point_of(end));
    }
}

Box box_of(const Scene& scene, const World& world) {
    Box box;
    for (std::size_t row = 0; row < world.body_count(); ++row) box.add(position_of(world, row));
    for (const SceneSpring& spring : scene.springs)
        if (!spring.to) box.add(point_of(spring.anchor));
    for (const SceneAttractor& attractor : scene.attractors) box.add(point_of(attractor.position));
    add_obstacles(world, box);
    return box;
}

/// Draws the bodies in the order of the world's rows.
class Drawing {
public:
    Drawing(const Scene& scene, const World& world, const Camera& camera)
        : scene_(scene),
          world_(world),
          picture_{.background = scene.view.background, .camera = camera},
          theme_(theme_of(scene.view.background)) {
        picture_.discs.reserve(world.body_count() + scene.attractors.size());
    }

    Picture run(const SceneTrails& trails) {
        draw_air(scene_, world_.time(), picture_);
        draw_obstacles(scene_, world_, picture_);
        trails.draw(scene_, world_, picture_);
        draw_attractors();
        draw_springs();
        for (const SceneBody& body : scene_.bodies) draw_discs(1, body.matter, large_radius);
        for (const SceneGrid& grid : scene_.grids) {
            draw_net(grid);
            draw_discs(grid.size(), grid.matter, small_radius);
        }
        for (const SceneScatter& scatter : scene_.scatters)
            draw_discs(scatter.count, scatter.matter, small_radius);
        draw_labels();
        if (scene_.view.fastest) draw_scale(*scene_.view.fastest);
        return std::move(picture_);
    }

private:
    [[nodiscard]] float radius(const std::optional<double>& given, float part) const {
        return given ? static_cast<float>(*given) : part * picture_.camera.height;
    }

    void draw_attractors() {
        for (const SceneAttractor& attractor : scene_.attractors)
            picture_.discs.push_back({.centre = point_of(attractor.position),
                                      .radius = radius(attractor.radius, large_radius),
                                      .colour = attractor.colour});
    }

    void draw_discs(std::int64_t count, const SceneMatter& matter, float part) {
        const bool as_contact = !matter.radius && matter.contact && *matter.contact > 0;
        const float size = radius(as_contact ? matter.contact : matter.radius, part);
        for (; count > 0; --count, ++row_)
            picture_.discs.push_back({.key = key_of(world_, row_),
                                      .centre = position_of(world_, row_),
                                      .radius = size,
                                      .colour = colour_of(row_, matter)});
    }
    [[nodiscard]] Colour colour_of(std::size_t row, const SceneMatter& matter) const {
        if (!scene_.view.fastest) return matter.colour;
        const Vec3 v = world_.bodies().velocity(row);
        const double speed = std::sqrt(dot(v, v));
        return palette::scale(static_cast<float>(speed / *scene_.view.fastest));
    }

    void draw_springs() {
        constexpr int turns = 12;
        for (std::size_t i = 0; i < scene_.springs.size(); ++i) {
            const SceneSpring& spring = scene_.springs[i];
            const Point from =
                spring.to ? position_of(world_, *spring.to) : point_of(spring.anchor);
            const Point to = position_of(world_, spring.body);
            if (!spring.to)
                picture_.discs.push_back(
                    {.centre = from, .radius = radius({}, small_radius), .colour = theme_.ink});
            picture_.polylines.push_back(
                {.key = key_of(world_, spring.body, i + 1),
                 .points =
                     spring.pulls_only
                         ? rope(from, to, static_cast<float>(spring.rest_length))
                         : coil(from, to, turns, 0.6F * large_radius * picture_.camera.height),
                 .width = 1.25F,
                 .colour = spring.colour});
        }
    }

    /// Draws the springs of a grid as threads from edge to edge.
    void draw_net(const SceneGrid& grid) {
        const std::vector<GridLink> links = links_of(grid);
        for (std::size_t kind = 0; kind < links.size(); ++kind)
            for (std::int64_t row = 0; row < grid.count[1]; ++row)
                for (std::int64_t column = 0; column < grid.count[0]; ++column)
                    if (!node_at(grid, column - links[kind].right, row - links[kind].up))
                        draw_thread(grid, links[kind], column, row, kind);
    }
    void draw_thread(const SceneGrid& grid, const GridLink& link, std::int64_t column,
                     std::int64_t row, std::size_t kind) {
        const bool diagonal = link.right != 0 && link.up != 0;
        Polyline thread{.key = key_of(world_, row_ + *node_at(grid, column, row), kind + 1),
                        .width = diagonal ? 0.4F : 0.8F,
                        .colour = palette::faded(grid.matter.colour, diagonal ? 60 : 140)};
        for (auto node = node_at(grid, column, row); node; node = node_at(grid, column, row)) {
            thread.points.push_back(position_of(world_, row_ + *node));
            column += link.right;
            row += link.up;
        }
        if (thread.points.size() > 1) picture_.polylines.push_back(std::move(thread));
    }

    void draw_labels() {
        const std::string how =
            fmt::format("{}   t = {:.2f} s", caption(world_.settings().stepping), world_.time());
        picture_.labels = {{.at = {12, 340}, .text = scene_.title, .colour = theme_.ink},
                           {.at = {12, 326}, .text = how, .size = 9, .colour = theme_.faint}};
    }

    /// The colours of speeds, below the labels.
    void draw_scale(double fastest) {
        constexpr int steps = 24;
        constexpr Point low{12, 308};
        constexpr float width = 4, height = 8;
        for (int i = 0; i < steps; ++i)
            picture_.polygons.push_back(
                {.points =
                     rectangle({low.x + width * (static_cast<float>(i) + 0.5F), low.y + height / 2},
                               {width, height}),
                 .colour = palette::scale(static_cast<float>(i) / (steps - 1)),
                 .space = Space::canvas});
        picture_.labels.push_back({.at = {low.x + steps * width + 6, low.y + 1},
                                   .text = fmt::format("0 to {:g} m/s", fastest),
                                   .size = 9,
                                   .colour = theme_.faint});
    }

    const Scene& scene_;
    const World& world_;
    Picture picture_;
    const Theme& theme_;
    std::size_t row_ = 0;
};

}  // namespace

Camera camera_of(const Scene& scene, const World& world) {
    constexpr float margin = 1.25F;
    constexpr float default_height = 10;  // m, if all is in one point
    const Box box = box_of(scene, world);
    Camera camera{.centre = {box.low.x / 2 + box.high.x / 2, box.low.y / 2 + box.high.y / 2}};
    const float height =
        std::max(box.high.y - box.low.y, (box.high.x - box.low.x) * canvas_height / canvas_width);
    camera.height = height > 0 ? margin * height : default_height;
    if (scene.camera.centre) camera.centre = point_of(*scene.camera.centre);
    if (scene.camera.height) camera.height = static_cast<float>(*scene.camera.height);
    return camera;
}

Picture draw_scene(const Scene& scene, const World& world, const Camera& camera,
                   const SceneTrails& trails) {
    return Drawing(scene, world, camera).run(trails);
}

}  // namespace oiler
