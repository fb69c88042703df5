// SPDX-License-Identifier: MIT
#include "oiler/lab/ledger/ledger.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "oiler/core/require.hpp"
#include "oiler/lab/ledger/parts.hpp"
#include "oiler/scene/make_world.hpp"

namespace oiler::lab {
namespace {

/// Flags parts without effect. A part of a flagged part is not flagged again.
class Flags {
public:
    Flags(Ledger& ledger, const Comparison& comparison)
        : ledger_(ledger), comparison_(comparison) {}

    void raise(const std::vector<Ablation>& ablations) {
        for (std::size_t i = 0; i < ablations.size(); ++i)
            if (ablations[i].pass != "moving") raise(ablations[i], comparison_.without[i]);
    }
    void raise_for_axes(const Scene& scene, std::size_t bytes_per_number) {
        const Vec3& moved = comparison_.moved;
        if (std::all_of(moved.axis.begin(), moved.axis.end(), [](double by) { return by == 0; })) {
            ledger_.flags.push_back(fmt::format(
                "no body moves in {} steps: give a body a `velocity` or a force that acts",
                comparison_.steps));
            return;
        }
        for (int axis = 0; axis < scene.axes; ++axis)
            if (moved[axis] == 0)
                ledger_.flags.push_back(
                    fmt::format("no body moves along {} in {} steps, at {} bytes per body: fewer "
                                "`axes` suffice, except for the picture",
                                "xyz"[axis], comparison_.steps, 2 * bytes_per_number));
    }
    void raise_for_dampers(const Scene& scene) {
        for (std::size_t i = 0; i < scene.springs.size(); ++i) {
            const SceneSpring& spring = scene.springs[i];
            if (!spring.to && spring.rest_length == 0 && spring.stiffness == 0 &&
                spring.damping > 0)
                ledger_.flags.push_back(fmt::format(
                    "[[spring]] {} (of \"{}\") has `stiffness` 0 and only damps: write {} as "
                    "`linear_drag` of the body",
                    i + 1, scene.bodies[spring.body].name, spring.damping));
        }
    }

private:
    void raise(const Ablation& ablation, const AblationResult& result) {
        const bool said = said_.count(ablation.part_of) == 1;
        if (!said && (result.diverged || result.change > 0)) return;
        said_.insert(ablation.words);
        if (!said)
            ledger_.flags.push_back(fmt::format("{} has no effect in {} steps: leave it out",
                                                ablation.words, comparison_.steps));
    }

    Ledger& ledger_;
    const Comparison& comparison_;
    std::set<std::string> said_;
};

/// The untimed entries of an ablation's pass.
LedgerPass pass_of(const Ablation& ablation, const AblationResult& result) {
    LedgerPass pass{.name = ablation.pass};
    if (result.diverged)
        pass.diverged = result.diverged;
    else if (ablation.pass != "moving")
        pass.changes_position = result.change;
    return pass;
}

void enter_time(LedgerPass& pass, const Median& ratio, double whole_ns) {
    pass.spread_percent = 100 * ratio.spread;
    if (pass.name == "moving") {
        pass.ns = ratio.value * whole_ns;
        return;
    }
    pass.saves_percent = 100 * (1 - ratio.value);
    pass.saves_ns = (1 - ratio.value) * whole_ns;
    pass.ns = std::max(0.0, pass.saves_ns);
}

/// Times the whole scene, and the scene without each pass.
void time_passes(Ledger& ledger, const Scene& scene, const std::vector<const Scene*>& without,
                 const StepTimer& timer, const LedgerProgress& progress) {
    std::vector<const Scene*> scenes{&scene};
    std::vector<LedgerPass*> timed;
    for (std::size_t i = 0; i < without.size(); ++i)
        if (!ledger.passes[i].diverged) {
            scenes.push_back(without[i]);
            timed.push_back(&ledger.passes[i]);
        }
    const Timing timing = race(scenes, ledger.steps, timer, progress);
    ledger.timed_steps = timing.steps_per_turn;
    ledger.rounds = timing.rounds;
    const double body_steps = static_cast<double>(ledger.bodies * ledger.timed_steps);
    ledger.ns = 1e9 * timing.seconds.value / body_steps;
    ledger.spread_ns = 1e9 * timing.seconds.spread / body_steps;
    for (std::size_t i = 0; i < timed.size(); ++i)
        enter_time(*timed[i], timing.ratios[i], ledger.ns);
}

}  // namespace

bool LedgerPass::is_within_spread() const { return std::abs(saves_percent) <= spread_percent; }

Ledger ledger(const Scene& scene, std::int64_t steps, const LedgerProgress& progress,
              const StepTimer& timer) {
    require(steps >= 2, "a ledger takes at least two steps");
    Ledger ledger;
    const World world = make_world(scene, Settings{scene.stepping});
    const auto forces = enter_columns(ledger, world.bodies());
    if (ledger.bodies == 0) return ledger;
    const std::vector<Ablation> all = ablations(scene, forces, ledger.links > 0);
    const Comparison comparison = compare(scene, all, steps, progress);
    ledger.steps = comparison.steps;
    ledger.samples = comparison.samples;
    ledger.diverged = comparison.diverged;
    std::vector<const Scene*> without;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].pass.empty()) continue;
        ledger.passes.push_back(comparison.diverged ? LedgerPass{.name = all[i].pass}
                                                    : pass_of(all[i], comparison.without[i]));
        without.push_back(&all[i].scene);
    }
    if (ledger.diverged) return ledger;
    Flags flags(ledger, comparison);
    flags.raise(all);
    flags.raise_for_dampers(scene);
    flags.raise_for_axes(scene, ledger.columns.front().bytes);
    time_passes(ledger, scene, without, timer, progress);
    return ledger;
}

}  // namespace oiler::lab
