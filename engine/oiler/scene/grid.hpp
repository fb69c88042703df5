// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/scene/scene.hpp"

namespace oiler {

/// A kind of spring in a grid: from each body to the one that many to the right and above.
struct GridLink {
    int right = 0;
    int up = 0;
    Link link{};
};

/// Those that the grid has, in the order in which they are made.
[[nodiscard]] std::vector<GridLink> links_of(const SceneGrid& grid);

/// Where the body starts, in m.
[[nodiscard]] Vec3 node_position(const SceneGrid& grid, std::int64_t column, std::int64_t row);

/// Which of the grid's bodies, row by row; nothing where it has none there.
[[nodiscard]] std::optional<std::size_t> node_at(const SceneGrid& grid, std::int64_t column,
                                                 std::int64_t row);

/// Those that hang, each once.
[[nodiscard]] std::vector<std::size_t> hung_nodes(const SceneGrid& grid);

}  // namespace oiler
