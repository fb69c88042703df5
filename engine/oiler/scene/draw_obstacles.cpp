// SPDX-License-Identifier: MIT
#include "oiler/scene/draw_obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "oiler/picture/shapes.hpp"
#include "oiler/picture/solids.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

/// Draws the obstacles in the order in which make_world adds them.
class ObstacleDrawing {
public:
    ObstacleDrawing(const World& world, Picture& picture)
        : bodies_(world.bodies()), handles_(bodies_.obstacles()), picture_(picture) {}

    void draw(const Scene& scene) {
        for (const ScenePlane& one : scene.planes) draw_plane(one.colour);
        for (const SceneObstacle& one : scene.obstacles) draw_one(one.colour);
        for (const SceneChain& chain : scene.chains) draw_chain(chain);
        for (const SceneTiles& tiles : scene.tiles) draw_tiles(tiles);
    }

private:
    [[nodiscard]] Obstacle take(Colour colour, Solid& solid) {
        const ObstacleHandle handle = handles_[next_++];
        Obstacle obstacle = bodies_.obstacle(handle);
        solid = {
            .key = key_of_obstacle(handle.slot, handle.generation), .fill = colour, .line = colour};
        if (!obstacle.solid) solid.fill = palette::faded(colour, 0x40);
        if (obstacle.one_way) solid.one_way = point_of(*obstacle.one_way);
        return obstacle;
    }
    [[nodiscard]] float shade() const { return picture_.camera.height / 60; }

    void draw_plane(Colour colour) {
        Solid solid;
        const auto plane = std::get<HalfSpaceShape>(take(colour, solid).shape);
        const Camera& camera = picture_.camera;
        const float reach = camera.height * (canvas_width / canvas_height + 1);
        const Point n = point_of(plane.normal);
        const float size2 = n.x * n.x + n.y * n.y;
        if (size2 == 0) return;
        const float beyond =
            static_cast<float>(plane.offset) - n.x * camera.centre.x - n.y * camera.centre.y;
        const Point at{camera.centre.x + n.x * beyond / size2,
                       camera.centre.y + n.y * beyond / size2};
        const float size = std::sqrt(size2);
        const Point along{-n.y / size * reach, n.x / size * reach};
        const Point from{at.x - along.x, at.y - along.y}, to{at.x + along.x, at.y + along.y};
        const Point inwards{-n.x / size * reach, -n.y / size * reach};
        picture_.polygons.push_back({.points = {from,
                                                to,
                                                {to.x + inwards.x, to.y + inwards.y},
                                                {from.x + inwards.x, from.y + inwards.y}},
                                     .colour = palette::mix(picture_.background, colour, 0.25F)});
        picture_.polylines.push_back({.points = {from, to}, .width = 2, .colour = colour});
    }

    void draw_one(Colour colour) {
        Solid solid;
        const Obstacle obstacle = take(colour, solid);
        if (const auto* const circle = std::get_if<CircleShape>(&obstacle.shape))
            draw_circle(solid, point_of(circle->centre), static_cast<float>(circle->radius),
                        picture_);
        if (const auto* const box = std::get_if<BoxShape>(&obstacle.shape))
            draw_block(solid,
                       rectangle(point_of(box->centre), point_of(box->size),
                                 static_cast<float>(box->angle)),
                       picture_);
        if (const auto* const segment = std::get_if<SegmentShape>(&obstacle.shape))
            draw_wall(solid, {point_of(segment->from), point_of(segment->to)}, shade(), picture_);
    }

    void draw_chain(const SceneChain& chain) {
        Solid solid;
        std::vector<Point> points;
        for (std::size_t left = chain.points.size() - (chain.closed ? 0 : 1); left > 0; --left) {
            Solid of_segment;
            const auto segment = std::get<SegmentShape>(take(chain.colour, of_segment).shape);
            if (points.empty()) {
                solid = of_segment;
                points.push_back(point_of(segment.from));
            }
            points.push_back(point_of(segment.to));
        }
        draw_wall(solid, std::move(points), shade(), picture_);
    }

    /// Equal tiles side by side.
    struct Run {
        std::size_t begin;
        std::size_t end;
        bool one_way;
        friend bool operator==(const Run&, const Run&) = default;
    };

    static std::vector<Run> runs_of(const SceneTiles& tiles, const std::string& row) {
        std::vector<Run> runs;
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (!is_tile(row[i])) continue;
            const bool one_way = tiles.one_way.find(row[i]) != std::string::npos;
            if (runs.empty() || runs.back() != Run{runs.back().begin, i, one_way})
                runs.push_back({i, i, one_way});
            runs.back().end = i + 1;
        }
        return runs;
    }

    /// Tiles stand. They are drawn from the text. Equal runs below each other are one block, as
    /// outlines that cross an edge show; one-way tiles have a line in each row.
    void draw_tiles(const SceneTiles& tiles) {
        std::vector<std::vector<Run>> rows;
        for (const std::string& row : tiles.rows) rows.push_back(runs_of(tiles, row));
        const auto has = [&](std::size_t row, const Run& run) {
            return row < rows.size() && !run.one_way && std::ranges::count(rows[row], run) > 0;
        };
        for (std::size_t row = 0; row < rows.size(); ++row)
            for (const Run& run : rows[row]) {
                if (row > 0 && has(row - 1, run)) continue;
                std::size_t end = row + 1;
                while (has(end, run)) ++end;
                draw_run(tiles, run, row, end);
            }
    }
    void draw_run(const SceneTiles& tiles, const Run& run, std::size_t top, std::size_t bottom) {
        // The outline hides the seam between the polygons of two rows.
        Solid solid{.fill = tiles.colour, .line = tiles.colour, .outline = 0.75F};
        if (run.one_way) solid.one_way = {0, 1};
        const Vec3 low = tiles.tile * Vec3{static_cast<double>(run.begin),
                                           static_cast<double>(tiles.rows.size() - bottom)};
        const Vec3 size = tiles.tile * Vec3{static_cast<double>(run.end - run.begin),
                                            static_cast<double>(bottom - top)};
        draw_block(solid, rectangle(point_of(tiles.origin + low + size / 2.0), point_of(size)),
                   picture_);
    }

    const Bodies& bodies_;
    std::vector<ObstacleHandle> handles_;
    std::size_t next_ = 0;
    Picture& picture_;
};

}  // namespace

void draw_obstacles(const Scene& scene, const World& world, Picture& picture) {
    if (scene.has_obstacles()) ObstacleDrawing(world, picture).draw(scene);
}

}  // namespace oiler
