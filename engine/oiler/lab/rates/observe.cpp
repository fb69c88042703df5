// SPDX-License-Identifier: MIT
#include "oiler/lab/rates/observe.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/sim/bodies.hpp"

namespace oiler::lab {
namespace {

constexpr double settled = 0.05;  ///< of the largest distance from rest
/// Bounces up to this fraction of the largest height count as rest.
constexpr double finished = 0.01;
/// Largest ratio of the longest to the shortest cycle of a motion that has a period.
constexpr double most_uneven_period = 1.1;

std::size_t index_after(const Path& path, double time) {
    return static_cast<std::size_t>(std::ranges::upper_bound(path.t, time) - path.t.begin());
}

double range_of(const Path& path) {
    const auto [low, high] = std::ranges::minmax(path.x);
    return high - low;
}

int widest_axis(const Trace& trace) {
    const auto widest = std::ranges::max_element(trace.paths, {}, range_of);
    return static_cast<int>(widest - trace.paths.begin());
}

/// The distance of a body from its floor.
Path height_of(const Floor& floor, const Trace& trace) {
    Path height{.t = trace.paths[0].t};
    const auto along_normal = [&](std::vector<double> Path::*of, Real less) {
        std::vector<double> sum;
        for (std::size_t i = 0; i < (trace.paths[0].*of).size(); ++i) {
            Real3 vector{};
            for (int axis = 0; axis < 3; ++axis)
                vector[axis] = (trace.paths[static_cast<std::size_t>(axis)].*of)[i];
            sum.push_back(static_cast<double>(dot(floor.normal, vector) - less));
        }
        return sum;
    };
    height.x = along_normal(&Path::x, floor.offset);
    height.v = along_normal(&Path::v, 0);
    return height;
}

/// The highest of the path's points between two times; unknown if there is none.
double highest_between(const Path& path, double from, double to) {
    const std::size_t first = index_after(path, from);
    std::size_t last = first;
    while (last < path.size() && path.t[last] < to) ++last;
    return first == last ? unknown : highest(path, first, last).x;
}

/// The heights of flights that end in an impact or, the last one, have passed their apex. A flight
/// between two points of the path has an unknown height. Flights of up to `noise` m are left out.
std::vector<double> heights_of_bounces(const Path& height, const std::vector<double>& impacts,
                                       double noise) {
    std::vector<double> heights;
    for (std::size_t i = 0; i < impacts.size(); ++i) {
        const bool is_last = i + 1 == impacts.size();
        const double peak =
            highest_between(height, impacts[i], is_last ? INFINITY : impacts[i + 1]);
        const bool is_over = !is_last || height.x.back() < peak - noise;
        if (is_over && !(peak <= noise)) heights.push_back(peak);
    }
    return heights;
}

/// Whether the first flight after a time is seen to stay low, if all points from then on are: it
/// has passed its apex, or the body lies on the floor. Within the step of that time, a straight
/// line is higher than the body: the impact may be earlier.
bool stays_low(const Path& height, const std::vector<double>& impacts, double from, double noise) {
    const auto impact = std::ranges::upper_bound(impacts, height.t[index_after(height, from) - 1]);
    if (impact == impacts.end()) return false;
    double peak = 0;
    const std::size_t first = index_after(height, *impact);
    for (std::size_t i = first; i < height.size(); ++i) {
        peak = std::max(peak, height.x[i]);
        if (height.x[i] < peak - noise) return true;
    }
    return peak <= noise && first + 2 <= height.size();
}

/// The time from which on a path stays within `band` of a level.
double time_within(const Path& path, double level, double band) {
    std::size_t last = path.size() - 1;
    while (last > 0 && std::abs(path.x[last] - level) <= band) --last;
    if (last + 1 == path.size()) return unknown;
    const double edge = level + std::copysign(band, path.x[last] - level);
    return path.time(last + 1, path.crossing(last + 1, edge));
}

double largest_distance(const Path& path, double from) {
    return std::max(highest(path, 0, path.size()).x - from,
                    highest(turned(path), 0, path.size()).x + from);
}

/// The limit of an oscillation whose amplitude falls by a constant factor per extreme: Aitken's
/// formula on the last three extremes.
double limit_of(const Path& path, double band) {
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
    const double limit = limit_of(path, oscillation.band);
    const std::vector<double> at_limit = upward_crossings(path, limit, oscillation.band);
    const bool is_even = at_limit.size() >= oscillation.crossings.size() &&
                         unevenness(at_limit) <= unevenness(oscillation.crossings);
    return is_even ? limit : oscillation.level;
}

std::optional<Floor> floor_of(const Bodies& bodies, std::size_t row, const Vec3& gravity) {
    const std::optional<Contact> contact = bodies.contact(row);
    if (!contact) return std::nullopt;
    std::optional<Floor> floor;
    double steepest = 0;
    for (const ObstacleHandle handle : bodies.obstacles()) {
        const Obstacle obstacle = bodies.obstacle(handle);
        const auto* const plane = std::get_if<HalfSpaceShape>(&obstacle.shape);
        if (!plane || !obstacle.solid || (obstacle.layers & contact->meets) == 0) continue;
        const double facing = -dot(plane->normal, gravity) / length(plane->normal);
        if (!(facing > steepest)) continue;
        steepest = facing;
        const Real3 normal = to_real(plane->normal);
        const Real size = std::sqrt(squared_length(normal));
        floor = {handle, normal / size, plane->offset / size + static_cast<Real>(contact->radius)};
    }
    return floor;
}

}  // namespace

bool approaches(const Real3& normal, const Real3& velocity) {
    constexpr Real grazing = 1e-3L;
    return dot(normal, velocity) < -grazing * std::sqrt(squared_length(velocity));
}

Observer::Observer(const Scene& scene, const Reference& reference, std::size_t row) {
    if (scene.gravity && largest(*scene.gravity) > 0) {
        int up = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (std::abs((*scene.gravity)[axis]) > std::abs((*scene.gravity)[up])) up = axis;
        up_ = up;
        up_sign_ = (*scene.gravity)[up] > 0 ? -1 : 1;
        if (scene.axes > 1) across_ = up == 0 ? 1 : 0;
        floor_ =
            floor_of(make_world(scene, Settings{scene.stepping}).bodies(), row, *scene.gravity);
    }
    constexpr double negligible = 1e-9;
    Trace truth = true_trace(reference, row);
    noise_ =
        std::max({dead_band * range_of(truth.paths[static_cast<std::size_t>(widest_axis(truth))]),
                  negligible * reference.coordinate, 2 * reference.floor().position / margin});
    apex_until_ = up_ ? end_of_first_apex(truth) : 0;
    find_oscillation_or_rest(reference, row, truth);
    truth_ = observe(truth);
    bounces_aside_ = std::isnan(truth_.first_impact) && !truth.meetings.empty();
    if (bounces_aside_) truth_.first_impact = truth.meetings.front();
    // A ball that does not bounce has the time of its impact.
    if (std::isnan(truth_.bounce_1)) truth_.rest_time = unknown;
    // They stand in for the period of an oscillation that has none.
    if (!std::isnan(truth_.period) || !truth.impacts.empty())
        truth_.mean_period = truth_.half_range = unknown;
    if (rest_) rest_->shortest_end = (reference.meaningful_until - truth_.settle_time) / 2;
}

Trace Observer::true_trace(const Reference& reference, std::size_t row) const {
    // Bounces need more points than smooth motions.
    Trace trace;
    for (int axis = 0; axis < 3; ++axis)
        trace.paths[static_cast<std::size_t>(axis)] =
            path_of(reference, row, axis, floor_ ? 16 : 1);
    for (const Kink& kink : reference.motion->kinks(row)) {
        const double time = static_cast<double>(kink.time);
        const Real3 change = kink.after.v - kink.before.v;
        if (time <= reference.meaningful_until && squared_length(change) > 0 &&
            approaches(change / std::sqrt(squared_length(change)), kink.before.v))
            trace.meetings.push_back(time);
        if (!floor_) continue;
        const bool is_on_floor = std::abs(dot(floor_->normal, kink.after.x) - floor_->offset) <=
                                 static_cast<Real>(dead_band * reference.extent);
        if (is_on_floor && time <= reference.meaningful_until &&
            dot(floor_->normal, kink.before.v) < 0 && dot(floor_->normal, kink.after.v) >= 0)
            trace.impacts.push_back(time);
    }
    return trace;
}

void Observer::find_oscillation_or_rest(const Reference& reference, std::size_t row,
                                        const Trace& truth) {
    oscillation_ = find_oscillation(reference, row);
    is_regular_ = oscillation_.has_value();
    if (oscillation_) {
        const Path path = path_of(reference, row, oscillation_->axis);
        const double centre = centre_of(path, *oscillation_);
        const double band = settled * largest_distance(path, centre);
        rest_ = {oscillation_->axis, centre, truth.impacts.empty() ? band : 0};
        return;
    }
    rest_ = find_rest(reference, row, truth);
    if (!rest_ && truth.impacts.empty()) oscillation_ = find_oscillation(reference, row, INFINITY);
}

std::optional<Observer::Rest> Observer::find_rest(const Reference& reference, std::size_t row,
                                                  const Trace& truth) const {
    const int axis = widest_axis(truth);
    const Path& path = truth.paths[static_cast<std::size_t>(axis)];
    const double end = reference.meaningful_until;
    if (range_of(path) <= noise_) return std::nullopt;
    // A damped spring never leaves the enclosure of its last state.
    const Ball ball = reference.motion->enclosure(row, reference.motion->at(row, end));
    if (std::isfinite(ball.radius)) {
        const auto at = static_cast<double>(ball.centre[axis]);
        const double band = settled * largest_distance(path, at);
        if (ball.radius > band) return std::nullopt;
        return Rest{axis, at, band};
    }
    const double at = path.x.back();
    const bool stands = time_within(path, at, noise_) <= 0.9 * end;
    if (!stands || !truth.impacts.empty()) return std::nullopt;
    return Rest{axis, at, settled * largest_distance(path, at)};
}

Path Observer::height_along_gravity(const Trace& trace) const {
    const Path& along = trace.paths[static_cast<std::size_t>(*up_)];
    return up_sign_ > 0 ? along : turned(along);
}

double Observer::end_of_first_apex(const Trace& truth) const {
    const Path height = height_along_gravity(truth);
    const double top = highest(height, 0, height.size()).x - noise_;
    std::size_t i = 1;
    while (i < height.size() && highest(height, i, i + 1).x < top) ++i;
    std::size_t low = std::min(i, height.size() - 1);
    for (; i < height.size() && height.x[i] <= height.x[low] + noise_; ++i)
        if (height.x[i] < height.x[low]) low = i;
    return i < height.size() ? height.t[low] : INFINITY;
}

void Observer::observe_jump(Observed& observed, const Trace& trace) const {
    if (!up_) return;
    const Path height = height_along_gravity(trace);
    const double start = height.x.front();
    std::size_t landing = 1;
    while (landing < height.size() &&
           !(height.x[landing] < start && (landing == 1 || height.x[landing - 1] >= start)))
        ++landing;
    const Peak peak = highest(
        height, 0, std::min({landing + 1, height.size(), index_after(height, apex_until_)}));
    // A run that ends on the way up has no apex.
    if (!(peak.x > start + noise_) || peak.t == height.t.back()) return;
    observed.apex = peak.x - start;
    observed.apex_time = peak.t;
    if (landing == height.size()) return;
    const double s = height.crossing(landing, start);
    observed.landing_time = height.time(landing, s);
    if (!across_) return;
    const Path& place = trace.paths[static_cast<std::size_t>(*across_)];
    observed.landing_place = place.at(landing, s) - place.x.front();
}

void Observer::observe_bounces(Observed& observed, const Trace& trace) const {
    if (!floor_ || trace.impacts.empty()) return;
    const Path height = height_of(*floor_, trace);
    const bool has_fallen = highest_between(height, -1, trace.impacts.front()) > noise_;
    if (has_fallen) observed.first_impact = trace.impacts.front();
    const std::vector<double> heights = heights_of_bounces(height, trace.impacts, noise_);
    if (heights.size() >= 1) observed.bounce_1 = heights[0];
    if (heights.size() >= 3) observed.bounce_3 = heights[2];
    if (heights.size() >= 10) observed.bounce_10 = heights[9];
    if (!has_fallen && heights.empty()) return;
    const double low = finished * highest(height, 0, height.size()).x;
    const double time = time_within(height, 0, low);
    if (stays_low(height, trace.impacts, time, noise_)) observed.rest_time = time;
}

void Observer::observe_oscillation(Observed& observed, const Trace& trace) const {
    if (!oscillation_) return;
    const Path& path = trace.paths[static_cast<std::size_t>(oscillation_->axis)];
    const double level = is_regular_ ? rest_->at : oscillation_->level;
    const std::vector<double> up = upward_crossings(path, level, oscillation_->band);
    // Fewer than two steps per period show another oscillation.
    if (2 * (path.t[1] - path.t[0]) < oscillation_->period && up.size() >= 2) {
        observed.mean_period = (up.back() - up.front()) / static_cast<double>(up.size() - 1);
        if (unevenness(up) < most_uneven_period) observed.period = observed.mean_period;
    }
    observed.half_range =
        (highest(path, 0, path.size()).x + highest(turned(path), 0, path.size()).x) / 2;
    if (!is_regular_) return;
    std::size_t from = path.size() - 1;
    while (from > 1 && path.t[from - 1] > path.t.back() - oscillation_->period) --from;
    const double high = highest(path, from, path.size()).x;
    const double low = -highest(turned(path), from, path.size()).x;
    observed.amplitude = (high - low) / 2;
}

void Observer::observe_rest(Observed& observed, const Trace& trace) const {
    if (!rest_ || observed.amplitude >= rest_->band) return;
    const Path& path = trace.paths[static_cast<std::size_t>(rest_->axis)];
    const double time = time_within(path, rest_->at, rest_->band);
    if (time + rest_->shortest_end <= path.t.back()) observed.settle_time = time;
    const bool from_above = path.x.front() > rest_->at;
    const double beyond = from_above ? rest_->at + highest(turned(path), 0, path.size()).x
                                     : highest(path, 0, path.size()).x - rest_->at;
    if (beyond > noise_ && std::abs(path.x.front() - rest_->at) > noise_)
        observed.overshoot = beyond;
}

Observed Observer::observe(const Trace& trace) const {
    Observed observed;
    observe_jump(observed, trace);
    observe_bounces(observed, trace);
    if (bounces_aside_)
        observed.first_impact = trace.meetings.empty() ? unknown : trace.meetings.front();
    observe_oscillation(observed, trace);
    observe_rest(observed, trace);
    return observed;
}

}  // namespace oiler::lab
