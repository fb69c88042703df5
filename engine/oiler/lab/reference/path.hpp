// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/lab/reference/reference.hpp"

namespace oiler::lab {

/// One coordinate of a body over time: a curve through its points that has their slopes, or
/// straight lines where it has none.
struct Path {
    std::vector<double> t{};  ///< s
    std::vector<double> x{};  ///< m
    std::vector<double> v{};  ///< m/s; empty for what is drawn, which is straight in between

    [[nodiscard]] std::size_t size() const { return t.size(); }
    /// Between point i−1 and the next, s from 0 to 1: Hermite's cubic.
    [[nodiscard]] double at(std::size_t i, double s) const;
    [[nodiscard]] double time(std::size_t i, double s) const {
        return t[i - 1] + s * (t[i] - t[i - 1]);
    }
    /// Where between point i−1 and the next it goes through a level, which lies between them.
    [[nodiscard]] double crossing(std::size_t i, double level) const;
    /// Where between point i−1 and the next it is highest, if it has a summit there.
    [[nodiscard]] double summit(std::size_t i) const;
};

struct Peak {
    double t;  ///< s
    double x;  ///< m
};

/// From point `from` on and before point `to`.
[[nodiscard]] Peak highest(const Path& path, std::size_t from, std::size_t to);

/// Upside down.
[[nodiscard]] Path turned(Path path);

/// When it goes up through a level, in s; having been below it by `band` at least, so that the
/// roundings of what has come to rest are no swing.
[[nodiscard]] std::vector<double> upward_crossings(const Path& path, double level, double band);

/// Of a coordinate, at those looks.
[[nodiscard]] Path path_of(const Track& track, const Looks& looks, std::size_t row, int axis);

}  // namespace oiler::lab
