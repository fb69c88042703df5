// SPDX-License-Identifier: MIT
#include "oiler/stability/stiffest.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/stability/region.hpp"

namespace oiler {

namespace {

Damping damping_of(const Stepping& stepping) {
    return stepping.damping.value_or(stepping.method->damping);
}

}  // namespace

std::vector<BodyOscillation> StiffestFinder::oscillations_of(const Bodies& bodies,
                                                             const Stepping& stepping) {
    return oscillations(bodies, splits_dampers(*stepping.method, damping_of(stepping)));
}

std::optional<Stiffest> StiffestFinder::find(const std::vector<BodyOscillation>& oscillations,
                                             const Stepping& stepping) {
    std::optional<Stiffest> stiffest;
    for (const BodyOscillation& one : oscillations) {
        // Negative stiffness or damping diverges by itself with any method.
        const double omega = std::sqrt(std::max(one.of.k, 0.0));
        const double c = std::max(one.of.c, 0.0);
        const double fastest = std::max(omega, c);
        if (!(fastest > 0) || !std::isfinite(fastest)) continue;
        const double measure = fastest * stepping.rate.dt();
        const double most =
            limit(*stepping.method, damping_of(stepping), omega / fastest, c / fastest);
        if (!stiffest || measure * stiffest->limit > stiffest->measure * most)
            stiffest = Stiffest{one.row, one.linked, measure, most};
    }
    return stiffest;
}

double StiffestFinder::limit(const Method& method, Damping damping, double omega, double c) {
    constexpr int digits = 100;
    const int of_omega = static_cast<int>(std::lround(digits * omega));
    const int of_c = static_cast<int>(std::lround(digits * c));
    const auto [known, is_new] = limits_.try_emplace({&method, damping, of_omega, of_c});
    if (is_new) {
        const double rounded = static_cast<double>(of_omega) / digits;
        known->second = stability_limit(method, damping,
                                        {rounded * rounded, static_cast<double>(of_c) / digits});
    }
    return known->second;
}

}  // namespace oiler
