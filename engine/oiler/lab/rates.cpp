// SPDX-License-Identifier: MIT
#include "oiler/lab/rates.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/lab/reference/parts.hpp"
#include "oiler/lab/reference/path.hpp"

namespace oiler::lab {
namespace {

constexpr double settled = 0.05;  ///< of the distance from rest at the start
/// Largest ratio of the longest to the shortest cycle of a motion that has a period.
constexpr double most_uneven = 1.1;

/// The quantities of one run, in the order of `kinds`; `unknown` if the run does not have them.
struct Observed {
    double apex = unknown;
    double apex_time = unknown;
    double landing_time = unknown;
    double landing_place = unknown;
    double period = unknown;
    double amplitude = unknown;
    double settle_time = unknown;
};

struct ObservedQuantity {
    const char* name;
    const char* unit;
    double Observed::*value;
};
constexpr ObservedQuantity kinds[]{
    {"apex above the start", "m", &Observed::apex},
    {"time of the apex", "s", &Observed::apex_time},
    {"time of landing at the height of the start", "s", &Observed::landing_time},
    {"place of landing, from the start", "m", &Observed::landing_place},
    {"period", "s", &Observed::period},
    {"amplitude over the last period", "m", &Observed::amplitude},
    {"time to settle to 5 %", "s", &Observed::settle_time},
};

/// The axes and the oscillation along which a body is measured.
struct Observer {
    std::optional<int> up{};      ///< the axis of gravity
    double up_sign = 1;           ///< −1 if up is the negative direction
    std::optional<int> across{};  ///< the axis of the place of landing
    std::optional<PeriodicCoordinate> oscillation{};
    double rest = 0;  ///< m, the centre of the oscillation
};

using Paths = std::array<Path, 3>;

void observe_jump(Observed& observed, const Observer& observer, const Paths& paths) {
    if (!observer.up) return;
    const Path& along = paths[static_cast<std::size_t>(*observer.up)];
    const Path height = observer.up_sign > 0 ? along : turned(along);
    const double start = height.x.front();
    std::size_t landing = 1;
    while (landing < height.size() &&
           !(height.x[landing] < start && (landing == 1 || height.x[landing - 1] >= start)))
        ++landing;
    const Peak peak = highest(height, 0, std::min(landing + 1, height.size()));
    // A run that ends on the way up has no apex.
    if (!(peak.x > start) || peak.t == height.t.back()) return;
    observed.apex = peak.x - start;
    observed.apex_time = peak.t;
    if (landing == height.size()) return;
    const double s = height.crossing(landing, start);
    observed.landing_time = height.time(landing, s);
    if (!observer.across) return;
    const Path& place = paths[static_cast<std::size_t>(*observer.across)];
    observed.landing_place = place.at(landing, s) - place.x.front();
}

void observe_oscillation(Observed& observed, const Observer& observer, const Paths& paths) {
    if (!observer.oscillation) return;
    const Path& path = paths[static_cast<std::size_t>(observer.oscillation->axis)];
    const std::vector<double> up =
        upward_crossings(path, observer.rest, observer.oscillation->band);
    // Fewer than two steps per period show another oscillation.
    const bool shows_period = 2 * (path.t[1] - path.t[0]) < observer.oscillation->period;
    if (shows_period && up.size() >= 2 && unevenness(up) < most_uneven)
        observed.period = (up.back() - up.front()) / static_cast<double>(up.size() - 1);
    std::size_t from = path.size() - 1;
    while (from > 1 && path.t[from - 1] > path.t.back() - observer.oscillation->period) --from;
    const double high = highest(path, from, path.size()).x;
    const double low = -highest(turned(path), from, path.size()).x;
    observed.amplitude = (high - low) / 2;
    const double band = settled * std::abs(path.x.front() - observer.rest);
    if (observed.amplitude >= band) return;
    std::size_t last = path.size() - 1;
    while (last > 0 && std::abs(path.x[last] - observer.rest) <= band) --last;
    if (last + 1 == path.size()) return;
    const double edge = observer.rest + std::copysign(band, path.x[last] - observer.rest);
    observed.settle_time = path.time(last + 1, path.crossing(last + 1, edge));
}

Observed observe(const Observer& observer, const Paths& paths) {
    Observed observed;
    observe_jump(observed, observer, paths);
    observe_oscillation(observed, observer, paths);
    return observed;
}

Paths paths_of(const Reference& reference, std::size_t row) {
    Paths paths;
    for (int axis = 0; axis < 3; ++axis)
        paths[static_cast<std::size_t>(axis)] = path_of(reference, row, axis);
    return paths;
}

/// Returns no paths if the run is stopped, diverges, or gets farther than 10 × the reference's
/// extent.
std::optional<Paths> run(const Scene& scene, const Stepping& choice, const Reference& reference,
                         std::size_t row, const std::function<bool()>& stopped) try {
    World world = make_world(scene, Settings{choice});
    world.require_applicable();
    const Vec3 start = world.bodies().position(row);
    Paths paths;
    const auto steps = static_cast<std::int64_t>(
        std::ceil(reference.meaningful_until * static_cast<double>(choice.rate.steps)));
    for (std::int64_t tick = 0; tick <= steps; ++tick) {
        if (stopped() || (tick > 0 && world.try_step())) return std::nullopt;
        const Vec3 at = world.bodies().position(row);
        if (largest(at - start) > 10 * reference.extent) return std::nullopt;
        for (int axis = 0; axis < 3; ++axis) {
            paths[static_cast<std::size_t>(axis)].t.push_back(world.time());
            paths[static_cast<std::size_t>(axis)].x.push_back(at[axis]);
        }
    }
    return paths;
} catch (const Error& error) {
    if (error.exit() != Exit::usage) throw;
    return std::nullopt;
}

/// The limit of an oscillation whose amplitude falls by a constant factor per extreme: Aitken's
/// formula on the last three extremes.
double rest_of(const Path& path, double band) {
    const Path down = turned(path);
    std::vector<double> extremes;
    for (std::size_t i = 1; i < path.size(); ++i) {
        if (path.v[i - 1] > 0 && path.v[i] <= 0) extremes.push_back(path.at(i, path.summit(i)));
        if (path.v[i - 1] < 0 && path.v[i] >= 0) extremes.push_back(-down.at(i, down.summit(i)));
    }
    // Extremes within the dead band of the next are only round-off.
    while (extremes.size() > 3 &&
           std::abs(extremes[extremes.size() - 1] - extremes[extremes.size() - 2]) < band)
        extremes.pop_back();
    if (extremes.size() < 3) return path.x.back();
    const double* const last = extremes.data() + extremes.size() - 3;
    const double rise = last[2] - last[1];
    const double bend = rise - (last[1] - last[0]);
    return bend == 0 ? last[1] : last[2] - rise * rise / bend;
}

/// The limit of the oscillation, unless the level is crossed more evenly: the extremes of a motion
/// with several frequencies have no common limit.
double centre_of(const Path& path, const PeriodicCoordinate& oscillation) {
    const double rest = rest_of(path, oscillation.band);
    const std::vector<double> at_rest = upward_crossings(path, rest, oscillation.band);
    const bool is_even = at_rest.size() >= oscillation.crossings.size() &&
                         unevenness(at_rest) <= unevenness(oscillation.crossings);
    return is_even ? rest : oscillation.level;
}

Observer observer_of(const Scene& scene, const Reference& reference, std::size_t row) {
    Observer observer;
    if (scene.gravity && largest(*scene.gravity) > 0) {
        int up = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (std::abs((*scene.gravity)[axis]) > std::abs((*scene.gravity)[up])) up = axis;
        observer.up = up;
        observer.up_sign = (*scene.gravity)[up] > 0 ? -1 : 1;
        if (scene.axes > 1) observer.across = up == 0 ? 1 : 0;
    }
    observer.oscillation = find_oscillation(reference, row);
    if (observer.oscillation)
        observer.rest =
            centre_of(path_of(reference, row, observer.oscillation->axis), *observer.oscillation);
    return observer;
}

double spread_percent(const RatesLine& line, double truth) {
    double least = INFINITY;
    double most = -INFINITY;
    for (const double value : line.values) {
        if (std::isnan(value)) return unknown;
        least = std::min(least, value);
        most = std::max(most, value);
    }
    const double scale = truth != 0 ? std::abs(truth) : std::max(std::abs(least), std::abs(most));
    return scale > 0 ? 100 * (most - least) / scale : 0;
}

}  // namespace

Rates measure_rates(const Scene& scene, const Reference& reference, std::size_t row,
                    const std::vector<std::int64_t>& rates,
                    const std::vector<const Method*>& methods,
                    const std::function<bool()>& stopped) {
    const Observer observer = observer_of(scene, reference, row);
    const Observed truth = observe(observer, paths_of(reference, row));
    std::vector<std::vector<Observed>> observed(methods.size());
    for (std::size_t i = 0; i < methods.size(); ++i)
        for (const std::int64_t rate : rates) {
            const auto paths =
                run(scene, {methods[i], {rate}, scene.stepping.precision, scene.stepping.damping},
                    reference, row, stopped);
            observed[i].push_back(paths ? observe(observer, *paths) : Observed{});
        }
    Rates result{.body = scene.name_of_body(row), .rates = rates};
    for (const ObservedQuantity& kind : kinds) {
        if (std::isnan(truth.*kind.value)) continue;
        RatesQuantity quantity{kind.name, kind.unit, truth.*kind.value};
        for (std::size_t i = 0; i < methods.size(); ++i) {
            RatesLine line{.method = methods[i]};
            for (const Observed& one : observed[i]) line.values.push_back(one.*kind.value);
            line.spread_percent = spread_percent(line, quantity.truth);
            quantity.lines.push_back(std::move(line));
        }
        result.quantities.push_back(std::move(quantity));
    }
    return result;
}

std::size_t most_oscillating_row(const Reference& reference) {
    return reference.oscillation ? reference.oscillation->row : 0;
}

std::size_t find_body(const Scene& scene, const std::string& name) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (scene.bodies[i].name == name) return i;
    std::size_t row = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), row);
    if (error == std::errc() && end == name.data() + name.size() &&
        row < static_cast<std::size_t>(scene.body_count()))
        return row;
    fail(Exit::usage, "no body is called {}; give a body's name, or its index from 0 to {}", name,
         scene.body_count() - 1);
}

}  // namespace oiler::lab
