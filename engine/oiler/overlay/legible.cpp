// SPDX-License-Identifier: MIT
#include "oiler/overlay/legible.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "oiler/picture/text.hpp"

namespace oiler {
namespace {

constexpr float least_pixels = 9;  // of a font of a game
constexpr float most_growth = 2;

// From the baseline, of the size, with some of the gap between two lines.
constexpr float above_baseline = 0.8F;
constexpr float below_baseline = 0.25F;
constexpr float least_space = 0.3F;  // of the size, between two texts of a line

/// The reach of a label from its anchor, units of the canvas, and the growth that it would have
/// alone. Or the swatch of a legend, which does not grow.
struct Block {
    Point at;
    float left, right, below, above;
    float growth = 1;
};

Point place_of(const Label& label, const Picture& picture, const OverlayArea& area) {
    if (label.space == Space::world) return picture.camera.to_canvas(label.at);
    if (picture.has_bars) return label.at;
    const Point side = side_of(label.space);
    return {label.at.x - side.x * area.low.x, label.at.y - side.y * area.low.y};
}

/// The growth at which a label is legible or reaches an edge of the area.
float growth_alone(const Label& label, const Block& block, const OverlayArea& area) {
    float growth = std::min(most_growth, least_pixels / (label.size * area.pixels));
    if (label.space != Space::world)
        growth = std::min({growth, (block.at.x - area.low.x) / block.left,
                           (area.high.x - block.at.x) / block.right});
    return std::max(1.0F, growth);
}

Block block_of(const Label& label, const Picture& picture, const OverlayArea& area) {
    const float width = wider_letters * text_width(label.text, label.size);
    const float space = least_space / 2 * label.size;
    const float left = label.align == Align::left     ? 0
                       : label.align == Align::centre ? width / 2
                                                      : width;
    Block block{.at = place_of(label, picture, area),
                .left = left + space,
                .right = width - left + space,
                .below = below_baseline * label.size,
                .above = above_baseline * label.size};
    block.growth = growth_alone(label, block, area);
    return block;
}

/// Short level lines on the canvas.
std::vector<Block> swatches_of(const Picture& picture) {
    constexpr float longest = 30;
    std::vector<Block> swatches;
    for (const Polyline& line : picture.polylines) {
        if (line.space != Space::canvas || line.points.size() != 2) continue;
        const Point from = line.points.front(), to = line.points.back();
        const float half = std::abs(to.x - from.x) / 2;
        if (from.y == to.y && half > 0 && half <= longest / 2)
            swatches.push_back({.at = {(from.x + to.x) / 2, from.y},
                                .left = half,
                                .right = half,
                                .below = line.width / 2,
                                .above = line.width / 2});
    }
    return swatches;
}

/// The growth at which two lengths that grow towards each other from the ends of a gap meet. Each
/// one stops at its own growth.
float growth_at_meeting(float gap, float a, float a_stops, float b, float b_stops) {
    if (a * a_stops + b * b_stops <= gap) return std::numeric_limits<float>::infinity();
    const float together = gap / (a + b);
    if (together <= std::min(a_stops, b_stops)) return together;
    return a_stops < b_stops ? (gap - a * a_stops) / b : (gap - b * b_stops) / a;
}

/// The growth up to which two blocks do not touch.
float growth_beside(const Block& a, const Block& b) {
    const auto& [l, r] = a.at.x < b.at.x ? std::tie(a, b) : std::tie(b, a);
    const auto& [low, high] = a.at.y < b.at.y ? std::tie(a, b) : std::tie(b, a);
    return std::max(
        growth_at_meeting(r.at.x - l.at.x, l.right, l.growth, r.left, r.growth),
        growth_at_meeting(high.at.y - low.at.y, low.above, low.growth, high.below, high.growth));
}

}  // namespace

void keep_legible(Picture& picture, const OverlayArea& area) {
    std::vector<Label*> labels;
    std::vector<Block> blocks;
    for (Label& label : picture.labels) {
        if (label.size_in != Space::canvas || !(label.size > 0) || label.text.empty()) continue;
        labels.push_back(&label);
        blocks.push_back(block_of(label, picture, area));
    }
    if (std::ranges::all_of(blocks, [](const Block& one) { return one.growth == 1; })) return;
    for (const Block& swatch : swatches_of(picture)) blocks.push_back(swatch);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        float growth = blocks[i].growth;
        for (std::size_t j = 0; j < blocks.size() && growth > 1; ++j)
            if (i != j) growth = std::min(growth, growth_beside(blocks[i], blocks[j]));
        labels[i]->size *= std::max(1.0F, growth);
    }
}

}  // namespace oiler
