// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "oiler/lab/sweep/tradeoff.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler::lab {

/// The methods shown in diagrams, at most six: the scene's own, the obvious methods, and those
/// with the most rows on the Pareto front.
[[nodiscard]] std::vector<const Method*> notable_methods(const Tradeoff& tradeoff);

/// The cost axis of a diagram.
struct CostAxis {
    Cost of;
    double unit = 1;  ///< the axis's unit, in units of the cost
    std::string label{};
    std::string unit_name{};
};

/// Draws error over cost, both logarithmic: a curve for each notable method in double, above a band
/// that is the Pareto front of all methods in both precisions; the current setting; and the
/// cheapest settings for up to four tolerances.
[[nodiscard]] Picture work_precision(const Tradeoff& tradeoff, const CostAxis& axis);

/// Draws the largest energy drift so far over time, relative to Reference::energy_scale, for at
/// least one run, all at one rate.
[[nodiscard]] Picture energy_over_time(const Scene& scene, const Tradeoff& tradeoff,
                                       const Reference& reference,
                                       const std::vector<Stepping>& choices);

}  // namespace oiler::lab
