// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include "oiler/app/stills.hpp"
#include "oiler/cli/measuring.hpp"
#include "oiler/cli/output.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/core/markup.hpp"
#include "oiler/lab/advice/advise.hpp"
#include "oiler/lab/ledger/ledger.hpp"
#include "oiler/lab/rates/rates.hpp"
#include "oiler/lab/sweep/tradeoff_file.hpp"
#include "oiler/lab/sweep/tradeoff_picture.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/scene/draw.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/stability/oscillations.hpp"
extern "C" {
extern const char oiler_page[], oiler_page_end[];
extern const char oiler_chart[], oiler_chart_end[];
}

namespace oiler::cli {

using namespace lab;

namespace {

// A page is an overview, so its sweep ends earlier than that of `oiler tradeoff`.
constexpr std::int64_t highest_rate = 7680;   ///< Hz
constexpr std::int64_t highest_multiple = 8;  ///< rates over the samples of fast motion
constexpr double most_work = 5e7;             ///< see SweepPlan
constexpr Size frame_size{960, 540};
constexpr double usual_tolerance = 1e-3;  ///< relative to the extent of the motion

/// The measurements of a scene for its page.
struct ReportResults {
    Tradeoff tradeoff;
    Advice advice;
    Rates rates;
};

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
    const auto curve_of = [](const Method* method) {
        return Json{{"method", method->name}, {"points", limit_curve(*method)}};
    };
    return {{"methods", Json::list(methods, curve_of)},
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

/// Returns the data that report.html shows. Computes the stability limits and measures the ledger.
Json report_json(const Scene& scene, const Reference& reference, const Requirements& requirements,
                 const ReportResults& results) {
    const auto& [tradeoff, advice, rates] = results;
    return {{"tradeoff", to_json(tradeoff)},
            {"advice", to_json(advice, scene, reference, requirements)},
            {"stability", stability_json(scene, notable_methods(tradeoff))},
            {"rates", rates.quantities.empty() ? Json(nullptr) : to_json(rates)},
            {"ledger", ledger_json(scene)},
            {"obvious_methods",
             Json::list(obvious_methods(), [](const Method* method) { return method->name; })}};
}

std::string frame_of(const Scene& scene) {
    Stills stills(frame_size);
    const World world = make_world(scene, Settings{scene.stepping});
    return data_url_of(stills.png(draw_scene(scene, world, camera_of(scene, world))));
}

}  // namespace

struct ReportCommand {
    static constexpr CommandTexts texts{
        .name = "report",
        .summary = "Write all measurements of a scene to one HTML page",
        .example = "assets/scenes/orbit.toml --out orbit.html"};

    SceneOptions scene_options;
    ToleranceOptions tolerances;
    std::filesystem::path out = "report.html";

    void declare(Arguments& arguments) {
        scene_options.declare(arguments);
        tolerances.declare(arguments);
        arguments.add_output("--out", out, "output file", kinds::report);
    }

    [[nodiscard]] Exit run() const {
        Scene scene = scene_options.read();
        const Reference reference = measure_meaningful(scene);
        if (Interrupt::requested()) return Exit::interrupted;
        const Requirements requirements = this->requirements(scene, reference);
        require_judgeable(scene, reference, requirements);
        File page(out, kinds::report);
        const ReportResults results = measure(scene, reference, requirements);
        if (Interrupt::requested()) return Exit::interrupted;
        const Json data = report_json(scene, reference, requirements, results);
        page.write(page_of(scene, scene_options.name(), data));
        page.commit();
        if (!scene_options.json.empty()) write_json(scene_options.json, data);
        remark(scene_options.quiet, "{} is written; open it in a browser", out.string());
        return Exit::done;
    }

private:
    /// Takes the tolerance of the options, else of the budget, else the largest power of ten within
    /// `usual_tolerance`.
    [[nodiscard]] Requirements requirements(const Scene& scene, const Reference& reference) const {
        Requirements requirements{.position_error = tolerances.position_error,
                                  .energy_drift = tolerances.energy_drift};
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

    /// Shortens the scene to the time for which its reference is meaningful.
    [[nodiscard]] Reference measure_meaningful(Scene& scene) const {
        const bool quiet = scene_options.quiet;
        Reference reference = measure_reference(scene, 0, quiet);
        if (Interrupt::requested() || reference.why_no_longer.empty()) return reference;
        remark(quiet, "the page covers the first {:.4g} s: {}", reference.meaningful_until,
               reference.why_no_longer);
        scene.duration = reference.meaningful_until;
        return measure_reference(scene, 0, quiet);
    }

    [[nodiscard]] ReportResults measure(const Scene& scene, const Reference& reference,
                                        const Requirements& requirements) const {
        const SweepPlan plan{
            .methods = parse_methods("all"),
            .max_rate = std::min<std::int64_t>(
                1'000'000, std::max({scene.stepping.rate.steps, highest_rate,
                                     highest_multiple * reference.samples.per_second})),
            .most_work = most_work};
        ReportResults results{start_tradeoff(scene, reference, plan), {}, {}};
        results.tradeoff.scene = scene_options.name();
        measure_tradeoff(results.tradeoff, scene, reference, plan, scene_options.quiet);
        results.advice = find_advice(scene, reference, requirements, scene_options.quiet);
        results.rates = measure_rates(scene, reference, most_oscillating_row(reference),
                                      usual_rates(), usual_methods(scene), Interrupt::requested);
        return results;
    }

    [[nodiscard]] static std::string page_of(const Scene& scene, const std::string& name,
                                             const Json& data) {
        return fill_in({oiler_page, oiler_page_end},
                       {{"@CHART_LIBRARY@", {oiler_chart, oiler_chart_end}},
                        {"@FRAME@", frame_of(scene)},
                        {"@TITLE@", escaped(scene.title.empty() ? name : scene.title)},
                        {"@DATA@", for_script(data)}});
    }
};

template Command make_command<ReportCommand>();

}  // namespace oiler::cli
