// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/lab/reference/reference.hpp"

namespace oiler::lab {

/// One coordinate of a body over time: a cubic curve through points and slopes, or straight lines
/// if no slopes are given.
struct Path {
    std::vector<double> t{};  ///< s
    std::vector<double> x{};  ///< m
    std::vector<double> v{};  ///< m/s; empty for the drawn motion, which is straight between steps

    [[nodiscard]] std::size_t size() const { return t.size(); }
    /// The position between points i−1 and i, s from 0 to 1: Hermite's cubic.
    [[nodiscard]] double at(std::size_t i, double s) const;
    [[nodiscard]] double time(std::size_t i, double s) const {
        return t[i - 1] + s * (t[i] - t[i - 1]);
    }
    /// The s between points i−1 and i at which the path crosses a level that lies between them.
    [[nodiscard]] double crossing(std::size_t i, double level) const;
    /// The s between points i−1 and i at which the path is highest, if it has a maximum there.
    [[nodiscard]] double summit(std::size_t i) const;
};

struct Peak {
    double t;  ///< s
    double x;  ///< m
};

/// The highest point of the path from point `from` up to, not including, point `to`.
[[nodiscard]] Peak highest(const Path& path, std::size_t from, std::size_t to);

/// The path with the signs of positions and velocities reversed.
[[nodiscard]] Path turned(Path path);

/// The times of upward crossings of a level, in s. A crossing counts only if the path was below the
/// level by at least `band`, so that the round-off of a resting body is no oscillation.
[[nodiscard]] std::vector<double> upward_crossings(const Path& path, double level, double band);

/// The ratio of the longest to the shortest time between consecutive crossings; 1 for fewer than
/// two such times.
[[nodiscard]] double unevenness(const std::vector<double>& crossings);

/// One coordinate of a body's true motion over the meaningful time, at `times` as many points as
/// the reference has samples, and before and after each impact.
[[nodiscard]] Path path_of(const Reference& reference, std::size_t row, int axis,
                           std::int64_t times = 1);

/// Largest ratio of the longest to the shortest cycle for which a phase is meaningful.
inline constexpr double most_uneven_phase = 1.5;

/// Dead band: the fraction of a coordinate's range that counts as rest.
inline constexpr double dead_band = 1e-6;

/// The oscillation with the largest range over the meaningful time, of row `only` or of all rows.
/// The three widest coordinates are tried, down to a tenth of the widest range. Returns none if
/// none oscillates with at least 8 samples per period and cycles that differ by up to
/// `most_uneven`.
[[nodiscard]] std::optional<PeriodicCoordinate> find_oscillation(
    const Reference& reference, std::optional<std::size_t> only = std::nullopt,
    double most_uneven = most_uneven_phase);

}  // namespace oiler::lab
