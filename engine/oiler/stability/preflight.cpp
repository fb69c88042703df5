// SPDX-License-Identifier: MIT
#include "oiler/stability/preflight.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "oiler/core/error.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/stability/oscillations.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

std::string describe_subject(const Risk& risk, const NameOfRow& name) {
    using enum Risk::Of;
    if (risk.is_rope)
        return risk.linked ? fmt::format("taut rope of bodies {} and {}", name(risk.row),
                                         name(*risk.linked))
                           : fmt::format("taut rope of body {}", name(risk.row));
    if (risk.linked)
        return fmt::format("link of bodies {} and {}", name(risk.row), name(*risk.linked));
    if (risk.of == quadratic_drag || risk.of == terminal_speed)
        return fmt::format("quadratic drag of body {}", name(risk.row));
    if (risk.of == attractor || risk.of == periapsis)
        return fmt::format("attractor of body {}", name(risk.row));
    return fmt::format("{} of body {}", risk.omega_dt > 0 ? "spring" : "linear drag",
                       name(risk.row));
}

std::string describe_measure(const Risk& risk, int digits = 4) {
    switch (risk.of) {
        case Risk::Of::quadratic_drag:
            return fmt::format("c·|v|·dt = {:.{}g} at {:.4g} m/s", risk.damping_dt, digits,
                               risk.at);
        case Risk::Of::terminal_speed:
            return fmt::format("2·c·|v|·dt = {:.{}g} at the terminal speed of {:.4g} m/s",
                               risk.damping_dt, digits, risk.at);
        case Risk::Of::attractor:
            return fmt::format("ω·dt = {:.{}g} at {:.4g} m", risk.omega_dt, digits, risk.at);
        case Risk::Of::periapsis:
            return fmt::format("ω·dt = {:.{}g} at the closest point of the orbit, {:.4g} m",
                               risk.omega_dt, digits, risk.at);
        default:
            break;
    }
    const bool oscillates = risk.omega_dt > 0 && risk.of != Risk::Of::overdamped;
    const bool is_bound = risk.linked || !risk.oscillations.empty();
    return fmt::format("{} {} {:.{}g}", oscillates ? "ω·dt" : "c·dt", is_bound ? "up to" : "=",
                       oscillates ? risk.omega_dt : risk.damping_dt, digits) +
           (oscillates && risk.damping_dt > 0
                ? fmt::format(" (ζ = {:.3g})", risk.damping_dt / (2 * risk.omega_dt))
                : std::string());
}

/// As many digits as tell two numbers apart, from 4 on.
int digits_between(double a, double b) {
    int digits = 4;
    while (digits < 12 && fmt::format("{:.{}g}", a, digits) == fmt::format("{:.{}g}", b, digits))
        ++digits;
    return digits;
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
    if (is_rounding(risk)) return describe_rounding(risk, name);
    if (risk.of == Risk::Of::quadratic_drag)
        return fmt::format(
            "quadratic drag of body {}: c·|v|·dt is not finite: take a higher rate, or {}",
            name(risk.row), risk.remedy ? risk.remedy->name : "another method");
    return fmt::format(
        "attractor of body {}: the orbit leads into its centre, which no rate resolves: give the "
        "body another position or velocity",
        name(risk.row));
}

/// The loss of an orbit. The energy of an orbit that velocity_verlet follows does not drift.
std::string describe_loss(const Risk& risk, const Method& method, const Steps& steps,
                          const NameOfRow& name) {
    const Method& verlet = find_method("velocity_verlet");
    const double limit = limit_of(risk, method, steps);
    std::string remedy = remedy_for(limit, risk, method, steps);
    if (&method != &verlet && follows(*risk.orbit, verlet, verlet.damping, steps.rate))
        remedy = limit > 0 ? remedy + ", or velocity_verlet" : "take velocity_verlet";
    const std::string when =
        risk.revolution > 0 ? fmt::format(" in revolution {:.0f}", std::ceil(risk.revolution)) : "";
    return fmt::format("{}: {}, {} loses the orbit{}: {}", describe_subject(risk, name),
                       describe_measure(risk), method.name, when, remedy);
}

std::string describe_explosion(const Risk& risk, const Method& method, const Steps& steps,
                               const NameOfRow& name) {
    const double time = static_cast<double>(risk.tick) * steps.rate.dt();
    const std::string what =
        std::isfinite(risk.at)
            ? fmt::format("has gained {:.3g} times the energy of finer steps", risk.at)
            : "diverges";
    return fmt::format("body {}: a trial with {} {} at step {} (t = {:.3g} s): {}", name(risk.row),
                       method.name, what, risk.tick, time,
                       remedy_for(limit_of(risk, method, steps), risk, method, steps));
}

/// The drag of a run that has diverged: no rate holds its present speed.
std::string describe_grown_drag(const Risk& risk, const Method& method, const Steps& steps,
                                const NameOfRow& name) {
    const double limit = quadratic_drag_limit(method, steps.damping.value_or(method.damping));
    const std::string needs =
        std::isfinite(limit) ? fmt::format(", {} needs < {:.4g}", method.name, limit) : "";
    return fmt::format("{}: {}{}: take a higher rate, or {}", describe_subject(risk, name),
                       describe_measure(risk), needs,
                       risk.remedy ? risk.remedy->name : "another method");
}

/// The first risk of the body in that row, or of a body linked with it; null if there is none.
const Risk* risk_of(std::size_t row, const std::vector<Risk>& risks, const Bodies& bodies) {
    const std::vector<std::size_t> labels = component_labels(bodies);
    const auto own = std::ranges::find_if(
        risks, [&](const Risk& risk) { return labels[risk.row] == labels[row]; });
    return own == risks.end() ? nullptr : &*own;
}

/// The line with which preflight warned of a run that has diverged; empty if it did not.
std::string warning_at_start(const Bodies& start, std::size_t row, const Method& method,
                             const Steps& steps, const NameOfRow& name) {
    const Steps one{steps.rate, 0, 1, steps.damping};
    std::vector<Risk> risks = preflight(start, method, one);
    std::erase_if(risks, [](const Risk& risk) {
        return risk.of == Risk::Of::told || risk.of == Risk::Of::overdamped;
    });
    if (risks.empty() || row >= start.size()) return "";
    const Risk* const own = risk_of(row, risks, start);
    return describe(own ? *own : risks.front(), method, one, name);
}

std::string likely_cause(const Bodies& bodies, const Divergence& at, const Method& method,
                         const Steps& steps, const NameOfRow& name, const Bodies* start) {
    const std::string by_default = "take a higher rate, or another method";
    if (start && at.of != Divergence::Of::solution)
        if (std::string warning = warning_at_start(*start, at.row, method, steps, name);
            !warning.empty())
            return warning;
    std::vector<Risk> risks = preflight(bodies, method, steps);
    std::erase_if(risks, [](const Risk& risk) {
        return risk.of == Risk::Of::told || risk.of == Risk::Of::explosion ||
               risk.of == Risk::Of::overdamped;
    });
    const Risk* const own = risk_of(at.row, risks, bodies);
    if (own && own->of == Risk::Of::on_attractor) {
        const std::string cause = describe(*own, method, steps, name);
        const bool is_start = at.tick == 1;
        return is_start ? cause : fmt::format("{}; if it moved there, {}", cause, by_default);
    }
    if (risks.empty() || at.of == Divergence::Of::solution) return by_default;
    const Risk& cause = own ? *own : risks.front();
    // The orbit of a body that hit its attractor is no longer known.
    if (is_attraction(cause) && !std::isfinite(cause.omega_dt)) return by_default;
    if (cause.of == Risk::Of::quadratic_drag && std::isfinite(cause.damping_dt))
        return describe_grown_drag(cause, method, steps, name);
    return describe(cause, method, steps, name);
}

double length_of(const Vec3& vector) { return std::hypot(vector[0], vector[1], vector[2]); }

/// The body whose own energy is not finite. Of several, and where links alone overflow, the
/// fastest, or the farthest from the origin.
std::size_t row_of_overflow(const Bodies& bodies, bool by_speed) {
    std::size_t worst = 0;
    std::pair most(false, -1.0);
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        const double energy = alone(bodies, row, bodies.precision()).energy().total();
        const std::pair size(!std::isfinite(energy),
                             length_of(by_speed ? bodies.velocity(row) : bodies.position(row)));
        if (size <= most) continue;
        most = size;
        worst = row;
    }
    return worst;
}

/// The cause of an energy that is infinite at the start.
std::string describe_start(const Energy& energy, const Bodies& bodies, const NameOfRow& name) {
    const bool is_fast = !std::isfinite(energy.kinetic);
    const std::size_t row = row_of_overflow(bodies, is_fast);
    if (is_fast)
        return fmt::format(
            "body {} moves at {:.3g} m/s, too fast for a finite energy: give it a lower speed",
            name(row), length_of(bodies.velocity(row)));
    return fmt::format(
        "body {} is {:.3g} m from the origin, too far for a finite energy: place it nearer, or "
        "give it weaker forces",
        name(row), length_of(bodies.position(row)));
}

}  // namespace

std::vector<Risk> preflight(const Bodies& bodies, const Method& method, const Steps& steps) {
    std::vector<Risk> risks = find_risks(bodies, method, steps);
    std::shared_ptr<const Bodies> scene;
    for (Risk& risk : risks)
        if (risk.of != Risk::Of::told)
            risk.scene = scene ? scene : scene = std::make_shared<const Bodies>(bodies);
    add_remedies(bodies, method, steps, risks);
    return risks;
}

std::string describe(const Risk& risk, const Method& method, const Steps& steps,
                     const NameOfRow& name) {
    if (!risk.message.empty())
        return fmt::format(fmt::runtime(risk.message), name(risk.row),
                           risk.linked ? name(*risk.linked) : "");
    if (risk.of == Risk::Of::explosion) return describe_explosion(risk, method, steps, name);
    if (!(size(risk) > 0) || !std::isfinite(size(risk))) return describe_without_rate(risk, name);
    if (risk.orbit) return describe_loss(risk, method, steps, name);
    const std::string who = describe_subject(risk, name);
    const double limit = limit_of(risk, method, steps);
    const bool turns_back = risk.of == Risk::Of::overdamped;
    const double measured = risk.omega_dt > 0 && !turns_back ? risk.omega_dt : risk.damping_dt;
    const int digits = digits_between(measured, limit * measured);
    const std::string measure = describe_measure(risk, digits);
    if (limit == 0)
        return fmt::format(
            "{}: {}, {} gains energy at any rate: take another method, for example "
            "velocity_verlet",
            who, measure, method.name);
    return fmt::format("{}: {}, {} {} < {:.{}g}: {}", who, measure, method.name,
                       turns_back ? "turns it back and needs" : "needs", limit * measured, digits,
                       remedy_for(limit, risk, method, steps));
}

void fail_diverged(const Bodies& bodies, const Divergence& at, const Method& method,
                   const Steps& steps, const NameOfRow& name, const Bodies* start) {
    const std::string where = describe(at, method, steps.rate, bodies.link_count() > 0, name);
    fail(Exit::diverged, "{}; {}", where, likely_cause(bodies, at, method, steps, name, start));
}

void require_finite(const Energy& energy, const Bodies& bodies, const Method& method,
                    const Steps& steps, const NameOfRow& name, const Bodies* start) {
    if (std::isfinite(energy.total())) return;
    const bool is_start = steps.first == 0;
    const bool is_on_attractor = energy.total() < 0;
    if (is_start && !is_on_attractor)
        fail(Exit::diverged, "the energy is not finite at the start: {}",
             describe_start(energy, bodies, name));
    const std::size_t row = row_of_overflow(bodies, true);
    const std::string cause = likely_cause(
        bodies, {steps.first + 1, row, 0, Divergence::Of::velocity}, method, steps, name, start);
    if (is_start) fail(Exit::diverged, "the energy is not finite at the start: {}", cause);
    fail(Exit::diverged,
         "the energy is no longer finite at tick {}: body {} moves at {:.3g} m/s; {}", steps.first,
         name(row), length_of(bodies.velocity(row)), cause);
}

}  // namespace oiler
