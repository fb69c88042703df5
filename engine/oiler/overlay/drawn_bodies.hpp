// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <unordered_map>

#include "oiler/picture/picture.hpp"
#include "oiler/world/entity.hpp"

namespace oiler {

/// The bodies in a picture. A game may draw them elsewhere than they are.
class DrawnBodies {
public:
    struct Body {
        Point centre{};  ///< m
        Colour colour{};
        int layer = 0;
        float radius = 0;  ///< m; 0: it is no disc
    };

    /// The disc, polygon or sprite of part 0 stands for a body.
    explicit DrawnBodies(const Picture& picture);
    /// Null if the picture does not show it.
    [[nodiscard]] const Body* find(Entity body) const;

private:
    std::unordered_map<std::uint64_t, Body> bodies_;
};

}  // namespace oiler
