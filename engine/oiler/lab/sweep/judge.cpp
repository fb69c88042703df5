// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/judge.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/lab/reference/path.hpp"
#include "oiler/lab/reference/parts.hpp"

namespace oiler::lab {
namespace {

/// So many times what bodies move, and a run has nothing to do with the scene any more.
constexpr double lost = 10;

/// Takes notes of a run, look by look.
class Notes {
public:
    explicit Notes(const Reference& reference) : reference_(reference) {}

    /// False where the run is not worth following any further.
    bool take(std::int64_t look, const Follower& follower) {
        for (std::size_t row = 0; row < reference_.track.bodies; ++row) {
            const State<long double, 3> state = follower.state(row);
            const State<long double, 3>& exact = reference_.track.at(look, row);
            position_ = larger(position_, distance(state.x, exact.x));
            velocity_ = larger(velocity_, distance(state.v, exact.v));
            if (reference_.swing && row == reference_.swing->row) add_to_swing(look, state);
        }
        const double exact = reference_.track.energies[static_cast<std::size_t>(look)];
        energy_ = larger(energy_, std::abs(follower.energy() - exact));
        return position_ <= lost * reference_.extent;
    }

    [[nodiscard]] Judgement judgement() const {
        const Doubt floor = reference_.floor();
        const auto told = [](double error, double least) {
            return error >= least ? error : unknown;
        };
        return {.position_error = told(position_, floor.position),
                .velocity_error = told(velocity_, floor.velocity),
                .phase_error = phase_error(),
                .energy_drift = told(reference_.share_of_energy(energy_), floor.energy)};
    }

private:
    void add_to_swing(std::int64_t look, const State<long double, 3>& state) {
        swing_.t.push_back(reference_.looks.time(look));
        swing_.x.push_back(static_cast<double>(state.x[reference_.swing->axis]));
        swing_.v.push_back(static_cast<double>(state.v[reference_.swing->axis]));
    }
    [[nodiscard]] double phase_error() const {
        if (!reference_.swing) return unknown;
        const Swing& swing = *reference_.swing;
        const std::vector<double> at = upward_crossings(swing_, swing.level, swing.band);
        const std::size_t both = std::min(at.size(), swing.crossings.size());
        if (both == 0) return unknown;
        const double phase = 360 * (swing.crossings[both - 1] - at[both - 1]) / swing.period;
        // Of a swing whose middle is passed as fast as it ever is.
        const double least = 360 * reference_.floor().position / reference_.extent;
        return std::abs(phase) >= least ? phase : unknown;
    }

    const Reference& reference_;
    double position_ = 0;
    double velocity_ = 0;
    double energy_ = 0;
    Path swing_;
};

/// Whether a body gets away at a step, told without looking in between: of runs at low rates this
/// is what most do.
bool gets_lost(const Scene& scene, const Settings& settings, const Reference& reference,
               const std::function<bool()>& stopped) {
    World world = make_world(scene, settings);
    world.require_applicable();
    const auto steps = static_cast<std::int64_t>(reference.meaningful_until() *
                                                 static_cast<double>(settings.stepping.rate.steps));
    for (std::int64_t tick = 0; tick < steps && !stopped(); ++tick) {
        if (world.try_step()) return true;
        for (std::size_t row = 0; row < reference.track.bodies; ++row)
            if (!(distance(world.bodies().state(row).x, reference.track.at(0, row).x) <=
                  (lost + 1) * reference.extent))
                return true;
    }
    return false;
}

}  // namespace

Judgement judge(const Scene& scene, const Settings& settings, const Reference& reference,
                const std::function<bool()>& stopped) {
    if (settings.stepping.rate.steps < reference.looks.per_second &&
        gets_lost(scene, settings, reference, stopped))
        return {.stable = false};
    Follower follower(scene, settings, reference.looks.per_second);
    Notes notes(reference);
    for (std::int64_t look = 0; look < reference.meaningful && !stopped(); ++look)
        if (!follower.go_to(look) || !notes.take(look, follower)) return {.stable = false};
    Judgement judgement = notes.judgement();
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
            why_not(scene, Settings{{method, scene.stepping.rate, scene.stepping.precision}}).empty())
            usual.push_back(method);
    return usual;
}

double evaluations_per_step(const Scene& scene, const Settings& settings) {
    // An implicit method looks for each solution as long as it takes.
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
