// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "oiler/picture/picture.hpp"
#include "oiler/plot/ticks.hpp"

namespace oiler {

/// A box on the canvas.
struct Box {
    Point low;
    Point high;
};

struct DataPoint {
    double x;
    double y;
};

/// The shape at each point of a curve. Shapes are distinct without colours. All but the disc are
/// hollow. `halo` and `frame` are a large ring and a large square, for single points of other
/// curves: they lie above all marks and hide none.
enum class Mark : std::uint8_t { none, disc, ring, square, diamond, triangle, halo, frame };

/// One curve of a plot, with its entry in the legend. A curve without a visible point has none.
struct Series {
    std::string name{};  ///< in a legend beside the box, also several lines
    Colour colour{};
    std::vector<DataPoint> points{};
    float width = 1.5F;  ///< 0: only marks
    Mark mark = Mark::none;
    bool dashed = false;  ///< dashed curves are never interpolated
};

/// Curves over labelled axes, drawn into a box of the canvas. Curves are clipped at the box and
/// have a gap at points that an axis cannot show. Labels need space outside of the box, in units:
/// about 16 above it, or 36 with a title; 26 below, and 14 for each line of a caption; 44 to its
/// left. A legend beside the box needs 44 to its right, and 6 for each letter of the longest name.
struct Plot {
    Box box{};
    std::string title{};    ///< on its own line, above the y label and the legend
    std::string remark{};   ///< small, at the right end of the title's line
    std::string caption{};  ///< at the bottom, wrapped to the width of the box
    std::string x_label{};
    std::string y_label{};
    Range x{};
    Range y{};
    Scale x_scale = Scale::linear;
    Scale y_scale = Scale::linear;
    std::vector<Series> series{};
    int x_ticks = 8;  ///< approximate number
    int y_ticks = 4;
    bool legend_beside = false;        ///< beside the box, not above it: for many or long names
    std::vector<std::string> notes{};  ///< small lines below a legend beside the box

    /// Adds the plot to `picture`. `key.object` identifies the plot. A change of `key.jump`, for
    /// example with new ranges, stops the interpolation of its curves. Marks are never
    /// interpolated.
    void draw(Picture& picture, ElementKey key) const;

    [[nodiscard]] Point to_canvas(DataPoint point) const;
};

}  // namespace oiler
