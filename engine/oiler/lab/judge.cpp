// SPDX-License-Identifier: MIT
#include "oiler/lab/judge.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/lab/reference_parts.hpp"

namespace oiler {
namespace {

/// So many times what bodies move, and a run has nothing to do with the scene any more.
constexpr double lost = 10;

double distance(const Vec<long double, 3>& a, const Vec<long double, 3>& b) {
    return static_cast<double>(std::sqrt(squared_length(a - b)));
}

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
            if (reference_.swing && row == reference_.swing->row)
                swing_.push_back(swing_look(state));
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
    [[nodiscard]] SwingLook swing_look(const State<long double, 3>& state) const {
        const int axis = reference_.swing->axis;
        return {static_cast<double>(state.x[axis]), static_cast<double>(state.v[axis])};
    }
    [[nodiscard]] double phase_error() const {
        if (!reference_.swing) return unknown;
        const Swing& swing = *reference_.swing;
        const std::vector<double> at = upward_crossings(
            swing_, swing.level, swing.band, static_cast<double>(reference_.looks.per_second));
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
    std::vector<SwingLook> swing_;
};

}  // namespace

Judgement judge(const Scene& scene, const Settings& settings, const Reference& reference,
                const std::function<bool()>& stopped) {
    Follower follower(scene, settings, reference.looks.per_second);
    Notes notes(reference);
    for (std::int64_t look = 0; look < reference.meaningful && !stopped(); ++look)
        if (!follower.go_to(look) || !notes.take(look, follower)) return {.stable = false};
    Judgement judgement = notes.judgement();
    judgement.evaluations =
        evaluations_per_step(scene, settings) *
        std::ceil(reference.meaningful_until() * static_cast<double>(settings.rate.steps));
    return judgement;
}

std::string why_not(const Scene& scene, const Settings& settings) try {
    make_world(scene, settings).require_applicable();
    return "";
} catch (const Error& error) {
    return error.what();
}

double evaluations_per_step(const Scene& scene, const Settings& settings) {
    constexpr std::int64_t steps = 16;
    const auto after = [&](std::int64_t count) {
        World world = make_world(scene, settings);
        world.step(count);
        return static_cast<double>(world.bodies().evaluations());
    };
    try {
        return (after(2 * steps) - after(steps)) / static_cast<double>(steps);
    } catch (const Error&) {
        return unknown;
    }
}

}  // namespace oiler
