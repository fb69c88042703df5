// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "oiler/lab/reference/parts.hpp"
#include "oiler/lab/reference/path.hpp"
#include "oiler/lab/reference/scales.hpp"

namespace oiler::lab {
namespace {

constexpr double fewest_samples_in_period = 8;
/// Largest ratio of the longest to the shortest cycle for which a phase is meaningful.
constexpr double most_uneven_phase = 1.5;

/// The oscillation along a path: at least two cycles, upwards and downwards together. The caller
/// fills in row and axis.
std::optional<PeriodicCoordinate> oscillation_of(const Path& path, double per_second) {
    PeriodicCoordinate oscillation;
    for (const double x : path.x) oscillation.level += x / static_cast<double>(path.size());
    const auto [low, high] = std::minmax_element(path.x.begin(), path.x.end());
    oscillation.band = dead_band * (*high - *low);
    oscillation.crossings = upward_crossings(path, oscillation.level, oscillation.band);
    const std::vector<double>& up = oscillation.crossings;
    const std::vector<double> down =
        upward_crossings(turned(path), -oscillation.level, oscillation.band);
    if (up.size() < 2 || up.size() + down.size() < 4) return std::nullopt;
    oscillation.period = (up.back() - up.front()) / static_cast<double>(up.size() - 1);
    if (std::max(unevenness(up), unevenness(down)) > most_uneven_phase ||
        oscillation.period * per_second < fewest_samples_in_period)
        return std::nullopt;
    return oscillation;
}

/// An axis of a body, and the range of its coordinate, m.
struct AxisRange {
    std::size_t row = 0;
    int axis = 0;
    double size = 0;
};

/// The ranges of row `only`, or of all rows, the widest first.
std::vector<AxisRange> ranges_of(const Reference& reference, std::optional<std::size_t> only) {
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
    std::vector<AxisRange> ranges;
    for (std::size_t row = only.value_or(0); row < (only ? *only + 1 : bodies); ++row)
        for (int axis = 0; axis < 3; ++axis)
            ranges.push_back(
                {row, axis, static_cast<double>(high[row].x[axis] - low[row].x[axis])});
    std::stable_sort(ranges.begin(), ranges.end(),
                     [](const AxisRange& a, const AxisRange& b) { return a.size > b.size; });
    return ranges;
}

}  // namespace

std::optional<PeriodicCoordinate> find_oscillation(const Reference& reference,
                                                   std::optional<std::size_t> only) {
    constexpr std::size_t most_tried = 3;
    std::vector<AxisRange> ranges = ranges_of(reference, only);
    ranges.resize(std::min(ranges.size(), most_tried));
    for (const auto& [row, axis, size] : ranges) {
        if (size < ranges.front().size / 10) break;
        std::optional<PeriodicCoordinate> oscillation = oscillation_of(
            path_of(reference, row, axis), static_cast<double>(reference.samples.per_second));
        if (!oscillation) continue;
        oscillation->row = row;
        oscillation->axis = axis;
        return oscillation;
    }
    return std::nullopt;
}

}  // namespace oiler::lab
