// SPDX-License-Identifier: MIT
#include "oiler/overlay/overlay_area.hpp"

#include <algorithm>

namespace oiler {

constexpr float least_font_pixels = 11;

OverlayArea::OverlayArea(Size size)
    : pixels(std::max(0.01F, std::min(static_cast<float>(size.width) / canvas_width,
                                      static_cast<float>(size.height) / canvas_height))) {
    const Point half{static_cast<float>(size.width) / pixels / 2,
                     static_cast<float>(size.height) / pixels / 2};
    low = {canvas_width / 2 - half.x, canvas_height / 2 - half.y};
    high = {canvas_width / 2 + half.x, canvas_height / 2 + half.y};
}

float OverlayArea::legible(float size) const { return std::max(size, least_font_pixels / pixels); }

}  // namespace oiler
