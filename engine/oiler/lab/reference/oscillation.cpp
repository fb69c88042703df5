// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "oiler/lab/reference/path.hpp"
#include "oiler/lab/reference/parts.hpp"

namespace oiler::lab {
namespace {

constexpr double fewest_looks_in_period = 8;
constexpr std::size_t fewest_crossings = 3;
/// From the shortest to the longest, of a swing whose phase means anything.
constexpr double most_uneven = 1.5;

/// A swing at that coordinate whose row and axis are still to be filled in.
std::optional<Swing> swing_of(const Path& path, double per_second) {
    Swing swing;
    for (const double x : path.x) swing.level += x / static_cast<double>(path.size());
    const auto [low, high] = std::minmax_element(path.x.begin(), path.x.end());
    swing.band = dead_band * (*high - *low);
    swing.crossings = upward_crossings(path, swing.level, swing.band);
    const std::vector<double>& at = swing.crossings;
    if (at.size() < fewest_crossings) return std::nullopt;
    double shortest = INFINITY;
    double longest = 0;
    for (std::size_t i = 1; i < at.size(); ++i) {
        shortest = std::min(shortest, at[i] - at[i - 1]);
        longest = std::max(longest, at[i] - at[i - 1]);
    }
    swing.period = (at.back() - at.front()) / static_cast<double>(at.size() - 1);
    if (longest > most_uneven * shortest || swing.period * per_second < fewest_looks_in_period)
        return std::nullopt;
    return swing;
}

}  // namespace

std::optional<Swing> find_swing(const Track& track, const Looks& looks,
                                std::optional<std::size_t> only) {
    std::size_t row = only.value_or(0);
    int axis = 0;
    long double widest = 0;
    for (std::size_t body = only.value_or(0); body < (only ? *only + 1 : track.bodies); ++body)
        for (int along = 0; along < 3; ++along) {
            long double low = track.at(0, body).x[along];
            long double high = low;
            for (std::int64_t look = 1; look < looks.count; ++look) {
                low = std::min(low, track.at(look, body).x[along]);
                high = std::max(high, track.at(look, body).x[along]);
            }
            if (high - low <= widest) continue;
            widest = high - low;
            row = body;
            axis = along;
        }
    std::optional<Swing> swing =
        swing_of(path_of(track, looks, row, axis), static_cast<double>(looks.per_second));
    if (swing) {
        swing->row = row;
        swing->axis = axis;
    }
    return swing;
}

}  // namespace oiler::lab
