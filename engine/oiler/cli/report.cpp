// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "oiler/app/interrupt.hpp"
#include "oiler/app/stills.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/cli/markup.hpp"
#include "oiler/cli/measuring.hpp"
#include "oiler/cli/tables.hpp"
#include "oiler/lab/advice/json.hpp"
#include "oiler/lab/rates_json.hpp"
#include "oiler/lab/sweep/json.hpp"
#include "oiler/lab/ledger/ledger.hpp"
#include "oiler/lab/sweep/tradeoff_picture.hpp"
#include "oiler/scene/draw.hpp"
#include "oiler/stability/oscillations.hpp"

extern "C" {
extern const char oiler_page[], oiler_page_end[];
extern const char oiler_chart[], oiler_chart_end[];
}

namespace oiler::cli {
namespace {

/// A page is for a first look: how far a sweep goes for it.
constexpr std::int64_t highest_multiple = 128;  ///< of how often is looked
constexpr double most_work = 5e7;
constexpr Size frame_size{960, 540};
constexpr double usual_tolerance = 1e-3;  ///< of what bodies move

/// What swings, alike ones together; the fastest first and not too many.
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

Json stability_json(const Scene& scene, const std::vector<const Method*>& methods) {
    constexpr int points = 11;
    constexpr double widest = 1.5;
    const Bodies bodies = make_world(scene, Settings{scene.stepping}).bodies();
    Json springs = springs_json(scene, bodies);
    if (springs.empty()) return nullptr;
    Json curves = Json::array();
    for (const Method* method : methods) {
        Json curve = Json::array();
        for (int i = 0; i < points; ++i) {
            const double zeta = widest * i / (points - 1);
            const double limit = method->order == exact_order
                                     ? INFINITY
                                     : stability_limit(*method, method->damping, {1, 2 * zeta});
            curve.push_back(Json::array({zeta, std::isinf(limit) ? Json() : Json(limit)}));
        }
        curves.push_back({{"method", method->name}, {"points", std::move(curve)}});
    }
    return {{"methods", std::move(curves)}, {"springs", std::move(springs)}, {"rate", scene.stepping.rate.steps}};
}

Json ledger_json(const Scene& scene) {
    const auto steps = static_cast<std::int64_t>(scene.duration * static_cast<double>(scene.stepping.rate.steps));
    const Ledger found = ledger(scene, std::max<std::int64_t>(2, steps));
    Json passes = Json::array();
    for (const LedgerPass& pass : found.passes)
        passes.push_back({{"name", pass.name},
                          {"saves_ns", number(pass.saves_ns)},
                          {"saves_percent", number(pass.saves_percent)},
                          {"changes_position_m", number(pass.changes_position)}});
    return {{"ns_per_body_step", number(found.ns)},
            {"bytes_per_body", found.bytes_per_body()},
            {"passes", std::move(passes)},
            {"absent", found.absent},
            {"flags", found.flags}};
}

std::string frame_of(const Scene& scene) {
    Stills stills(frame_size);
    const World world = make_world(scene, Settings{scene.stepping});
    return address_of(stills.png(draw_scene(scene, world, camera_of(scene, world))));
}

Requirements requirements_of(const ReportCommand& command, const Scene& scene,
                             const Reference& reference) {
    Requirements requirements{.position_error = command.position_error,
                              .energy_drift = command.energy_drift};
    if (!requirements.has_tolerance()) {
        requirements.position_error = scene.budget.position_error;
        requirements.energy_drift = scene.budget.energy_drift;
    }
    if (!requirements.has_tolerance())
        requirements.position_error =
            std::pow(10, std::floor(std::log10(usual_tolerance * reference.extent)));
    requirements.methods = parse_methods("all");
    return requirements;
}

/// What is measured of a scene for its page.
struct Found {
    Tradeoff tradeoff;
    Advice advice;
    Rates rates;
};

Found measure(const ReportCommand& command, const Scene& scene, const Reference& reference,
              const Requirements& requirements) {
    const SampleTimes& samples = reference.samples;
    const SweepPlan plan{
        .methods = parse_methods("all"),
        .max_rate = std::min<std::int64_t>(
            1'000'000, std::max(scene.stepping.rate.steps, highest_multiple * samples.per_second)),
        .most_work = most_work};
    Found found{start_tradeoff(scene, samples, reference, plan), {}, {}};
    found.tradeoff.scene = name_of(command.measured);
    measure_tradeoff(found.tradeoff, scene, reference, plan, command.measured.quiet);
    SweepWatch watch;
    watch.stopped = Interrupt::requested;
    found.advice = advise(scene, reference, requirements, watch);
    found.rates = measure_rates(scene, reference, most_oscillating_row(reference),
                                RatesCommand{}.rates, usual_methods(scene), Interrupt::requested);
    return found;
}

Json obvious_names() {
    Json names = Json::array();
    for (const Method* method : obvious_methods()) names.push_back(method->name);
    return names;
}

}  // namespace

Exit ReportCommand::run() const {
    const Interrupt interrupt;
    Scene scene = read_measured(measured);
    Reference reference = measure_reference(scene, sample_times_of(scene), 0, measured.quiet);
    if (Interrupt::requested()) return Exit::interrupted;
    if (!reference.why_no_longer.empty()) {
        remark(measured.quiet, "the page is about the first {:.4g} s: {}",
               reference.meaningful_until(), reference.why_no_longer);
        scene.duration = reference.meaningful_until();
        reference = measure_reference(scene, sample_times_of(scene), 0, measured.quiet);
    }
    const Requirements requirements = requirements_of(*this, scene, reference);
    require_judgeable(scene, reference, requirements);
    File page(out);
    const auto [tradeoff, advice, rates] = measure(*this, scene, reference, requirements);
    if (Interrupt::requested()) return Exit::interrupted;
    const Json data{{"tradeoff", json_of(tradeoff)},
                    {"advice", json_of(advice, scene, reference, requirements)},
                    {"stability", stability_json(scene, notable_methods(tradeoff))},
                    {"rates", rates.quantities.empty() ? Json(nullptr) : json_of(rates)},
                    {"ledger", ledger_json(scene)},
                    {"obvious_methods", obvious_names()}};
    page.write(filled({oiler_page, oiler_page_end},
                      {{"@CHART_LIBRARY@", {oiler_chart, oiler_chart_end}},
                       {"@FRAME@", frame_of(scene)},
                       {"@TITLE@", escaped(scene.title.empty() ? tradeoff.scene : scene.title)},
                       {"@DATA@", for_script(data)}}));
    page.commit();
    if (!measured.json.empty()) write_json(measured.json, data);
    remark(measured.quiet, "{} is written; open it in a browser", out.string());
    return Exit::done;
}

}  // namespace oiler::cli
