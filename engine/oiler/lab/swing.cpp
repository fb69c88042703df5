// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "oiler/lab/reference_parts.hpp"

namespace oiler {
namespace {

constexpr double fewest_looks_in_period = 8;
constexpr std::size_t fewest_crossings = 3;
/// From the shortest to the longest, of a swing whose phase means anything.
constexpr double most_uneven = 1.5;

/// Hermite's cubic from a to b in a time of 1, where velocities are per that time.
double cubic(const SwingLook& a, const SwingLook& b, double s) {
    const double rise = b.x - a.x;
    return a.x + s * (a.v + s * ((3 * rise - 2 * a.v - b.v) + s * (a.v + b.v - 2 * rise)));
}

/// Where in [0, 1] the cubic goes through the level, by bisection.
double crossing(const SwingLook& a, const SwingLook& b, double level) {
    double low = 0;
    double high = 1;
    for (int i = 0; i < 52; ++i) {
        const double middle = (low + high) / 2;
        (cubic(a, b, middle) < level ? low : high) = middle;
    }
    return (low + high) / 2;
}

std::vector<SwingLook> looks_at(const Track& track, std::int64_t looks, std::size_t row, int axis) {
    std::vector<SwingLook> all;
    for (std::int64_t look = 0; look < looks; ++look) {
        const auto& state = track.at(look, row);
        all.push_back({static_cast<double>(state.x[axis]), static_cast<double>(state.v[axis])});
    }
    return all;
}

/// A swing at that coordinate whose row and axis are still to be filled in.
std::optional<Swing> swing_of(const std::vector<SwingLook>& all, double per_second) {
    Swing swing;
    for (const SwingLook& look : all) swing.level += look.x / static_cast<double>(all.size());
    const auto [low, high] = std::minmax_element(
        all.begin(), all.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
    swing.band = dead_band * (high->x - low->x);
    swing.crossings = upward_crossings(all, swing.level, swing.band, per_second);
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

std::vector<double> upward_crossings(const std::vector<SwingLook>& looks, double level, double band,
                                     double per_second) {
    std::vector<double> at;
    bool was_below = false;
    for (std::size_t i = 1; i < looks.size(); ++i) {
        was_below = was_below || looks[i - 1].x < level - band;
        if (!was_below || !(looks[i - 1].x < level && looks[i].x >= level)) continue;
        const SwingLook a{looks[i - 1].x, looks[i - 1].v / per_second};
        const SwingLook b{looks[i].x, looks[i].v / per_second};
        at.push_back((static_cast<double>(i - 1) + crossing(a, b, level)) / per_second);
        was_below = false;
    }
    return at;
}

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
        swing_of(looks_at(track, looks.count, row, axis), static_cast<double>(looks.per_second));
    if (swing) {
        swing->row = row;
        swing->axis = axis;
    }
    return swing;
}

}  // namespace oiler
