// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/lab/reference/reference.hpp"
#include "oiler/lab/reference/sampled_motion.hpp"

namespace oiler::lab {

/// A reference is usable while it resolves errors of this fraction of its extent.
inline constexpr double resolution = 1e-3;

/// More impacts of a body are not followed.
inline constexpr std::size_t most_impacts = 20'000;

/// A run in steps so fine that their own error is known. Uncertainties of energies are in J. Empty
/// if no run was finite or too few were affordable.
struct FineSteps {
    Trajectory trajectory{};
    std::vector<Uncertainty> uncertainties{};
    std::string words{};
    Trajectory finest_run{};      ///< from which the trajectory was extrapolated
    Stepping stepping{};          ///< of the finest run
    double sufficient_error = 0;  ///< m, that is wanted at the end
    bool sufficient = false;      ///< whether the error at the end is no more
    bool affordable = false;      ///< whether the coarsest run was within the work limit
    bool is_long = false;         ///< whether finer runs have too many steps
    /// Linked bodies land, or ropes become taut: the error falls slowly, with order 1 by any
    /// method.
    bool first_order = false;
    bool has_too_many_impacts = false;
};

/// Halves the step until the Romberg extrapolation changes by no more than the wanted error. Stops
/// earlier if the work limit is reached or if two halvings in a row bring no improvement. Steps in
/// double are tried before long double if a wanted error is given.
[[nodiscard]] FineSteps fine_steps(const Scene& scene, const Perturbation& start,
                                   const SampleTimes& samples, const ReferenceEffort& effort);

/// The largest number of samples for which fine steps can afford the fewest runs.
[[nodiscard]] double most_samples(const Scene& scene, const ReferenceEffort& effort);

}  // namespace oiler::lab
