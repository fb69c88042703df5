// SPDX-License-Identifier: MIT
#include "oiler/lab/budget.hpp"

#include <fmt/core.h>

#include <cmath>

#include "oiler/core/error.hpp"

namespace oiler::lab {
namespace {

BudgetLine make_line(std::string name, std::string unit, double most, bool stable, double measured,
                     double floor) {
    if (most < floor)
        fail(
            Exit::usage,
            "[budget] {} = {:g}: expected at least {:.2g}, 100 × the reference's own error; give a "
            "larger limit or a shorter duration",
            name, most, floor);
    BudgetLine line{std::move(name), std::move(unit), most, INFINITY, floor, false};
    if (stable) line.measured = std::isnan(measured) ? floor : measured;
    line.kept = line.measured <= most;
    return line;
}

}  // namespace

std::vector<BudgetLine> check_budget(const Scene& given, const Settings& given_settings,
                                     const std::function<bool()>& stopped) {
    const Scene scene = with_seed(given, given_settings.seed);
    Settings settings = given_settings;
    settings.seed = 0;
    const SceneBudget& budget = scene.budget;
    std::vector<BudgetLine> lines;
    if (budget.is_empty()) return lines;
    ReferenceEffort effort{.stopped = stopped};
    if (budget.position_error) effort.wanted = *budget.position_error / 200;
    const Reference reference = make_reference(scene, effort);
    if (stopped()) return lines;
    if (!reference.why_no_longer.empty())
        fail(Exit::usage,
             "[budget]: errors on this scene are meaningful only up to {:.4g} s of {:.4g} s: {}; "
             "give it a shorter duration",
             reference.meaningful_until, scene.duration, reference.why_no_longer);
    const Judgement judgement = judge(scene, settings, reference, {.stopped = stopped});
    if (stopped()) return lines;
    const Uncertainty floor = reference.floor();
    if (budget.position_error)
        lines.push_back(make_line("position_error", "m", *budget.position_error, judgement.stable,
                                  judgement.position_error, floor.position));
    if (budget.energy_drift)
        lines.push_back(make_line("energy_drift", "", *budget.energy_drift, judgement.stable,
                                  judgement.energy_drift, floor.energy));
    return lines;
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

std::string describe(const BudgetLine& line) {
    const std::string unit = line.unit.empty() ? "" : " " + line.unit;
    if (std::isinf(line.measured))
        return fmt::format("{} of {:g}{}: exceeded, the run is unstable", line.name, line.most,
                           unit);
    return fmt::format("{} {}{:.3g}{} of {:g}{}: {}", line.name,
                       line.measured == line.floor ? "below " : "", line.measured, unit, line.most,
                       unit, line.kept ? "kept" : "exceeded");
}

}  // namespace oiler::lab
