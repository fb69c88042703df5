// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/render/glyphs.hpp"
#include "oiler/render/mesh.hpp"

namespace oiler {

/// A disc in the frame, as an instance of the disc shader.
struct PlacedDisc {
    Point centre;    ///< pixels
    float radius;    ///< pixels
    float strength;  ///< factor on the colour's alpha, below 1 for discs smaller than a pixel
    Colour colour;
};

/// A sprite in the frame, as an instance of the sprite shader.
struct PlacedSprite {
    Point centre;     ///< pixels
    Point half_size;  ///< pixels
    Point direction;  ///< cosine and sine of its angle
    float smooth;     ///< 0 or 1
    Point start;      ///< texels, of the corner that is drawn at the upper left
    Point extent;     ///< texels from there, negative where the image is mirrored
    Colour tint;
};

/// A layer of a picture in the pixels of one frame, ready for upload. It needs no GL.
struct Layout {
    std::vector<PlacedSprite> sprites;
    std::vector<const Bitmap*> bitmaps;  ///< of each sprite
    LineMesh lines;                      ///< and polygons
    std::vector<PlacedDisc> discs;
    std::vector<PlacedGlyph> glyphs;
};

/// The layers that have elements, from the lowest up.
[[nodiscard]] std::vector<int> layers_of(const Picture& picture);

/// Lays out a layer of `picture` for a frame of that size. The memory of `layout` is reused.
void lay_out(const Picture& picture, int layer, Size frame, Glyphs& glyphs, Layout& layout);

/// The canvas within a frame, in whole pixels.
struct CanvasBox {
    int left = 0;
    int bottom = 0;
    Size size;
};
[[nodiscard]] CanvasBox canvas_box(Size frame);

}  // namespace oiler
