// SPDX-License-Identifier: MIT
#include "oiler/lab/rates/rates.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "oiler/core/error.hpp"
#include "oiler/lab/reference/path.hpp"
#include "oiler/lab/sweep/judge.hpp"
#include "oiler/physics/contacts/plane.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::lab {
namespace {

/// The quantities that a player notices in one run of a body; `unknown` if the run lacks one.
struct Observed {
    double apex = unknown;
    double apex_time = unknown;
    double landing_time = unknown;
    double landing_place = unknown;
    double bounce_1 = unknown;
    double bounce_3 = unknown;
    double bounce_10 = unknown;
    double rest_time = unknown;
    double period = unknown;
    double amplitude = unknown;
    double settle_time = unknown;
};

struct ObservedQuantity {
    const char* name;
    const char* unit;
    double Observed::*value;
};

/// The floor under a body: the plane that faces gravity most.
struct Floor {
    std::array<double, 3> normal{};  ///< of length 1
    double offset = 0;               ///< m, with the body's radius
};

/// The axes, the floor and the oscillation along which a body is measured.
struct Observer {
    std::optional<int> up{};      ///< the axis of gravity
    double up_sign = 1;           ///< −1 if up is the negative direction
    std::optional<int> across{};  ///< the axis of the place of landing
    std::optional<Floor> floor{};
    std::optional<PeriodicCoordinate> oscillation{};
    double rest = 0;  ///< m, the centre of the oscillation
};

/// The three coordinates of a body.
using Paths = std::array<Path, 3>;

constexpr double settled = 0.05;  ///< of the distance from rest at the start
/// Bounces up to this fraction of the largest height count as rest.
constexpr double finished = 0.01;
/// Largest ratio of the longest to the shortest cycle of a motion that has a period.
constexpr double most_uneven = 1.1;

constexpr ObservedQuantity quantities[]{
    {"apex above the start", "m", &Observed::apex},
    {"time of the apex", "s", &Observed::apex_time},
    {"time of landing at the height of the start", "s", &Observed::landing_time},
    {"place of landing, from the start", "m", &Observed::landing_place},
    {"height of bounce 1", "m", &Observed::bounce_1},
    {"height of bounce 3", "m", &Observed::bounce_3},
    {"height of bounce 10", "m", &Observed::bounce_10},
    {"time at which bounces stay below 1 %", "s", &Observed::rest_time},
    {"period", "s", &Observed::period},
    {"amplitude over the last period", "m", &Observed::amplitude},
    {"time to settle to 5 %", "s", &Observed::settle_time},
};

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

/// The distance of a body from its floor.
Path height_of(const Floor& floor, const Paths& paths) {
    Path height{.t = paths[0].t};
    const auto along_normal = [&](std::vector<double> Path::*of, double less) {
        std::vector<double> sum((paths[0].*of).size(), -less);
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < sum.size(); ++i)
                sum[i] += floor.normal[axis] * (paths[axis].*of)[i];
        return sum;
    };
    height.x = along_normal(&Path::x, floor.offset);
    height.v = along_normal(&Path::v, 0);
    return height;
}

/// The highest points of a path after its lowest ones. Turns within `band` are round-off.
std::vector<double> heights_after_turns(const Path& path, double band) {
    std::vector<double> heights;
    bool rising = true;
    bool turned_up = false;
    std::size_t low = 0;
    std::size_t high = 0;
    for (std::size_t i = 1; i < path.size(); ++i) {
        if (rising && path.x[i] > path.x[high]) high = i;
        if (!rising && path.x[i] < path.x[low]) low = i;
        if (rising && path.x[i] < path.x[high] - band) {
            if (turned_up) heights.push_back(highest(path, low, i + 1).x);
            rising = false;
            low = i;
        } else if (!rising && path.x[i] > path.x[low] + band) {
            rising = turned_up = true;
            high = i;
        }
    }
    return heights;
}

void observe_bounces(Observed& observed, const Observer& observer, const Paths& paths) {
    if (!observer.floor) return;
    const Path height = height_of(*observer.floor, paths);
    const double most = highest(height, 0, height.size()).x;
    const std::vector<double> heights = heights_after_turns(height, dead_band * most);
    if (!heights.empty()) observed.bounce_1 = heights[0];
    if (heights.size() >= 3) observed.bounce_3 = heights[2];
    if (heights.size() >= 10) observed.bounce_10 = heights[9];
    std::size_t last = height.size() - 1;
    while (last > 0 && height.x[last] <= finished * most) --last;
    if (last + 1 < height.size())
        observed.rest_time = height.time(last + 1, height.crossing(last + 1, finished * most));
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
    const double change_of_rise = rise - (last[1] - last[0]);
    return change_of_rise == 0 ? last[1] : last[2] - rise * rise / change_of_rise;
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

std::optional<Floor> floor_of(const Bodies& bodies, std::size_t row, const Vec3& gravity) {
    const std::optional<Contact> contact = bodies.contact(row);
    if (!contact) return std::nullopt;
    std::optional<Floor> floor;
    double steepest = 0;
    for (const Plane& plane : bodies.planes()) {
        const double size = length(plane.normal);
        const double facing = -dot(plane.normal, gravity) / size;
        if (!(facing > steepest)) continue;
        steepest = facing;
        const Vec3 normal = plane.normal / size;
        floor = {{normal[0], normal[1], normal[2]}, plane.offset / size + contact->radius};
    }
    return floor;
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
    if (scene.gravity)
        observer.floor =
            floor_of(make_world(scene, Settings{scene.stepping}).bodies(), row, *scene.gravity);
    observer.oscillation = find_oscillation(reference, row);
    if (observer.oscillation)
        observer.rest =
            centre_of(path_of(reference, row, observer.oscillation->axis), *observer.oscillation);
    return observer;
}

Observed observe(const Observer& observer, const Paths& paths) {
    Observed observed;
    observe_jump(observed, observer, paths);
    observe_bounces(observed, observer, paths);
    observe_oscillation(observed, observer, paths);
    return observed;
}

/// Bounces need more points than smooth motions.
Paths paths_of(const Reference& reference, std::size_t row, bool bounces) {
    Paths paths;
    for (int axis = 0; axis < 3; ++axis)
        paths[static_cast<std::size_t>(axis)] = path_of(reference, row, axis, bounces ? 16 : 1);
    return paths;
}

/// Returns no paths if the run is stopped, diverges, or gets farther than 10 × the reference's
/// extent.
std::optional<Paths> run(const Scene& scene, const Stepping& choice, const Reference& reference,
                         std::size_t row, const std::function<bool()>& stopped) try {
    World world = make_world(scene, Settings{choice});
    world.require_applicable();
    const Vec3 start = world.position_of_row(row);
    Paths paths;
    const auto steps = static_cast<std::int64_t>(
        std::ceil(reference.meaningful_until * static_cast<double>(choice.rate.steps)));
    for (std::int64_t tick = 0; tick <= steps; ++tick) {
        if (stopped() || (tick > 0 && world.try_step())) return std::nullopt;
        const Vec3 at = world.position_of_row(row);
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
    const Observed truth = observe(observer, paths_of(reference, row, observer.floor.has_value()));
    std::vector<std::vector<Observed>> observed(methods.size());
    for (std::size_t i = 0; i < methods.size(); ++i)
        for (const std::int64_t rate : rates) {
            const auto paths =
                run(scene, {methods[i], {rate}, scene.stepping.precision, scene.stepping.damping},
                    reference, row, stopped);
            observed[i].push_back(paths ? observe(observer, *paths) : Observed{});
        }
    Rates result{.body = scene.name_of_body(row), .rates = rates};
    for (const ObservedQuantity& kind : quantities) {
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

Json to_json(const Rates& rates) {
    Json quantities = Json::array();
    for (const RatesQuantity& quantity : rates.quantities) {
        Json lines = Json::array();
        for (const RatesLine& line : quantity.lines)
            lines.push_back({{"method", line.method->name},
                             {"values", line.values},
                             {"spread_percent", line.spread_percent}});
        quantities.push_back({{"name", quantity.name},
                              {"unit", quantity.unit},
                              {"body", rates.body},
                              {"truth", quantity.truth},
                              {"methods", std::move(lines)}});
    }
    return {{"rates", rates.rates}, {"quantities", std::move(quantities)}};
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
