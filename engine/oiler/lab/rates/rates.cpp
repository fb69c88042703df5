// SPDX-License-Identifier: MIT
#include "oiler/lab/rates/rates.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "oiler/core/error.hpp"
#include "oiler/lab/rates/observe.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::lab {
namespace {

struct ObservedQuantity {
    const char* name;
    const char* unit;
    double Observed::*value;
};

constexpr ObservedQuantity quantities[]{
    {"apex above the start", "m", &Observed::apex},
    {"time of the apex", "s", &Observed::apex_time},
    {"time of landing at the height of the start", "s", &Observed::landing_time},
    {"place of landing, from the start", "m", &Observed::landing_place},
    {"time of the first impact", "s", &Observed::first_impact},
    {"height of bounce 1", "m", &Observed::bounce_1},
    {"height of bounce 3", "m", &Observed::bounce_3},
    {"height of bounce 10", "m", &Observed::bounce_10},
    {"time at which bounces stay below 1 %", "s", &Observed::rest_time},
    {"period", "s", &Observed::period},
    {"mean period", "s", &Observed::mean_period},
    {"amplitude over the last period", "m", &Observed::amplitude},
    {"half of the range", "m", &Observed::half_range},
    {"overshoot", "m", &Observed::overshoot},
    {"time to settle to 5 %", "s", &Observed::settle_time},
};

/// Adds the impacts of the last steps.
void add_impacts(Trace& trace, const Bodies& bodies, const Rate& rate, std::size_t row,
                 const std::optional<Floor>& floor) {
    for (std::size_t i = 0; i < bodies.impact_count(); ++i) {
        const BodyImpact impact = bodies.impact_at(i, rate);
        if (impact.row != row) continue;
        const Real3 before = to_real(impact.before);
        if (approaches(to_real(impact.normal), before)) trace.meetings.push_back(impact.time);
        if (floor && impact.obstacle == floor->plane && dot(floor->normal, before) < 0)
            trace.impacts.push_back(impact.time);
    }
}

/// Returns none if the run is stopped, diverges, or gets farther than 10 × the reference's extent.
std::optional<Trace> run(const Scene& scene, const Stepping& choice, const Reference& reference,
                         std::size_t row, const std::optional<Floor>& floor,
                         const std::function<bool()>& stopped) try {
    World world = make_world(scene, Settings{choice});
    world.require_applicable();
    const Vec3 start = world.position_of_row(row);
    Trace trace;
    const auto steps = static_cast<std::int64_t>(
        std::ceil(reference.meaningful_until * static_cast<double>(choice.rate.steps)));
    for (std::int64_t tick = 0; tick <= steps; ++tick) {
        if (stopped() || (tick > 0 && world.try_step())) return std::nullopt;
        const Vec3 at = world.position_of_row(row);
        if (largest(at - start) > 10 * reference.extent) return std::nullopt;
        for (int axis = 0; axis < 3; ++axis) {
            trace.paths[static_cast<std::size_t>(axis)].t.push_back(world.time());
            trace.paths[static_cast<std::size_t>(axis)].x.push_back(at[axis]);
        }
        add_impacts(trace, world.bodies(), choice.rate, row, floor);
    }
    return trace;
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
    const Observer observer(scene, reference, row);
    const Observed& truth = observer.truth();
    std::vector<std::vector<Observed>> observed(methods.size());
    for (std::size_t i = 0; i < methods.size(); ++i)
        for (const std::int64_t rate : rates) {
            const auto trace =
                run(scene, {methods[i], {rate}, scene.stepping.precision, scene.stepping.damping},
                    reference, row, observer.floor(), stopped);
            observed[i].push_back(trace ? observer.observe(*trace) : Observed{});
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
    Json measured = Json::array();
    for (const RatesQuantity& quantity : rates.quantities) {
        Json lines = Json::array();
        for (const RatesLine& line : quantity.lines)
            lines.push_back({{"method", line.method->name},
                             {"values", line.values},
                             {"spread_percent", line.spread_percent}});
        measured.push_back({{"name", quantity.name},
                            {"unit", quantity.unit},
                            {"body", rates.body},
                            {"truth", quantity.truth},
                            {"methods", std::move(lines)}});
    }
    return {{"rates", rates.rates}, {"quantities", std::move(measured)}};
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
