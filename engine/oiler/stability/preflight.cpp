// SPDX-License-Identifier: MIT
#include "oiler/stability/preflight.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/stability/oscillations.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

bool is_attraction(const Risk& risk) {
    return risk.of == Risk::Of::attractor || risk.of == Risk::Of::periapsis;
}

/// The remedy in words: the lowest rate above the limit, with a margin of 10⁻⁹ for rounding.
std::string remedy_for(double limit, const Rate& rate, const Risk& risk) {
    constexpr double most = 1e6;  // the highest rate of the programs, Hz
    const double at_limit =
        static_cast<double>(rate.steps) / (limit * static_cast<double>(rate.seconds));
    const double above = std::floor(at_limit * (1 + 1e-9)) + 1;
    if (is_attraction(risk))
        return above > most ? "give the body another position or velocity"
                            : fmt::format("rate ≥ {:.0f} Hz", above);
    // Implicit Euler would end an oscillation that lasts.
    const bool lasts = risk.damping_dt < 2 * risk.omega_dt;
    const char* const method = lasts ? "implicit_midpoint" : "implicit_euler";
    return above > most ? fmt::format("take {}", method)
                        : fmt::format("rate ≥ {:.0f} Hz, or {}", above, method);
}

double size(const Risk& risk) { return std::max(risk.omega_dt, risk.damping_dt); }

std::string describe_subject(const Risk& risk, const NameOfRow& name) {
    using enum Risk::Of;
    if (risk.linked)
        return fmt::format("link of bodies {} and {}", name(risk.row), name(*risk.linked));
    if (risk.of == quadratic_drag || risk.of == terminal_speed)
        return fmt::format("quadratic drag of body {}", name(risk.row));
    if (risk.of == attractor || risk.of == periapsis)
        return fmt::format("attractor of body {}", name(risk.row));
    return fmt::format("{} of body {}", risk.omega_dt > 0 ? "spring" : "linear drag",
                       name(risk.row));
}

std::string describe_measure(const Risk& risk) {
    switch (risk.of) {
        case Risk::Of::quadratic_drag:
            return fmt::format("c·|v|·dt = {:.4g} at {:.4g} m/s", risk.damping_dt, risk.at);
        case Risk::Of::terminal_speed:
            return fmt::format("2·c·|v|·dt = {:.4g} at the terminal speed of {:.4g} m/s",
                               risk.damping_dt, risk.at);
        case Risk::Of::attractor:
            return fmt::format("ω·dt = {:.4g} at {:.4g} m", risk.omega_dt, risk.at);
        case Risk::Of::periapsis:
            return fmt::format("ω·dt = {:.4g} at the closest point of the orbit, {:.4g} m",
                               risk.omega_dt, risk.at);
        default:
            break;
    }
    const bool oscillates = risk.omega_dt > 0;
    const bool is_bound = risk.linked || !risk.oscillations.empty();
    return fmt::format("{} {} {:.4g}", oscillates ? "ω·dt" : "c·dt", is_bound ? "up to" : "=",
                       oscillates ? risk.omega_dt : risk.damping_dt) +
           (oscillates && risk.damping_dt > 0
                ? fmt::format(" (ζ = {:.3g})", risk.damping_dt / (2 * risk.omega_dt))
                : std::string());
}

/// The factor on dt up to which steps are stable.
double limit_of(const Risk& risk, const Method& method, const Steps& steps) {
    const Damping damping = steps.damping.value_or(method.damping);
    if (risk.of == Risk::Of::quadratic_drag) return drag_limit(risk, method, steps);
    if (risk.orbit) return orbit_limit(*risk.orbit, method, damping, steps.rate);
    return spring_limit(risk, method, damping, steps.rate.dt());
}

std::string describe_rounding(const Risk& risk, const NameOfRow& name) {
    const bool is_position = risk.of == Risk::Of::rounded_position;
    const std::string number =
        fmt::format("{} {} of body {}", is_position ? "position" : "velocity",
                    axis_names[static_cast<std::size_t>(risk.axis)], name(risk.row));
    const char* const unit = is_position ? "m" : "m/s";
    const char* const remedy =
        is_position ? "take precision double, or an origin nearer to it" : "take precision double";
    if (risk.effect == -1)
        return fmt::format(
            "{}: its steps are shorter than {:.3g} {}, half of the last place in float, and do not "
            "{} it: {}",
            number, risk.at / 2, unit, is_position ? "move" : "change", remedy);
    return fmt::format(
        "{}: its steps are rounded to {:.3g} {}, the last place in float, and add up to {:.2g} % "
        "too {}: {}",
        number, risk.at, unit, 100 * std::abs(risk.effect), risk.effect > 0 ? "much" : "little",
        remedy);
}

std::string describe_without_rate(const Risk& risk, const NameOfRow& name) {
    if (risk.of == Risk::Of::on_attractor)
        return fmt::format(
            "body {} is on an attractor, where the force has no direction: move the body",
            name(risk.row));
    if (risk.of == Risk::Of::rounded_position || risk.of == Risk::Of::rounded_velocity)
        return describe_rounding(risk, name);
    if (risk.of == Risk::Of::quadratic_drag)
        return fmt::format(
            "quadratic drag of body {}: c·|v|·dt is not finite: take a higher rate, or "
            "implicit_euler",
            name(risk.row));
    return fmt::format(
        "attractor of body {}: the orbit leads into its centre, which no rate resolves: give the "
        "body another position or velocity",
        name(risk.row));
}

std::string likely_cause(const Bodies& bodies, const Divergence& at, const Method& method,
                         const Steps& steps, const NameOfRow& name) {
    const std::string by_default = "take a higher rate, or another method";
    const std::vector<Risk> risks = preflight(bodies, method, steps);
    const std::vector<std::size_t> labels = component_labels(bodies);
    const auto own = std::find_if(risks.begin(), risks.end(), [&](const Risk& risk) {
        return labels[risk.row] == labels[at.row];
    });
    if (own != risks.end() && own->of == Risk::Of::on_attractor)
        return fmt::format("{}; if it moved there, {}", describe(*own, method, steps, name),
                           by_default);
    if (risks.empty() || at.of == Divergence::Of::solution) return by_default;
    const Risk& cause = own == risks.end() ? risks.front() : *own;
    // The orbit of a body that hit its attractor is no longer known.
    if (is_attraction(cause) && !std::isfinite(cause.omega_dt)) return by_default;
    return describe(cause, method, steps, name);
}

bool has_lengths(const Bodies& bodies) {
    for (std::size_t i = 0; i < bodies.link_count(); ++i)
        if (bodies.link_at(i).rest_length != 0) return true;
    return any_body_has(bodies, []<class Force>() { return LineSpring<Force>; });
}

/// Whether the run diverges soon or gains a hundred times its kinetic energy.
bool explodes(Bodies bodies, const Method& method, Steps steps) {
    const double before = bodies.energy().kinetic;
    steps.count = 2048;
    return bodies.try_step(method, steps) || !(bodies.energy().kinetic <= 100 * before);
}

/// The spring risks that the first 512 steps of the run bring, because springs with a length turn
/// and gravity stretches nets. Springs turn back, so that a risk counts only if the run explodes
/// soon after. Only few bodies are stepped: a run must start at once.
std::vector<Risk> later_spring_risks(const Bodies& bodies, Region& region, Steps steps) {
    constexpr std::size_t most_bodies = 3000;
    if (bodies.axes() == 1 || bodies.size() > most_bodies || !has_lengths(bodies)) return {};
    if (contains_all_springs(bodies, region, steps.rate.dt())) return {};
    Bodies later = bodies;
    for (const std::int64_t count : {128, 384}) {
        steps.count = count;
        if (later.try_step(region.method(), steps)) return {};
        steps.first += count;
        std::vector<Risk> risks;
        add_spring_risks(later, region, steps.rate.dt(), risks);
        if (!risks.empty() && explodes(later, region.method(), steps)) return risks;
    }
    return {};
}

}  // namespace

std::vector<Risk> preflight(const Bodies& bodies, const Method& method, const Steps& steps) {
    const double dt = steps.rate.dt();
    Region region(method, steps.damping.value_or(method.damping));
    std::vector<Risk> risks;
    if (!is_implicit(method)) {
        add_spring_risks(bodies, region, dt, risks);
        if (risks.empty()) risks = later_spring_risks(bodies, region, steps);
    }
    add_drag_risks(bodies, region, steps, risks);
    add_attractor_risks(bodies, region, steps.rate, risks);
    add_rounding_risks(bodies, method, dt, risks);
    std::stable_sort(risks.begin(), risks.end(),
                     [](const Risk& a, const Risk& b) { return size(a) > size(b); });
    return risks;
}

std::string describe(const Risk& risk, const Method& method, const Steps& steps,
                     const NameOfRow& name) {
    if (!(size(risk) > 0) || !std::isfinite(size(risk))) return describe_without_rate(risk, name);
    const std::string who = describe_subject(risk, name);
    const std::string measure = describe_measure(risk);
    const double limit = limit_of(risk, method, steps);
    if (limit == 0)
        return fmt::format(
            "{}: {}, {} gains energy at any rate: take another method, for example "
            "velocity_verlet",
            who, measure, method.name);
    const double measured = risk.omega_dt > 0 ? risk.omega_dt : risk.damping_dt;
    return fmt::format("{}: {}, {} needs < {:.4g}: {}", who, measure, method.name, limit * measured,
                       remedy_for(limit, steps.rate, risk));
}

void fail_diverged(const Bodies& bodies, const Divergence& at, const Method& method,
                   const Steps& steps, const NameOfRow& name) {
    const std::string where = describe(at, method, steps.rate, bodies.link_count() > 0, name);
    fail(Exit::diverged, "{}; {}", where, likely_cause(bodies, at, method, steps, name));
}

}  // namespace oiler
