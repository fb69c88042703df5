// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/stability/oscillations.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

/// The bodies that are linked with a row, with their forces, or the row alone.
Bodies island_of(const Bodies& bodies, std::size_t row) {
    if (!bodies.linked_rows()[row]) return alone(bodies, row, bodies.precision());
    const std::vector<std::size_t> labels = component_labels(bodies);
    Bodies island = bodies;
    for (std::size_t i = labels.size(); i-- > 0;)
        if (labels[i] != labels[row]) island.remove(i);
    return island;
}

/// Whether a rate and two higher ones step the bodies without a risk that makes a run unusable.
bool holds_from(const Bodies& bodies, const Risk& risk, const Method& method, const Steps& steps,
                double hertz) {
    return std::ranges::all_of(std::array{1.0, 1.1, 1.25}, [&](double factor) {
        const Steps tried{{std::llround(hertz * factor)}, 0, steps.count, steps.damping};
        return (!risk.orbit || keeps_shape(*risk.orbit, method, tried)) &&
               holds(bodies, method, tried);
    });
}

/// The lowest rate above the limit, with a margin of 10⁻⁹ for rounding, or the first one above that
/// is tried with success: a limit counts neither the speeds nor the tensions of a later motion.
std::optional<double> rate_above(double limit, const Risk& risk, const Method& method,
                                 const Steps& steps) {
    constexpr int most_trials = 12;
    const double at_limit =
        static_cast<double>(steps.rate.steps) / (limit * static_cast<double>(steps.rate.seconds));
    double hertz = std::floor(at_limit * (1 + 1e-9)) + 1;
    if (!(limit > 0) || !(hertz <= highest_rate)) return std::nullopt;
    if (is_linear(*risk.scene)) return hertz;
    const Bodies island = island_of(*risk.scene, risk.row);
    for (int trial = 0; trial < most_trials && hertz <= highest_rate; ++trial) {
        if (holds_from(island, risk, method, steps, hertz)) return hertz;
        hertz = std::ceil(hertz * 1.1);
    }
    return std::nullopt;
}

/// A method that steps the risk's bodies at the rate, if neither a rate nor an implicit one does.
std::string other_remedy(const Risk& risk, const Method& method, const Steps& steps) {
    if (!is_finite(*risk.scene)) return "take another method";
    const Bodies island = island_of(*risk.scene, risk.row);
    for (const char* name : {"velocity_verlet", "rk4", "pefrl", "blanes_moan_srkn6b"})
        if (name != method.name &&
            holds(island, find_method(name), {steps.rate, steps.first, steps.count}))
            return fmt::format("take {}", name);
    return "no rate or method that was tried holds: give the body another position or velocity, or "
           "weaker forces";
}

/// The limit of a body at which its linear drag does not throw it back either.
double lower_for_drag(double limit, const Risk& risk, const Method& method, const Steps& steps) {
    if (!(limit > 0) || !std::isfinite(limit) || risk.linked || risk.component) return limit;
    if (!risk.scene || !is_linear(*risk.scene) || risk.scene->linked_rows()[risk.row]) return limit;
    const Steps shorter{scaled_rate(steps.rate, limit * (1 - 1e-9)), 0, 1, steps.damping};
    Region region(method, steps.damping.value_or(method.damping));
    std::vector<Risk> thrown;
    add_drag_risks(alone(*risk.scene, risk.row, Precision::double_), region, shorter, thrown);
    return thrown.empty() ? limit : limit * drag_limit(thrown.front(), method, shorter);
}

}  // namespace

bool is_attraction(const Risk& risk) {
    return risk.of == Risk::Of::attractor || risk.of == Risk::Of::periapsis;
}

bool is_rounding(const Risk& risk) {
    return risk.of == Risk::Of::rounded_position || risk.of == Risk::Of::rounded_velocity;
}

double limit_of(const Risk& risk, const Method& method, const Steps& steps) {
    const Damping damping = steps.damping.value_or(method.damping);
    if (risk.of == Risk::Of::explosion) return trial_limit(risk, method, steps);
    if (risk.of == Risk::Of::quadratic_drag || risk.of == Risk::Of::linear_drag)
        return drag_limit(risk, method, steps);
    if (risk.orbit) return orbit_limit(*risk.orbit, method, damping, steps.rate);
    return lower_for_drag(spring_limit(risk, method, damping, steps.rate.dt()), risk, method,
                          steps);
}

std::string remedy_for(double limit, const Risk& risk, const Method& method, const Steps& steps) {
    if (limit > 0 && !is_linear(*risk.scene) && !is_finite(*risk.scene))
        return fmt::format("take a higher rate, or {}",
                           risk.remedy ? risk.remedy->name : "another method");
    const std::optional<double> rate = rate_above(limit, risk, method, steps);
    if (is_attraction(risk) && !rate && !risk.remedy)
        return "give the body another position or velocity";
    if (!risk.remedy)
        return rate ? fmt::format("rate ≥ {:.0f} Hz", *rate) : other_remedy(risk, method, steps);
    return rate ? fmt::format("rate ≥ {:.0f} Hz, or {}", *rate, risk.remedy->name)
                : fmt::format("take {}", risk.remedy->name);
}

}  // namespace oiler
