// SPDX-License-Identifier: MIT
#include "oiler/stability/stiffest.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/sim/bodies.hpp"
#include "oiler/stability/modes.hpp"

namespace oiler {

namespace {

bool splits_dampers(const Stepping& stepping) {
    return splits_dampers(*stepping.method, damping_of(stepping));
}

/// A number in three digits.
double rounded(double number) {
    if (number == 0) return 0;
    const double unit = std::pow(10, std::floor(std::log10(number)) - 2);
    return std::round(number / unit) * unit;
}

/// Whether `a` is closer to its limit than `b`; whether it is faster, if neither has a limit.
bool is_closer(const Stiffest& a, const Stiffest& b) {
    if (a.limit == b.limit) return a.measure > b.measure;
    return a.measure * b.limit > b.measure * a.limit;
}

/// The fastest oscillations of a component by its stiffness and by its damping.
std::vector<BodyOscillation> fastest(const Component& component, bool dampers_split) {
    const MatrixSum stiffness{1, 0, dampers_split}, damping{0, 1, dampers_split};
    std::vector<BodyOscillation> found;
    for (const MatrixSum& sum : {stiffness, damping}) {
        const RitzPair pair = highest_ritz_pair(component, sum);
        if (!(pair.value > 0)) continue;
        BodyOscillation one{component.rows.front(),
                            std::nullopt,
                            {quotient(component, stiffness, pair.vector),
                             quotient(component, damping, pair.vector)}};
        (sum.stiffness > 0 ? one.of.k : one.of.c) = pair.value + pair.residual;
        if (const Coupling* const most = component.most_strained(pair.vector)) {
            one.row = component.rows[most->a];
            if (most->b != Coupling::ground) one.linked = component.rows[most->b];
        }
        found.push_back(one);
    }
    return found;
}

}  // namespace

StiffestFinder::Suspects StiffestFinder::suspects_of(const Bodies& bodies,
                                                     const Stepping& stepping) {
    Suspects suspects{oscillations(bodies, splits_dampers(stepping))};
    if (bodies.link_count() == 0) return suspects;
    const std::vector<bool> linked = bodies.linked_rows();
    std::erase_if(suspects.alone, [&](const BodyOscillation& one) { return linked[one.row]; });
    suspects.linked = linked_components(bodies, component_labels(bodies));
    return suspects;
}

std::optional<Stiffest> StiffestFinder::find(const Suspects& suspects, const Stepping& stepping) {
    std::optional<Stiffest> stiffest;
    const auto consider = [&](const BodyOscillation& one) {
        const Stiffest found = judge(one, stepping);
        if (!(found.measure > 0) || !std::isfinite(found.measure)) return;
        if (!stiffest || is_closer(found, *stiffest)) stiffest = found;
    };
    for (const BodyOscillation& one : suspects.alone) consider(one);
    for (const Component& component : suspects.linked)
        for (const BodyOscillation& one : fastest(component, splits_dampers(stepping)))
            consider(one);
    return stiffest;
}

Stiffest StiffestFinder::judge(const BodyOscillation& one, const Stepping& stepping) {
    // Negative stiffness or damping diverges by itself with any method.
    const double omega = std::sqrt(std::max(one.of.k, 0.0));
    const double c = std::max(one.of.c, 0.0);
    const double fastest = std::max(omega, c);
    Stiffest found{one.row, one.linked, omega == 0, 0, 0};
    if (!(fastest > 0) || !std::isfinite(fastest)) return found;
    const double own = omega > 0 ? omega : c;
    found.measure = own * stepping.rate.dt();
    found.limit =
        own / fastest * limit(*stepping.method, damping_of(stepping), omega / fastest, c / fastest);
    return found;
}

double StiffestFinder::limit(const Method& method, Damping damping, double omega, double c) {
    const double known_omega = rounded(omega), known_c = rounded(c);
    const auto [known, is_new] = limits_.try_emplace({&method, damping, known_omega, known_c});
    if (is_new)
        known->second = stability_limit(method, damping, {known_omega * known_omega, known_c});
    return known->second;
}

}  // namespace oiler
