// SPDX-License-Identifier: MIT
#include "oiler/cli/report_data.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "oiler/cli/tables.hpp"
#include "oiler/lab/advice/json.hpp"
#include "oiler/lab/ledger/ledger.hpp"
#include "oiler/lab/rates_json.hpp"
#include "oiler/lab/sweep/json.hpp"
#include "oiler/lab/sweep/tradeoff_picture.hpp"
#include "oiler/stability/oscillations.hpp"

namespace oiler::cli {

using namespace lab;

namespace {

/// Lists the springs of the scene, grouped by ω and ζ, the fastest twelve first.
Json springs_json(const Scene& scene, const Bodies& bodies) {
    constexpr std::size_t most = 12;
    std::map<std::pair<double, double>, std::pair<std::string, int>> kinds;
    for (const BodyOscillation& one : oscillations(bodies, true)) {
        if (!(one.of.k > 0)) continue;
        const double omega = std::sqrt(one.of.k);
        auto& [name, count] = kinds[{-omega, one.of.c / (2 * omega)}];
        if (count++ > 0) continue;
        name = one.linked ? fmt::format("{} to {}, at most", scene.name_of_body(one.row),
                                        scene.name_of_body(*one.linked))
                          : fmt::format("springs of {}", scene.name_of_body(one.row));
    }
    Json list = Json::array();
    for (const auto& [shape, kind] : kinds)
        if (list.size() < most)
            list.push_back({{"name", kind.first},
                            {"omega", -shape.first},
                            {"zeta", shape.second},
                            {"count", kind.second}});
    return list;
}

/// Samples the largest stable ω·dt over the damping ratio ζ. null: no limit.
Json limit_curve(const Method& method) {
    constexpr int points = 11;
    constexpr double widest = 1.5;
    Json curve = Json::array();
    for (int i = 0; i < points; ++i) {
        const double zeta = widest * i / (points - 1);
        const double limit = method.order == exact_order
                                 ? INFINITY
                                 : stability_limit(method, method.damping, {1, 2 * zeta});
        curve.push_back(Json::array({zeta, std::isinf(limit) ? Json() : Json(limit)}));
    }
    return curve;
}

Json stability_json(const Scene& scene, const std::vector<const Method*>& methods) {
    const Bodies bodies = make_world(scene, Settings{scene.stepping}).bodies();
    Json springs = springs_json(scene, bodies);
    if (springs.empty()) return nullptr;
    Json curves = Json::array();
    for (const Method* method : methods)
        curves.push_back({{"method", method->name}, {"points", limit_curve(*method)}});
    return {{"methods", std::move(curves)},
            {"springs", std::move(springs)},
            {"rate", scene.stepping.rate.steps}};
}

Json ledger_json(const Scene& scene) {
    const auto steps =
        static_cast<std::int64_t>(scene.duration * static_cast<double>(scene.stepping.rate.steps));
    const Ledger measured = ledger(scene, std::max<std::int64_t>(2, steps));
    Json passes = Json::array();
    for (const LedgerPass& pass : measured.passes)
        passes.push_back({{"name", pass.name},
                          {"saves_ns", number(pass.saves_ns)},
                          {"saves_percent", number(pass.saves_percent)},
                          {"spread_percent", number(pass.spread_percent)},
                          {"changes_position_m", number(pass.changes_position)}});
    return {{"ns_per_body_step", number(measured.ns)},
            {"bytes_per_body", measured.bytes_per_body()},
            {"passes", std::move(passes)},
            {"absent", measured.absent},
            {"flags", measured.flags}};
}

Json obvious_names() {
    Json names = Json::array();
    for (const Method* method : obvious_methods()) names.push_back(method->name);
    return names;
}

}  // namespace

Json report_json(const Scene& scene, const Reference& reference, const Requirements& requirements,
                 const ReportResults& results) {
    const auto& [tradeoff, advice, rates] = results;
    return {{"tradeoff", json_of(tradeoff)},
            {"advice", json_of(advice, scene, reference, requirements)},
            {"stability", stability_json(scene, notable_methods(tradeoff))},
            {"rates", rates.quantities.empty() ? Json(nullptr) : json_of(rates)},
            {"ledger", ledger_json(scene)},
            {"obvious_methods", obvious_names()}};
}

}  // namespace oiler::cli
