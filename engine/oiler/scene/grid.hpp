// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/scene/scene.hpp"

namespace oiler {

/// A kind of spring in a grid. It links each body to the one `right` columns and `up` rows away.
struct GridLink {
    int right = 0;
    int up = 0;
    Link link{};
};

/// The kinds of springs of a grid, in the order of their creation.
[[nodiscard]] std::vector<GridLink> links_of(const SceneGrid& grid);

/// Initial position of a body, in m.
[[nodiscard]] Vec3 node_position(const SceneGrid& grid, std::int64_t column, std::int64_t row);

/// Index of a body, counted row by row; empty outside of the grid.
[[nodiscard]] std::optional<std::size_t> node_at(const SceneGrid& grid, std::int64_t column,
                                                 std::int64_t row);

/// Indices of the bodies with an anchored spring, each once.
[[nodiscard]] std::vector<std::size_t> anchored_nodes(const SceneGrid& grid);

}  // namespace oiler
