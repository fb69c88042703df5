// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// A box on the canvas.
struct Box {
    Point low;
    Point high;
};

struct Range {
    double low = 0;
    double high = 1;
};

enum class Scale : std::uint8_t {
    linear,
    logarithmic,  ///< of a range above 0; what is not above 0 has no place on it
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

/// Multiples of 1, 2 or 5 times a power of ten within the range, about `count` of them.
[[nodiscard]] std::vector<double> ticks(Range range, int count);

/// The same for a logarithmic axis: powers of ten, or every second, third, … of them. Ranges that
/// hold fewer than three of them have 1, 2 and 5 times those, or else the ticks of a linear axis.
[[nodiscard]] std::vector<double> logarithmic_ticks(Range range, int count);

}  // namespace oiler
