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

/// The limit of bodies at which their damping does not turn them back either.
double lower_for_damping(double limit, const Risk& risk, const Method& method, const Steps& steps) {
    if (!(limit > 0) || !std::isfinite(limit)) return limit;
    if (!risk.scene || !is_linear(*risk.scene)) return limit;
    const Steps shorter{scaled_rate(steps.rate, limit * (1 - 1e-9)), 0, 1, steps.damping};
    const Bodies island = island_of(*risk.scene, risk.row);
    Region region(method, steps.damping.value_or(method.damping));
    std::vector<Risk> turned;
    add_drag_risks(island, region, shorter, turned);
    add_overdamped_risks(island, method, shorter, turned);
    return turned.empty() ? limit : limit * limit_of(turned.front(), method, shorter);
}

/// Whether a risk makes no run unusable, or is a rounding that the present method has as well.
bool is_borne(const Risk& risk, const std::vector<Risk>& present) {
    if (risk.of == Risk::Of::told) return true;
    return is_rounding(risk) && std::ranges::any_of(present, [&](const Risk& one) {
               return one.row == risk.row && one.of == risk.of &&
                      std::abs(one.effect) >= std::abs(risk.effect);
           });
}

/// Whether bodies have springs whose forces turn, or are attracted: only a trial shows whether a
/// method holds them.
bool needs_trial(const Bodies& bodies) {
    for (std::size_t i = 0; i < bodies.link_count(); ++i)
        if (bodies.link_at(i).rest_length != 0) return true;
    return any_body_has(bodies, []<class Force>() {
        return LineSpring<Force> || std::is_same_v<Force, Attractor>;
    });
}

/// The risks of another method that make a run unusable.
std::vector<Risk> risks_of_remedy(const Bodies& bodies, const Method& method, const Steps& steps,
                                  const std::vector<Risk>& present) {
    std::vector<Risk> risks = find_risks(bodies, method, {steps.rate, steps.first, steps.count});
    std::erase_if(risks, [&](const Risk& risk) { return is_borne(risk, present); });
    return risks;
}

/// Implicit Euler would end an oscillation that lasts.
bool lasts(const Risk& risk) {
    if (risk.of == Risk::Of::overdamped) return false;
    return risk.damping_dt < 2 * risk.omega_dt || risk.of == Risk::Of::explosion;
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
    if (risk.of == Risk::Of::overdamped) return overdamped_limit(risk, method, steps);
    if (risk.orbit) return orbit_limit(*risk.orbit, method, damping, steps.rate);
    return lower_for_damping(spring_limit(risk, method, damping, steps.rate.dt()), risk, method,
                             steps);
}

void add_remedies(const Bodies& bodies, const Method& method, const Steps& steps,
                  std::vector<Risk>& risks) {
    const std::vector<std::size_t> labels = component_labels(bodies);
    std::vector<bool> is_overdamped(bodies.size());
    for (const char* name : {"implicit_midpoint", "implicit_euler"}) {
        const auto helps = [&](const Risk& risk) {
            const bool may_end = !lasts(risk) || is_overdamped[labels[risk.row]];
            return risk.of != Risk::Of::told && !is_attraction(risk) && !is_rounding(risk) &&
                   may_end == (name == std::string_view("implicit_euler")) && method.name != name;
        };
        if (std::ranges::none_of(risks, helps)) continue;
        const Method& remedy = find_method(name);
        const bool is_tried = is_finite(bodies);
        if (!is_tried && needs_trial(bodies)) continue;
        bool holds = true;
        for (const Risk& risk :
             is_tried ? risks_of_remedy(bodies, remedy, steps, risks) : std::vector<Risk>()) {
            holds = false;
            if (risk.of == Risk::Of::overdamped) is_overdamped[labels[risk.row]] = true;
        }
        for (Risk& risk : risks)
            if (holds && helps(risk)) risk.remedy = &remedy;
    }
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
