// SPDX-License-Identifier: MIT
#include "oiler/compare/runs/divergence.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <span>
#include <unordered_set>

#include "oiler/compare/runs/state_log.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/floating_point.hpp"

namespace oiler {
namespace {

std::span<const std::uint32_t> bodies_of(const StateLog& log, Rows rows) {
    return std::span(log.bodies).subspan(rows.row, rows.size());
}

/// Counts the bodies of several ticks, most of which have the bodies of the tick before.
class BodyCount {
public:
    void add(std::span<const std::uint32_t> bodies) {
        if (std::ranges::equal(bodies, before_)) return;
        known_.insert(bodies.begin(), bodies.end());
        before_ = bodies;
    }
    [[nodiscard]] std::size_t value() const { return known_.size(); }

private:
    std::span<const std::uint32_t> before_;
    std::unordered_set<std::uint32_t> known_;
};

/// Steps of 0, 1, …, last − first in about equal ratios.
std::vector<std::int64_t> growth_ticks(std::int64_t first, std::int64_t last) {
    constexpr int ratios = 10;
    const auto steps = static_cast<double>(last - first);
    std::vector<std::int64_t> ticks{first};
    for (int i = 0; i <= ratios; ++i) {
        const auto tick = first + std::llround(std::pow(steps, static_cast<double>(i) / ratios));
        if (tick > ticks.back() && tick <= last) ticks.push_back(tick);
    }
    return ticks;
}

class LogComparison {
public:
    LogComparison(const StateLog& a, const StateLog& b)
        : a_(a), b_(b), floats_(a.floats && b.floats) {}

    [[nodiscard]] RunDivergence run() {
        result_.first_tick = std::min(a_.ticks.front().tick, b_.ticks.front().tick);
        result_.last_tick = std::min(a_.ticks.back().tick, b_.ticks.back().tick);
        result_.floats = floats_;
        BodyCount count;
        TickPairs pairs(a_, b_, result_.last_tick);
        while (const std::optional<TickPair> pair = pairs.next()) {
            compare(*pair);
            count.add(bodies_of(a_, pair->a));
            if (!matched_) count.add(bodies_of(b_, pair->b));
            result_.last_time = pair->time_a;
        }
        result_.bodies = count.value();
        if (result_.value)
            for (const std::int64_t tick : growth_ticks(result_.value->tick, result_.last_tick))
                add_growth(tick);
        return std::move(result_);
    }

private:
    void compare(const TickPair& pair) {
        matched_ = std::ranges::equal(bodies_of(a_, pair.a), bodies_of(b_, pair.b));
        if (!matched_ && !result_.presence) result_.presence = presence_of(pair);
        if (!result_.times && !has_same_bits(pair.time_a, pair.time_b))
            result_.times = {pair.tick, pair.time_a, pair.time_b};
        if (!result_.value && !(matched_ && has_same_values(pair))) compare_values(pair);
    }

    [[nodiscard]] bool has_same_values(const TickPair& pair) const {
        const std::size_t width = a_.width();
        return std::memcmp(&a_.values[pair.a.row * width], &b_.values[pair.b.row * width],
                           pair.a.size() * width * sizeof(double)) == 0;
    }

    [[nodiscard]] RunDivergence::Presence presence_of(const TickPair& pair) const {
        RunDivergence::Presence presence{pair.tick, pair.time_a, {}, {}};
        const auto in_a = bodies_of(a_, pair.a);
        const auto in_b = bodies_of(b_, pair.b);
        std::ranges::set_difference(in_a, in_b, std::back_inserter(presence.only_a));
        std::ranges::set_difference(in_b, in_a, std::back_inserter(presence.only_b));
        return presence;
    }

    /// Calls f(row of a, row of b) for the bodies that both have.
    template <class F>
    void for_each_body(const TickPair& pair, const F& f) const {
        std::size_t row_a = pair.a.row;
        std::size_t row_b = pair.b.row;
        while (row_a < pair.a.end && row_b < pair.b.end) {
            const std::uint32_t body_a = a_.bodies[row_a];
            const std::uint32_t body_b = b_.bodies[row_b];
            if (body_a == body_b) f(row_a, row_b);
            row_a += body_a <= body_b ? 1 : 0;
            row_b += body_b <= body_a ? 1 : 0;
        }
    }

    void compare_values(const TickPair& pair) {
        std::size_t differing = 0;
        for_each_body(pair, [&](std::size_t row_a, std::size_t row_b) {
            const bool differs = compare_rows(pair, row_a, row_b);
            differing += differs ? 1 : 0;
        });
        if (result_.value) result_.value->bodies = differing;
    }

    bool compare_rows(const TickPair& pair, std::size_t row_a, std::size_t row_b) {
        bool differs = false;
        for (std::size_t field = 0; field < a_.width(); ++field) {
            const double a = a_.row(row_a)[field];
            const double b = b_.row(row_b)[field];
            if (has_same_bits(a, b)) continue;
            differs = true;
            const std::uint64_t ulps = ulps_of(a, b);
            if (result_.value && ulps <= result_.value->ulps) continue;
            result_.value = {pair.tick,
                             pair.time_a,
                             a_.bodies[row_a],
                             static_cast<int>(field),
                             a,
                             b,
                             ulps,
                             distance_of(a, b),
                             0};
        }
        return differs;
    }

    [[nodiscard]] std::uint64_t ulps_of(double a, double b) const {
        return floats_ ? ulps_between(static_cast<float>(a), static_cast<float>(b))
                       : ulps_between(a, b);
    }

    /// Infinite if only one is NaN.
    [[nodiscard]] double distance_of(double a, double b) const {
        if (has_same_bits(a, b)) return 0;
        const double distance =
            floats_ ? std::abs(double{static_cast<float>(a)} - double{static_cast<float>(b)})
                    : std::abs(a - b);
        return std::isnan(distance) ? std::numeric_limits<double>::infinity() : distance;
    }

    /// Takes the next tick of the run, because captures have only those of their frames. Adds no
    /// row for a tick that only one run has, or that has one already.
    void add_growth(std::int64_t wanted) {
        const auto next = std::ranges::lower_bound(a_.ticks, wanted, {}, &StateLog::Tick::tick);
        if (next == a_.ticks.end()) return;
        const std::optional<TickPair> pair = find_tick(a_, b_, next->tick);
        if (!pair || (!result_.growth.empty() && result_.growth.back().tick >= next->tick)) return;
        std::optional<RunDivergence::Growth> furthest;
        for_each_body(*pair, [&](std::size_t row_a, std::size_t row_b) {
            const RunDivergence::Growth growth = growth_of(*pair, row_a, row_b);
            if (!furthest || growth.distance > furthest->distance) furthest = growth;
        });
        if (furthest) result_.growth.push_back(*furthest);
    }

    [[nodiscard]] RunDivergence::Growth growth_of(const TickPair& pair, std::size_t row_a,
                                                  std::size_t row_b) const {
        RunDivergence::Growth growth{pair.tick, pair.time_a, a_.bodies[row_a], 0, 0};
        double furthest = 0;
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(a_.axes); ++axis) {
            const double a = a_.row(row_a)[axis];
            const double b = b_.row(row_b)[axis];
            const double distance = distance_of(a, b);
            growth.distance = std::hypot(growth.distance, distance);
            if (!(distance > furthest)) continue;
            furthest = distance;
            growth.ulps = ulps_of(a, b);
        }
        return growth;
    }

    const StateLog& a_;
    const StateLog& b_;
    bool floats_;
    bool matched_ = true;  ///< whether the tick has the same bodies in both runs
    RunDivergence result_;
};

const char* axis_or_axes(int axes) { return axes == 1 ? "axis" : "axes"; }

}  // namespace

RunDivergence find_divergence(const StateLog& a, const StateLog& b) {
    assert(!a.ticks.empty() && !b.ticks.empty());
    if (a.axes != b.axes)
        fail(Exit::usage, "{} has {} {} and {} has {}; give runs of the same scene", a.name, a.axes,
             axis_or_axes(a.axes), b.name, b.axes);
    return LogComparison(a, b).run();
}

std::string field_name(int axes, int field) {
    const std::string axis(1, "xyz"[field % axes]);
    return field < axes ? axis : "v" + axis;
}

const char* field_unit(int axes, int field) { return field < axes ? "m" : "m/s"; }

}  // namespace oiler
