// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <tuple>

#include "oiler/sim/bodies.hpp"
#include "oiler/sim/steps.hpp"

namespace oiler {

/// The spring or damper that is closest to the limit of a method.
struct Stiffest {
    std::size_t row = 0;
    std::optional<std::size_t> linked{};  ///< the other row of a link
    double measure = 0;                   ///< max(ω, c)·dt, c = 2ζω
    double limit = 0;                     ///< the largest stable measure; infinite: any is stable
};

/// Finds the stiffest spring or damper again and again while a run goes on. What links connect gets
/// an upper bound, see oscillations(). Limits take some tens of milliseconds, so they are kept,
/// each for the damping ratios that agree in two digits.
class StiffestFinder {
public:
    /// Empty if nothing oscillates or is damped.
    [[nodiscard]] std::optional<Stiffest> find(const Bodies& bodies, const Method& method,
                                               const Steps& steps);

private:
    [[nodiscard]] double limit(const Method& method, Damping damping, double omega, double c);

    std::map<std::tuple<const Method*, Damping, int, int>, double> limits_;
};

}  // namespace oiler
