// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "oiler/lab/reference/parts.hpp"
#include "oiler/lab/reference/path.hpp"
#include "oiler/lab/reference/scales.hpp"

namespace oiler::lab {
namespace {

constexpr double fewest_samples_in_period = 8;
constexpr std::size_t fewest_crossings = 3;
/// Largest ratio of the longest to the shortest cycle for which a phase is meaningful.
constexpr double most_uneven = 1.5;

/// The oscillation along a path. The caller fills in row and axis.
std::optional<PeriodicCoordinate> oscillation_of(const Path& path, double per_second) {
    PeriodicCoordinate oscillation;
    for (const double x : path.x) oscillation.level += x / static_cast<double>(path.size());
    const auto [low, high] = std::minmax_element(path.x.begin(), path.x.end());
    oscillation.band = dead_band * (*high - *low);
    oscillation.crossings = upward_crossings(path, oscillation.level, oscillation.band);
    const std::vector<double>& at = oscillation.crossings;
    if (at.size() < fewest_crossings) return std::nullopt;
    double shortest = INFINITY;
    double longest = 0;
    for (std::size_t i = 1; i < at.size(); ++i) {
        shortest = std::min(shortest, at[i] - at[i - 1]);
        longest = std::max(longest, at[i] - at[i - 1]);
    }
    oscillation.period = (at.back() - at.front()) / static_cast<double>(at.size() - 1);
    if (longest > most_uneven * shortest ||
        oscillation.period * per_second < fewest_samples_in_period)
        return std::nullopt;
    return oscillation;
}

/// The row and the axis with the largest range.
struct Widest {
    std::size_t row = 0;
    int axis = 0;
};

Widest find_widest(const Reference& reference, std::optional<std::size_t> only) {
    const std::size_t bodies = reference.motion->bodies();
    std::vector<State<long double, 3>> low(bodies);
    reference.motion->all_at(0, low);
    std::vector<State<long double, 3>> high = low;
    std::vector<State<long double, 3>> states = low;
    for (const double t : probe_times(reference.meaningful_until, 0, bodies)) {
        reference.motion->all_at(t, states);
        for (std::size_t row = 0; row < bodies; ++row)
            for (int axis = 0; axis < 3; ++axis) {
                low[row].x[axis] = std::min(low[row].x[axis], states[row].x[axis]);
                high[row].x[axis] = std::max(high[row].x[axis], states[row].x[axis]);
            }
    }
    Widest widest{.row = only.value_or(0)};
    long double most = 0;
    for (std::size_t row = widest.row; row < (only ? *only + 1 : bodies); ++row)
        for (int axis = 0; axis < 3; ++axis)
            if (high[row].x[axis] - low[row].x[axis] > most) {
                most = high[row].x[axis] - low[row].x[axis];
                widest = {row, axis};
            }
    return widest;
}

}  // namespace

std::optional<PeriodicCoordinate> find_oscillation(const Reference& reference,
                                                   std::optional<std::size_t> only) {
    const auto [row, axis] = find_widest(reference, only);
    std::optional<PeriodicCoordinate> oscillation = oscillation_of(
        path_of(reference, row, axis), static_cast<double>(reference.samples.per_second));
    if (oscillation) {
        oscillation->row = row;
        oscillation->axis = axis;
    }
    return oscillation;
}

}  // namespace oiler::lab
