// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/sim/store/box_grid.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// Finds the bodies near a point, for more than about ten queries of few bodies between two steps:
/// an update takes as long as ten calls of World::within.
///
/// It is a value that a game keeps and updates after each step.
class Neighbours {
public:
    /// Stores the positions of all bodies. Memory is reused.
    void update(const World& world);

    /// Like World::within, with the positions and entities of the last update. The time grows with
    /// the number of bodies found, and with clusters far away from each other; World::within is
    /// faster where most bodies are found.
    [[nodiscard]] std::vector<Entity> within(const Vec3& point, double radius) const;

private:
    int axes_ = 0;
    std::vector<Entity> entities_;  ///< for each row
    BoxGrid grid_;
};

}  // namespace oiler
