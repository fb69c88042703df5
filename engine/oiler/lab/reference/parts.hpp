// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "oiler/lab/reference/reference.hpp"

namespace oiler::lab {

// What a reference is put together from.

/// A run in steps so fine that their own error is known; energies' doubts are in J. Empty where
/// none was finite, or too few were affordable.
struct FineSteps {
    Track track{};
    std::vector<Doubt> doubts{};
    std::string words{};
    Track finest_run{};  ///< which the track was extrapolated from
    const Method* method = nullptr;
    std::int64_t rate = 0;
    bool affordable = false;  ///< whether even the coarsest was
};

/// Halves the step until what the method's order extrapolates no longer changes by more than is
/// wanted; or as long as it is worth its work, which is while it gets better or good for longer.
[[nodiscard]] FineSteps fine_steps(const Scene& scene, const Looks& looks,
                                   const ReferenceEffort& effort);

/// A reference is good as long as it tells errors of this part of what bodies move.
inline constexpr double resolution = 1e-3;
/// From a reference's own error to what it can tell.
inline constexpr double margin = 100;

[[nodiscard]] inline double distance(const Vec<long double, 3>& a, const Vec<long double, 3>& b) {
    return static_cast<double>(std::sqrt(squared_length(a - b)));
}
/// How far any body gets from its start, m.
[[nodiscard]] double extent_of(const Track& track);

/// Of the coordinate that moves most, of that row or of all; none where it does not swing, or too
/// fast for the looks.
[[nodiscard]] std::optional<Swing> find_swing(const Track& track, const Looks& looks,
                                              std::optional<std::size_t> only = std::nullopt);

/// Of how far a coordinate gets, what is at rest.
inline constexpr double dead_band = 1e-6;

}  // namespace oiler::lab
