// SPDX-License-Identifier: MIT
#include "oiler/lab/rates/observed.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/sim/bodies.hpp"

namespace oiler::lab {
namespace {

constexpr double settled = 0.05;  ///< of the distance from rest at the start
/// Bounces of this part of the largest height are finished.
constexpr double finished = 0.01;
/// Largest ratio of the longest to the shortest cycle of a motion that has a period.
constexpr double most_uneven = 1.1;

template <double Observed::*quantity>
double get(const Observed& observed) {
    return observed.*quantity;
}
template <std::size_t i>
double bounce(const Observed& observed) {
    return observed.bounces[i];
}

constexpr ObservedQuantity quantities[]{
    {"apex above the start", "m", get<&Observed::apex>},
    {"time of the apex", "s", get<&Observed::apex_time>},
    {"time of landing at the height of the start", "s", get<&Observed::landing_time>},
    {"place of landing, from the start", "m", get<&Observed::landing_place>},
    {"height of bounce 1", "m", bounce<0>},
    {"height of bounce 3", "m", bounce<1>},
    {"height of bounce 10", "m", bounce<2>},
    {"time at which bounces stay below 1 %", "s", get<&Observed::rest_time>},
    {"period", "s", get<&Observed::period>},
    {"amplitude over the last period", "m", get<&Observed::amplitude>},
    {"time to settle to 5 %", "s", get<&Observed::settle_time>},
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
    for (std::size_t i = 0; i < shown_bounces.size(); ++i)
        if (shown_bounces[i] <= heights.size()) observed.bounces[i] = heights[shown_bounces[i] - 1];
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

}  // namespace

std::span<const ObservedQuantity> observed_quantities() { return quantities; }

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

}  // namespace oiler::lab
