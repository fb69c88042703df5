// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "oiler/lab/reference/parts.hpp"
#include "oiler/lab/reference/path.hpp"

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

}  // namespace

std::optional<PeriodicCoordinate> find_oscillation(const Trajectory& trajectory,
                                                   const SampleTimes& samples,
                                                   std::optional<std::size_t> only) {
    std::size_t row = only.value_or(0);
    int axis = 0;
    long double widest = 0;
    for (std::size_t body = only.value_or(0); body < (only ? *only + 1 : trajectory.bodies); ++body)
        for (int along = 0; along < 3; ++along) {
            long double low = trajectory.at(0, body).x[along];
            long double high = low;
            for (std::int64_t sample = 1; sample < samples.count; ++sample) {
                low = std::min(low, trajectory.at(sample, body).x[along]);
                high = std::max(high, trajectory.at(sample, body).x[along]);
            }
            if (high - low <= widest) continue;
            widest = high - low;
            row = body;
            axis = along;
        }
    std::optional<PeriodicCoordinate> oscillation = oscillation_of(
        path_of(trajectory, samples, row, axis), static_cast<double>(samples.per_second));
    if (oscillation) {
        oscillation->row = row;
        oscillation->axis = axis;
    }
    return oscillation;
}

}  // namespace oiler::lab
