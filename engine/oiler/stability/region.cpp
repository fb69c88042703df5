// SPDX-License-Identifier: MIT
#include "oiler/stability/region.hpp"

#include <algorithm>
#include <cmath>

namespace oiler {
namespace {

/// Of ω·dt, and of ω·dt/ζ of overdamped springs: outside the region of every conditionally stable
/// method.
constexpr double outside_all = 1000;

}  // namespace

bool splits_dampers(const Method& method, Damping damping) {
    return std::holds_alternative<Splitting>(method.rule) && damping == Damping::in_drift;
}

bool is_implicit(const Method& method) {
    return std::holds_alternative<ImplicitStage>(method.rule) ||
           std::holds_alternative<ExactFlow>(method.rule);
}

double size(const ScaledOscillation& of) { return std::max(of.omega_dt, of.damping_dt); }

Oscillation unit_oscillation(const ScaledOscillation& of) {
    const double omega = of.omega_dt / size(of);
    return {omega * omega, of.damping_dt / size(of)};
}

bool Region::contains(const ScaledOscillation& of) {
    if (!(size(of) > 0)) return true;
    if (!std::isfinite(size(of))) return false;
    const double ratio =
        of.omega_dt > 0 ? std::clamp(of.damping_dt / of.omega_dt, 1.0, 1e9) : 1;  // 2ζ, at least 1
    const double reached = std::min(size(of), outside_all * ratio * ratio);
    const auto [k, c] = unit_oscillation(of);
    const Oscillation at{k * reached * reached, c * reached};
    const auto [known, is_new] = known_.try_emplace(std::pair(at.k, at.c), false);
    if (is_new) known->second = measure(at);
    return known->second;
}

bool Region::contains_all_up_to(const ScaledOscillation& of) {
    if (!(size(of) <= 1.5)) return false;
    for (const double omega : {0.0, 0.25, 0.5, 0.75, 1.0})
        for (const double c : {0.0, 0.25, 0.5, 0.75, 1.0})
            if (!contains({of.omega_dt * omega, of.damping_dt * c})) return false;
    return true;
}

bool Region::measure(const Oscillation& of) const {
    std::vector<Oscillation> tried;
    for (const double part : tested_steps) tried.push_back({of.k * part * part, of.c * part});
    const auto matrices = step_matrices(method_, damping_, tried);
    return std::all_of(matrices.begin(), matrices.end(), is_stable);
}

}  // namespace oiler
