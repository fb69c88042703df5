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

/// What stands at each point of a curve, on the line through them: shapes that are told apart
/// whatever colours a reader sees. All but the disc are hollow.
enum class Mark : std::uint8_t { none, disc, ring, square, diamond, triangle };

/// One curve of a plot, and its line in the legend.
struct Series {
    std::string name{};
    Colour colour{};
    std::vector<DataPoint> points{};
    float width = 1.5F;
    Mark mark = Mark::none;
    bool dashed = false;  ///< and never interpolated
};

/// Curves over labelled axes, drawn into a box of the canvas; curves are cut at the box, and parted
/// where a point has no place on an axis. Labels stand outside of the box: about 16 units above it,
/// or 36 with a title; 26 below, and 14 more for each line of a caption; 44 to its left; and with
/// the legend beside it 44 to its right, and 6 more for each letter of the longest name.
struct Plot {
    Box box{};
    std::string title{};    ///< on a line of its own, above that of the y label and the legend
    std::string remark{};   ///< small, at the right end of the title's line
    std::string caption{};  ///< below all else, wrapped to the width of the box
    std::string x_label{};
    std::string y_label{};
    Range x{};
    Range y{};
    Scale x_scale = Scale::linear;
    Scale y_scale = Scale::linear;
    std::vector<Series> series{};
    int x_ticks = 8;  ///< about how many
    int y_ticks = 4;
    bool legend_beside = false;  ///< of the box, not above it: for many names, or long ones

    /// `key.object` identifies the plot; a change of `key.jump`, say for other ranges, keeps the
    /// picture from interpolating curves across it. Marks are never interpolated.
    void draw(Picture& picture, ElementKey key) const;

    [[nodiscard]] Point to_canvas(DataPoint point) const;
};

}  // namespace oiler
