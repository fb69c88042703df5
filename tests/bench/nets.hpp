// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "oiler/world/world.hpp"

namespace oiler::bench {

/// Pairs of bodies.
using Links = std::vector<std::array<std::size_t, 2>>;

/// A net of n × n bodies 1 m apart.
struct Net {
    std::size_t side;

    [[nodiscard]] std::size_t bodies() const { return side * side; }
    /// Stretches and bends the net a little, so that every spring pulls.
    [[nodiscard]] Vec3 position(std::size_t i) const;
    /// All horizontal ones row by row, then all vertical ones row by row.
    [[nodiscard]] Links links() const;
    /// As many links as the net has, between random pairs of bodies.
    [[nodiscard]] Links random_links() const;
};

/// In float and three axes.
[[nodiscard]] World make_net(const Net& net, const Links& links, const Link& link);

}  // namespace oiler::bench
