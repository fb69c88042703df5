// SPDX-License-Identifier: MIT
#include "oiler/lab/rates/budget.hpp"

#include <fmt/core.h>

#include <cmath>

#include "oiler/core/error.hpp"

namespace oiler::lab {
namespace {

/// "position_error 19.8 m of 25 m: kept"
std::string describe(const BudgetEntry& entry, const char* unit) {
    if (std::isinf(entry.measured))
        return fmt::format("{} of {:g}{}: exceeded, the run is unstable", entry.name, entry.most,
                           unit);
    return fmt::format("{} {}{:.3g}{} of {:g}{}: {}", entry.name, entry.is_limit() ? "below " : "",
                       entry.measured, unit, entry.most, unit, entry.kept ? "kept" : "exceeded");
}

BudgetEntry make_entry(const char* name, const char* unit, double most, bool stable,
                       double measured, double floor) {
    if (most < floor)
        fail(
            Exit::usage,
            "[budget] {} = {:g}: expected at least {:.2g}, 100 × the reference's own error; give a "
            "larger limit or a shorter duration",
            name, most, floor);
    BudgetEntry entry{.name = name, .most = most, .measured = INFINITY, .floor = floor};
    if (stable) entry.measured = std::isnan(measured) ? floor : measured;
    entry.kept = entry.measured <= most;
    entry.words = describe(entry, unit);
    return entry;
}

}  // namespace

std::vector<BudgetEntry> check_budget(const Scene& given, const Settings& given_settings,
                                      const std::function<bool()>& stopped,
                                      const std::function<void(double)>& progress) {
    const Scene scene = with_seed(given, given_settings.seed);
    Settings settings = given_settings;
    settings.seed = 0;
    const SceneBudget& budget = scene.budget;
    std::vector<BudgetEntry> entries;
    if (budget.is_empty()) return entries;
    ReferenceEffort effort{.progress = progress, .stopped = stopped};
    if (budget.position_error) effort.wanted = *budget.position_error / 200;
    const Reference reference = make_reference(scene, effort);
    if (stopped()) return entries;
    if (!reference.why_no_longer.empty())
        fail(Exit::usage,
             "[budget]: errors on this scene are meaningful only up to {:.4g} s of {:.4g} s: {}; "
             "give it a shorter duration",
             reference.meaningful_until, scene.duration, reference.why_no_longer);
    const Judgement judgement = judge(scene, settings, reference, {.stopped = stopped});
    if (stopped()) return entries;
    const Uncertainty floor = reference.floor();
    if (budget.position_error)
        entries.push_back(make_entry("position_error", " m", *budget.position_error,
                                     judgement.stable, judgement.position_error, floor.position));
    if (budget.energy_drift)
        entries.push_back(make_entry("energy_drift", "", *budget.energy_drift, judgement.stable,
                                     judgement.energy_drift, floor.energy));
    return entries;
}

bool is_unstable(const Scene& scene, const Settings& settings,
                 const std::function<bool()>& stopped) try {
    // Any reference shows ten times the extent. 0 would ask for the best.
    constexpr double any = 1e300;
    const Reference reference = make_reference(scene, {.wanted = any, .stopped = stopped});
    return !stopped() && !judge(scene, settings, reference, {.stopped = stopped}).stable;
} catch (const Error& error) {
    if (error.exit() != Exit::usage && error.exit() != Exit::diverged) throw;
    return false;
}

}  // namespace oiler::lab
