// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/lab/reference.hpp"

namespace oiler {

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

/// The bodies of the scene at its start, in long double.
[[nodiscard]] Bodies extended_bodies(const Scene& scene);

/// Of the coordinate that moves most, of that row or of all; none where it does not swing, or too
/// fast for the looks.
[[nodiscard]] std::optional<Swing> find_swing(const Track& track, const Looks& looks,
                                              std::optional<std::size_t> only = std::nullopt);

/// A look at the coordinate that swings.
struct SwingLook {
    double x;  ///< m
    double v;  ///< m/s
};

/// When it goes up through a level, in s, between looks by a cubic; having been below it by `band`
/// at least, so that the roundings of what has come to rest are no swing.
[[nodiscard]] std::vector<double> upward_crossings(const std::vector<SwingLook>& looks,
                                                   double level, double band, double per_second);

/// Of how far a coordinate gets, what is at rest.
inline constexpr double dead_band = 1e-6;

}  // namespace oiler
