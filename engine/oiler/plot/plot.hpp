// SPDX-License-Identifier: MIT
#pragma once

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

struct DataPoint {
    double x;
    double y;
};

/// One curve of a plot, and its line in the legend.
struct Series {
    std::string name{};
    Colour colour{};
    std::vector<DataPoint> points{};
    float width = 1.5F;
};

/// Curves over labelled axes, drawn into a box of the canvas; curves are cut at the box. Labels
/// stand outside of the box: about 16 units above it, 26 below and 44 to its left.
struct Plot {
    Box box{};
    std::string title{};
    std::string x_label{};
    std::string y_label{};
    Range x{};
    Range y{};
    std::vector<Series> series{};

    /// `key.object` identifies the plot; a change of `key.jump`, say for other ranges, keeps the
    /// picture from interpolating curves across it.
    void draw(Picture& picture, ElementKey key) const;

    [[nodiscard]] Point to_canvas(DataPoint point) const;
};

/// Multiples of 1, 2 or 5 times a power of ten within the range, about `count` of them.
[[nodiscard]] std::vector<double> ticks(Range range, int count);

}  // namespace oiler
