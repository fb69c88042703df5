// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/judge.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/lab/reference/parts.hpp"
#include "oiler/lab/reference/path.hpp"

namespace oiler::lab {
namespace {

/// A run whose error exceeds this multiple of the extent counts as unstable.
constexpr double lost = 10;

/// The largest errors of a run, sample by sample.
class RunErrors {
public:
    explicit RunErrors(const Reference& reference) : reference_(reference) {}

    /// Returns false if the run is lost.
    bool take(std::int64_t sample, const Follower& follower) {
        for (std::size_t row = 0; row < reference_.trajectory.bodies; ++row) {
            const State<long double, 3> state = follower.state(row);
            const State<long double, 3>& exact = reference_.trajectory.at(sample, row);
            position_ = larger(position_, distance(state.x, exact.x));
            velocity_ = larger(velocity_, distance(state.v, exact.v));
            if (reference_.oscillation && row == reference_.oscillation->row)
                add_to_oscillation(sample, state);
        }
        const double exact = reference_.trajectory.energies[static_cast<std::size_t>(sample)];
        energy_ = larger(energy_, std::abs(follower.energy() - exact));
        return position_ <= lost * reference_.extent;
    }

    [[nodiscard]] Judgement judgement() const {
        const Uncertainty floor = reference_.floor();
        const auto above_floor = [](double error, double least) {
            return error >= least ? error : unknown;
        };
        return {.position_error = above_floor(position_, floor.position),
                .velocity_error = above_floor(velocity_, floor.velocity),
                .phase_error = phase_error(),
                .energy_drift = above_floor(reference_.share_of_energy(energy_), floor.energy)};
    }

private:
    void add_to_oscillation(std::int64_t sample, const State<long double, 3>& state) {
        oscillation_.t.push_back(reference_.samples.time(sample));
        oscillation_.x.push_back(static_cast<double>(state.x[reference_.oscillation->axis]));
        oscillation_.v.push_back(static_cast<double>(state.v[reference_.oscillation->axis]));
    }
    [[nodiscard]] double phase_error() const {
        if (!reference_.oscillation) return unknown;
        const PeriodicCoordinate& oscillation = *reference_.oscillation;
        const std::vector<double> at =
            upward_crossings(oscillation_, oscillation.level, oscillation.band);
        const std::size_t both = std::min(at.size(), oscillation.crossings.size());
        if (both == 0) return unknown;
        const double phase =
            360 * (oscillation.crossings[both - 1] - at[both - 1]) / oscillation.period;
        // The phase resolution at the middle, where the speed is largest.
        const double least = 360 * reference_.floor().position / reference_.extent;
        return std::abs(phase) >= least ? phase : unknown;
    }

    const Reference& reference_;
    double position_ = 0;
    double velocity_ = 0;
    double energy_ = 0;
    Path oscillation_;
};

/// Whether a run is lost at a step. Most runs at rates below the sampling rate are; this check is
/// cheaper than sampling between steps.
bool gets_lost(const Scene& scene, const Settings& settings, const Reference& reference,
               const std::function<bool()>& stopped) {
    World world = make_world(scene, settings);
    world.require_applicable();
    const auto steps = static_cast<std::int64_t>(reference.meaningful_until() *
                                                 static_cast<double>(settings.stepping.rate.steps));
    for (std::int64_t tick = 0; tick < steps && !stopped(); ++tick) {
        if (world.try_step()) return true;
        for (std::size_t row = 0; row < reference.trajectory.bodies; ++row)
            if (!(distance(world.bodies().state(row).x, reference.trajectory.at(0, row).x) <=
                  (lost + 1) * reference.extent))
                return true;
    }
    return false;
}

}  // namespace

Judgement judge(const Scene& scene, const Settings& settings, const Reference& reference,
                const std::function<bool()>& stopped) {
    if (settings.stepping.rate.steps < reference.samples.per_second &&
        gets_lost(scene, settings, reference, stopped))
        return {.stable = false};
    Follower follower(scene, settings, reference.samples.per_second);
    RunErrors errors(reference);
    for (std::int64_t sample = 0; sample < reference.meaningful && !stopped(); ++sample)
        if (!follower.go_to(sample) || !errors.take(sample, follower)) return {.stable = false};
    Judgement judgement = errors.judgement();
    judgement.evaluations =
        evaluations_per_step(scene, settings) *
        std::ceil(reference.meaningful_until() * static_cast<double>(settings.stepping.rate.steps));
    return judgement;
}

std::string why_not(const Scene& scene, const Settings& settings) try {
    make_world(scene, settings).require_applicable();
    return "";
} catch (const Error& error) {
    return error.what();
}

std::vector<const Method*> obvious_methods() {
    std::vector<const Method*> obvious;
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk4", "exact"})
        obvious.push_back(&find_method(name));
    return obvious;
}

std::vector<const Method*> usual_methods(const Scene& scene) {
    std::vector<const Method*> usual{scene.stepping.method};
    for (const Method* method : obvious_methods())
        if (method != scene.stepping.method &&
            why_not(scene, Settings{{method, scene.stepping.rate, scene.stepping.precision}})
                .empty())
            usual.push_back(method);
    return usual;
}

double evaluations_per_step(const Scene& scene, const Settings& settings) {
    // Implicit methods iterate, so their evaluations vary from step to step.
    const std::int64_t steps = settings.stepping.method->evaluations > 0 ? 1 : 16;
    const World start = make_world(scene, settings);
    const auto after = [&](std::int64_t count) {
        World world = start;
        if (world.try_step(count)) return unknown;
        return static_cast<double>(world.bodies().evaluations());
    };
    return (after(2 * steps) - after(steps)) / static_cast<double>(steps);
}

}  // namespace oiler::lab
