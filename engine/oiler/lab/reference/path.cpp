// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/path.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/lab/reference/scales.hpp"

namespace oiler::lab {

namespace {

constexpr double fewest_samples_in_period = 8;

/// The oscillation along a path: at least two cycles, upwards and downwards together. The caller
/// fills in row and axis.
std::optional<PeriodicCoordinate> oscillation_of(const Path& path, double per_second,
                                                 double most_uneven) {
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
    if (std::max(unevenness(up), unevenness(down)) > most_uneven ||
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
    std::vector<State3> low(bodies);
    reference.motion->all_at(0, low);
    std::vector<State3> high = low;
    std::vector<State3> states = low;
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

double Path::at(std::size_t i, double s) const {
    const double rise = x[i] - x[i - 1];
    if (v.empty()) return x[i - 1] + s * rise;
    const double dt = t[i] - t[i - 1];
    const double a = v[i - 1] * dt;
    const double b = v[i] * dt;
    return x[i - 1] + s * (a + s * ((3 * rise - 2 * a - b) + s * (a + b - 2 * rise)));
}

double Path::crossing(std::size_t i, double level) const {
    double low = 0;
    double high = 1;
    const bool up = x[i] > x[i - 1];
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        ((at(i, middle) < level) == up ? low : high) = middle;
    }
    return (low + high) / 2;
}

// Golden-section search.
double Path::summit(std::size_t i) const {
    constexpr double golden = 0.6180339887498949;
    double low = 0;
    double high = 1;
    for (int k = 0; k < 80; ++k) {
        const double a = high - golden * (high - low);
        const double b = low + golden * (high - low);
        (at(i, a) < at(i, b) ? low : high) = at(i, a) < at(i, b) ? a : b;
    }
    return (low + high) / 2;
}

Peak highest(const Path& path, std::size_t from, std::size_t to) {
    Peak peak{path.t[from], path.x[from]};
    for (std::size_t i = std::max<std::size_t>(1, from); i < to; ++i) {
        if (path.x[i] > peak.x) peak = {path.t[i], path.x[i]};
        if (path.v.empty() || !(path.v[i - 1] > 0 && path.v[i] <= 0)) continue;
        const double s = path.summit(i);
        if (path.at(i, s) > peak.x) peak = {path.time(i, s), path.at(i, s)};
    }
    return peak;
}

Path turned(Path path) {
    for (double& x : path.x) x = -x;
    for (double& v : path.v) v = -v;
    return path;
}

std::vector<double> upward_crossings(const Path& path, double level, double band) {
    std::vector<double> at;
    bool was_below = false;
    for (std::size_t i = 1; i < path.size(); ++i) {
        was_below = was_below || path.x[i - 1] < level - band;
        if (!was_below || !(path.x[i - 1] < level && path.x[i] >= level)) continue;
        at.push_back(path.time(i, path.crossing(i, level)));
        was_below = false;
    }
    return at;
}

double unevenness(const std::vector<double>& crossings) {
    double shortest = INFINITY;
    double longest = 0;
    for (std::size_t i = 1; i < crossings.size(); ++i) {
        shortest = std::min(shortest, crossings[i] - crossings[i - 1]);
        longest = std::max(longest, crossings[i] - crossings[i - 1]);
    }
    return longest > 0 ? longest / shortest : 1;
}

Path path_of(const Reference& reference, std::size_t row, int axis, std::int64_t times) {
    Path path;
    const auto add = [&](double t, const State3& state) {
        path.t.push_back(t);
        path.x.push_back(static_cast<double>(state.x[axis]));
        path.v.push_back(static_cast<double>(state.v[axis]));
    };
    const std::vector<Kink> kinks = reference.motion->kinks(row);
    auto kink = kinks.begin();
    const auto add_motion_at = [&](double t) {
        for (; kink != kinks.end() && kink->time <= t; ++kink) {
            add(static_cast<double>(kink->time), kink->before);
            add(static_cast<double>(kink->time), kink->after);
        }
        add(t, reference.motion->at(row, t));
    };
    const SampleTimes points{reference.samples.per_second * times, reference.samples.count * times};
    for (std::int64_t i = 0; i < points.count && points.time(i) < reference.meaningful_until; ++i)
        add_motion_at(points.time(i));
    add_motion_at(reference.meaningful_until);
    return path;
}

std::optional<PeriodicCoordinate> find_oscillation(const Reference& reference,
                                                   std::optional<std::size_t> only,
                                                   double most_uneven) {
    constexpr std::size_t most_tried = 3;
    std::vector<AxisRange> ranges = ranges_of(reference, only);
    ranges.resize(std::min(ranges.size(), most_tried));
    for (const auto& [row, axis, size] : ranges) {
        if (size < ranges.front().size / 10) break;
        std::optional<PeriodicCoordinate> oscillation =
            oscillation_of(path_of(reference, row, axis),
                           static_cast<double>(reference.samples.per_second), most_uneven);
        if (!oscillation) continue;
        oscillation->row = row;
        oscillation->axis = axis;
        return oscillation;
    }
    return std::nullopt;
}

}  // namespace oiler::lab
