// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "oiler/lab/sweep/tradeoff.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler::lab {

/// The methods worth looking at, eight at most: the scene's own, those that people would think of,
/// and those that most often are the best.
[[nodiscard]] std::vector<const Method*> notable_methods(const Tradeoff& tradeoff);

/// What a diagram has its errors over.
struct CostAxis {
    Cost of;
    double unit = 1;  ///< of the cost, that the axis is in
    std::string label{};
    std::string unit_name{};
};

/// Error over cost, both logarithmic: a curve for each notable method in double, what is best at
/// each cost among all methods in both precisions, and what is cheapest for each power of ten.
[[nodiscard]] Picture work_precision(const Tradeoff& tradeoff, const CostAxis& axis);

/// How far the energy of runs, one at least and all at one rate, is off over time, of the
/// reference's scale.
[[nodiscard]] Picture energy_over_time(const Scene& scene, const Tradeoff& tradeoff,
                                       const Reference& reference,
                                       const std::vector<Stepping>& choices);

}  // namespace oiler::lab
