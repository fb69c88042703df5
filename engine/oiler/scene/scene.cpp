// SPDX-License-Identifier: MIT
#include "oiler/scene/scene.hpp"

#include <algorithm>
#include <cmath>

namespace oiler {

Link link_of(const SceneSpring& spring) {
    return {spring.stiffness, spring.damping, spring.rest_length, spring.pulls_only};
}

std::string Scene::name_of_obstacle(std::size_t index) const {
    std::size_t begin = 0;
    std::string name;
    const auto look_in = [&](const auto& tables, auto count_of) {
        for (const auto& one : tables) {
            const std::size_t count = count_of(one);
            const bool is_part = count > 1;
            if (index >= begin && index < begin + count && !one.name.empty())
                name = is_part ? one.name + " " + std::to_string(index - begin + 1) : one.name;
            begin += count;
        }
    };
    const auto alone = [](const auto&) { return std::size_t{1}; };
    look_in(planes, alone);
    look_in(obstacles, alone);
    look_in(chains,
            [](const SceneChain& chain) { return chain.points.size() - (chain.closed ? 0 : 1); });
    look_in(tiles, [](const SceneTiles& one) {
        std::size_t count = 0;
        for (const std::string& row : one.rows)
            count += static_cast<std::size_t>(std::ranges::count_if(row, is_tile));
        return count;
    });
    return name.empty() ? "obstacle " + std::to_string(index) : name;
}

bool Scene::has_ropes() const { return std::ranges::any_of(springs, &SceneSpring::pulls_only); }

std::vector<GridLink> links_of(const SceneGrid& grid) {
    const double length = grid.rest_length.value_or(grid.spacing);
    const Link along{grid.stiffness, grid.damping, length};
    const Link across{grid.stiffness, grid.damping, length * std::sqrt(2.0)};
    std::vector<GridLink> links{{1, 0, along}, {0, 1, along}};
    if (grid.diagonals) links.insert(links.end(), {{1, 1, across}, {-1, 1, across}});
    return links;
}

Vec3 node_position(const SceneGrid& grid, std::int64_t column, std::int64_t row) {
    Vec3 position = grid.origin;
    position[0] += static_cast<double>(column) * grid.spacing;
    if (row > 0) position[1] += static_cast<double>(row) * grid.spacing;
    return position;
}

std::optional<std::size_t> node_at(const SceneGrid& grid, std::int64_t column, std::int64_t row) {
    if (column < 0 || row < 0 || column >= grid.count[0] || row >= grid.count[1])
        return std::nullopt;
    return static_cast<std::size_t>(row * grid.count[0] + column);
}

std::vector<std::size_t> anchored_nodes(const SceneGrid& grid) {
    std::vector<std::size_t> nodes;
    const std::int64_t step =
        grid.hang == Hang::corners ? std::max<std::int64_t>(1, grid.count[0] - 1) : 1;
    for (std::int64_t column = 0; grid.hang != Hang::none && column < grid.count[0]; column += step)
        nodes.push_back(*node_at(grid, column, grid.count[1] - 1));
    return nodes;
}

std::vector<Obstacle> segments_of(const SceneChain& chain) {
    std::vector<Obstacle> segments;
    const std::size_t count = chain.points.size() - (chain.closed ? 0 : 1);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3& to = chain.points[(i + 1) % chain.points.size()];
        segments.push_back(chain.like);
        segments.back().shape = SegmentShape{chain.points[i], to};
    }
    return segments;
}

std::vector<Obstacle> boxes_of(const SceneTiles& tiles, int axes) {
    std::vector<Obstacle> boxes;
    const auto at = [&](std::size_t cells) {
        return (static_cast<double>(cells) + 0.5) * tiles.tile;
    };
    for (std::size_t row = 0; row < tiles.rows.size(); ++row)
        for (std::size_t column = 0; column < tiles.rows[row].size(); ++column) {
            const char c = tiles.rows[row][column];
            if (!is_tile(c)) continue;
            BoxShape box{.centre =
                             tiles.origin + Vec3{at(column), at(tiles.rows.size() - 1 - row)}};
            if (axes == 3) box.centre[2] += at(0);
            for (int axis = 0; axis < axes; ++axis) box.size[axis] = tiles.tile;
            Obstacle obstacle{.shape = box,
                              .restitution = tiles.restitution,
                              .friction = tiles.friction,
                              .layers = tiles.layers};
            if (tiles.one_way.find(c) != std::string::npos) obstacle.one_way = Vec3{0, 1};
            boxes.push_back(obstacle);
        }
    return boxes;
}

}  // namespace oiler
