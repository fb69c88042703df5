// SPDX-License-Identifier: MIT
#include "oiler/stability/preflight.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "oiler/core/error.hpp"
#include "oiler/stability/oscillations.hpp"

namespace oiler {
namespace {

/// Whether the method applies damping along a spring or between bodies in half-steps around the
/// step, which are always stable.
bool splits_dampers(const Method& method, Damping damping) {
    return std::holds_alternative<Splitting>(method.rule) && damping == Damping::in_drift;
}

/// The method's region of stability, measured at dt = 1 s and at shorter steps.
class Region {
public:
    Region(const Method& method, Damping damping) : method_(method), damping_(damping) {}

    bool contains(const Oscillation& of) {
        const auto [known, is_new] = known_.try_emplace(std::pair(of.k, of.c), false);
        if (is_new) known->second = measure(of);
        return known->second;
    }

private:
    [[nodiscard]] bool measure(const Oscillation& of) const {
        std::vector<Oscillation> tried;
        for (const double part : {1.0, 0.8, 0.6, 0.4, 0.2})
            tried.push_back({of.k * part * part, of.c * part});
        const auto matrices = step_matrices(method_, damping_, tried);
        return std::all_of(matrices.begin(), matrices.end(), is_stable);
    }

    const Method& method_;
    Damping damping_;
    std::map<std::pair<double, double>, bool> known_;
};

/// The remedy in words: the lowest rate above the limit, with a margin of 10⁻⁹ for rounding.
std::string remedy_for(double limit, const Rate& rate) {
    constexpr double most = 1e6;  // the highest rate of the programs, Hz
    const double at_limit =
        static_cast<double>(rate.steps) / (limit * static_cast<double>(rate.seconds));
    const double above = std::floor(at_limit * (1 + 1e-9)) + 1;
    if (above > most) return "take implicit_euler";
    return fmt::format("rate ≥ {:.0f} Hz, or implicit_euler", above);
}

/// Outside the region of every conditionally stable method.
constexpr double farthest = 1000;

double size(const Risk& risk) { return std::max(risk.omega_dt, risk.damping_dt); }

/// The oscillation with the damping ratio of `risk` whose size at dt = 1 s is `wanted`.
Oscillation shape(const Risk& risk, double wanted) {
    const double omega = risk.omega_dt / size(risk) * wanted;
    return {omega * omega, risk.damping_dt / size(risk) * wanted};
}

std::string likely_cause(const Bodies& bodies, const Divergence& at, const Method& method,
                         const Steps& steps, const NameOfRow& name) {
    const std::vector<Risk> risks = preflight(bodies, method, steps);
    if (risks.empty()) return "take a higher rate, or another method";
    const auto own = std::find_if(risks.begin(), risks.end(), [&](const Risk& risk) {
        return risk.row == at.row || risk.linked == at.row;
    });
    return describe(own == risks.end() ? risks.front() : *own, method, steps, name);
}

}  // namespace

std::vector<Risk> preflight(const Bodies& bodies, const Method& method, const Steps& steps) {
    const double dt = steps.rate.dt();
    const Damping damping = steps.damping.value_or(method.damping);
    Region region(method, damping);
    std::vector<Risk> risks;
    for (const BodyOscillation& oscillation :
         oscillations(bodies, splits_dampers(method, damping))) {
        // Negative stiffness or damping diverges by itself with any method.
        const auto [k, c] = oscillation.of;
        if (k < 0 || c < 0) continue;
        const Risk risk{oscillation.row, oscillation.linked, std::sqrt(k) * dt, c * dt};
        if (size(risk) > 0 && !region.contains(shape(risk, std::min(size(risk), farthest))))
            risks.push_back(risk);
    }
    std::stable_sort(risks.begin(), risks.end(),
                     [](const Risk& a, const Risk& b) { return size(a) > size(b); });
    return risks;
}

std::string describe(const Risk& risk, const Method& method, const Steps& steps,
                     const NameOfRow& name) {
    const bool oscillates = risk.omega_dt > 0;
    const std::string who =
        risk.linked
            ? fmt::format("link of bodies {} and {}", name(risk.row), name(*risk.linked))
            : fmt::format("{} of body {}", oscillates ? "spring" : "linear drag", name(risk.row));
    const double measured = oscillates ? risk.omega_dt : risk.damping_dt;
    const std::string measure =
        fmt::format("{} {} {:.4g}", oscillates ? "ω·dt" : "c·dt", risk.linked ? "up to" : "=",
                    measured) +
        (oscillates && risk.damping_dt > 0
             ? fmt::format(" (ζ = {:.3g})", risk.damping_dt / (2 * risk.omega_dt))
             : std::string());
    const double edge =
        stability_limit(method, steps.damping.value_or(method.damping), shape(risk, 1));
    const double limit = edge / size(risk);
    if (limit == 0)
        return fmt::format(
            "{}: {}, {} gains energy at any rate: take another method, for example "
            "velocity_verlet",
            who, measure, method.name);
    return fmt::format("{}: {}, {} needs < {:.4g}: {}", who, measure, method.name, limit * measured,
                       remedy_for(limit, steps.rate));
}

void fail_diverged(const Bodies& bodies, const Divergence& at, const Method& method,
                   const Steps& steps, const NameOfRow& name) {
    const std::string where = describe(at, method, steps.rate, bodies.link_count() > 0, name);
    if (at.of == Divergence::Of::solution)
        fail(Exit::diverged, "{}; take a higher rate, or another method", where);
    fail(Exit::diverged, "{}; {}", where, likely_cause(bodies, at, method, steps, name));
}

}  // namespace oiler
