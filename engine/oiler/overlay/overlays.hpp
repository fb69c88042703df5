// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/whatif/verdict.hpp"

namespace oiler {

/// The layer of the loop's own elements: above all layers of games.
inline constexpr int overlay_layer = std::numeric_limits<int>::max();

/// A part of a window that the loop draws over. Points are in units of the canvas; the part reaches
/// beyond the canvas where it is not 16:9.
struct OverlayArea {
    explicit OverlayArea(Size pixels);

    /// The size of a font, or the least one that can be read.
    [[nodiscard]] float legible(float size) const;

    Point low;     ///< lower left corner
    Point high;    ///< upper right corner
    float pixels;  ///< of a unit
};

/// Lines of at most `most` bytes, broken at spaces. A longer word has a line of its own.
[[nodiscard]] std::vector<std::string> broken_at_spaces(const std::string& text, std::size_t most);

// The colours of what is added follow the background of the picture that it is added to.

/// Adds a line of text on a sheet; it begins at `at`, or ends there if aligned to the right.
void add_note(Picture& overlay, Point at, std::string text, float size, Align align);

/// Adds a line of text on a sheet at the lower right; nothing if empty.
void add_status(Picture& overlay, const OverlayArea& area, std::string status);

[[nodiscard]] Colour colour_of(Verdict::Grade grade);

/// The height of the band that a verdict takes at the top, pixels: it depends on the area only, so
/// that no picture moves when a verdict changes.
[[nodiscard]] int verdict_height(const OverlayArea& area);

/// Adds a band across the top with a mark in the colour of its grade, and with lines of text that
/// fit into it. The state of the loop, such as a pause, stands at its end; if empty, two keys.
void add_verdict(Picture& overlay, const OverlayArea& area, const Verdict& verdict,
                 const std::string& status = {});

/// An event that stops the play.
struct Notice {
    std::string heading;  ///< in larger letters; may be empty
    std::string text;
    std::string remedy;
};

/// Adds a sheet with a notice across the middle of an area.
void add_notice(Picture& overlay, const OverlayArea& area, const Notice& notice);

}  // namespace oiler
