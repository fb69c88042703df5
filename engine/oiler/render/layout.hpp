// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/render/glyphs.hpp"
#include "oiler/render/polyline_mesh.hpp"

namespace oiler {

/// A disc in the frame, as an instance of the disc shader.
struct PlacedDisc {
    Point centre;    ///< pixels
    float radius;    ///< pixels
    float strength;  ///< factor on the colour's alpha, below 1 for discs smaller than a pixel
    Colour colour;
};

/// A picture in the pixels of one frame, ready for upload. It needs no GL.
struct Layout {
    LineMesh lines;
    std::vector<PlacedDisc> discs;
    std::vector<PlacedGlyph> glyphs;
};

/// Lays out `picture` for a frame of that size. The memory of `layout` is reused.
void lay_out(const Picture& picture, Size frame, Glyphs& glyphs, Layout& layout);

}  // namespace oiler
