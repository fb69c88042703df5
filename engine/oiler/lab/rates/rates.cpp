// SPDX-License-Identifier: MIT
#include "oiler/lab/rates/rates.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/lab/rates/observed.hpp"

namespace oiler::lab {
namespace {

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
    for (const ObservedQuantity& kind : observed_quantities()) {
        if (std::isnan(kind.value(truth))) continue;
        RatesQuantity quantity{kind.name, kind.unit, kind.value(truth)};
        for (std::size_t i = 0; i < methods.size(); ++i) {
            RatesLine line{.method = methods[i]};
            for (const Observed& one : observed[i]) line.values.push_back(kind.value(one));
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
