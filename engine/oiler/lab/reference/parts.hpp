// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "oiler/lab/reference/reference.hpp"
#include "oiler/lab/reference/sampled_motion.hpp"

namespace oiler::lab {

// The parts of a reference.

/// A run in steps so fine that their own error is known. Uncertainties of energies are in J. Empty
/// if no run was finite or too few were affordable.
struct FineSteps {
    Trajectory trajectory{};
    std::vector<Uncertainty> uncertainties{};
    std::string words{};
    Trajectory finest_run{};  ///< from which the trajectory was extrapolated
    Stepping stepping{};      ///< of the finest run
    bool sufficient = false;  ///< whether the error at the end is no more than the wanted one
    bool affordable = false;  ///< whether the coarsest run was within the work limit
    /// They do with order 1, so that the error falls slowly.
    bool linked_bodies_land = false;
};

/// Halves the step until the Romberg extrapolation changes by no more than the wanted error. Stops
/// earlier if the work limit is reached or if two halvings in a row bring no improvement. Steps in
/// double are tried before long double if a wanted error is given.
[[nodiscard]] FineSteps fine_steps(const Scene& scene, const Perturbation& start,
                                   const SampleTimes& samples, const ReferenceEffort& effort);

/// The largest number of samples for which fine steps can afford the fewest runs.
[[nodiscard]] double most_samples(const Scene& scene, const ReferenceEffort& effort);

/// A reference is usable while it resolves errors of this fraction of its extent.
inline constexpr double resolution = 1e-3;
/// The smallest error that a reference resolves, as a multiple of its own error.
inline constexpr double margin = 100;

[[nodiscard]] inline double distance(const Vec<long double, 3>& a, const Vec<long double, 3>& b) {
    return static_cast<double>(std::sqrt(squared_length(a - b)));
}
/// The oscillation with the largest range over the meaningful time, of row `only` or of all rows.
/// The three widest coordinates are tried, down to a tenth of the widest range. Returns none if
/// none oscillates with at least 8 samples per period.
[[nodiscard]] std::optional<PeriodicCoordinate> find_oscillation(
    const Reference& reference, std::optional<std::size_t> only = std::nullopt);

/// Dead band: the fraction of a coordinate's range that counts as rest.
inline constexpr double dead_band = 1e-6;

}  // namespace oiler::lab
