// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/lab/tradeoff.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// The methods worth looking at, eight at most: the scene's own, those that people would think of,
/// and those that most often are the best.
[[nodiscard]] std::vector<const Method*> notable_methods(const Tradeoff& tradeoff);

/// Error over cost, both logarithmic: a curve for each notable method in double, and what is best
/// at each cost among all methods in both precisions.
[[nodiscard]] Picture work_precision(const Tradeoff& tradeoff, Cost cost,
                                     const std::string& cost_label, double unit);

/// How far the energy of runs, all at one rate, is off over time, of the reference's scale.
[[nodiscard]] Picture energy_over_time(const Scene& scene, const Tradeoff& tradeoff,
                                       const Reference& reference,
                                       const std::vector<SceneChoice>& choices);

}  // namespace oiler
