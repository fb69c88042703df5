// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// Triangles over a picture, such as those of a user interface. Places are in pixels from the upper
/// left corner of the frame.
struct Overlay {
    struct Vertex {
        Point at;
        Point texel;  ///< in the bitmap, from 0 to 1
        Colour colour;
    };
    /// Triangles that are seen within a box.
    struct Part {
        std::size_t first = 0;  ///< index
        std::size_t count = 0;  ///< of indices
        int left = 0;
        int top = 0;
        int right = 0;
        int bottom = 0;
    };

    std::vector<Vertex> vertices{};
    std::vector<std::uint32_t> indices{};
    std::vector<Part> parts{};
    std::shared_ptr<const Bitmap> bitmap{};
};

}  // namespace oiler
