// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "oiler/physics/stepping.hpp"
#include "oiler/stability/oscillations.hpp"

namespace oiler {

/// The spring or damper that is closest to the limit of a method.
struct Stiffest {
    std::size_t row = 0;
    std::optional<std::size_t> linked{};  ///< the other row of a link
    bool is_damper = false;               ///< without a spring
    double measure = 0;                   ///< ω·dt; for a damper, c·dt
    double limit = 0;                     ///< the largest stable measure; infinite: any is stable
};

/// Finds the stiffest spring or damper, repeatedly in a run. Linked bodies count with their fastest
/// oscillation at the present positions; it is at most 1 % slower than returned. A limit takes some
/// tens of milliseconds to find. It is kept for all damping ratios that agree in three digits.
class StiffestFinder {
public:
    /// The springs and dampers that find() compares, in the present state.
    struct Suspects {
        std::vector<BodyOscillation> alone{};
        std::vector<Component> linked{};
    };
    [[nodiscard]] static Suspects suspects_of(const Bodies& bodies, const Stepping& stepping);
    /// Empty if nothing oscillates or is damped.
    [[nodiscard]] std::optional<Stiffest> find(const Suspects& suspects, const Stepping& stepping);

private:
    [[nodiscard]] Stiffest judge(const BodyOscillation& one, const Stepping& stepping);
    [[nodiscard]] double limit(const Method& method, Damping damping, double omega, double c);

    std::map<std::tuple<const Method*, Damping, double, double>, double> limits_;
};

}  // namespace oiler
