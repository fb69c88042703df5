// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <span>

#include "oiler/lab/reference/path.hpp"
#include "oiler/lab/sweep/judge.hpp"
#include "oiler/physics/contacts/plane.hpp"

namespace oiler::lab {

/// What a player notices of one run of a body; `unknown` where the run does not show it.
struct Observed {
    double apex = unknown;
    double apex_time = unknown;
    double landing_time = unknown;
    double landing_place = unknown;
    std::array<double, 3> bounces{unknown, unknown, unknown};  ///< see `shown_bounces`
    double rest_time = unknown;
    double period = unknown;
    double amplitude = unknown;
    double settle_time = unknown;
};

/// The bounces whose heights are observed, counted from 1.
inline constexpr std::array<std::size_t, 3> shown_bounces{1, 3, 10};

struct ObservedQuantity {
    const char* name;
    const char* unit;
    double (*value)(const Observed& observed);
};
[[nodiscard]] std::span<const ObservedQuantity> observed_quantities();

/// The floor under a body: the plane that faces gravity most.
struct Floor {
    std::array<double, 3> normal{};  ///< of length 1
    double offset = 0;               ///< m, with the body's radius
};

/// The axes, the floor and the oscillation along which a body is measured.
struct Observer {
    std::optional<int> up{};      ///< the axis of gravity
    double up_sign = 1;           ///< −1 if up is the negative direction
    std::optional<int> across{};  ///< the axis of the place of landing
    std::optional<Floor> floor{};
    std::optional<PeriodicCoordinate> oscillation{};
    double rest = 0;  ///< m, the centre of the oscillation
};
[[nodiscard]] Observer observer_of(const Scene& scene, const Reference& reference, std::size_t row);

/// The three coordinates of a body.
using Paths = std::array<Path, 3>;

[[nodiscard]] Observed observe(const Observer& observer, const Paths& paths);

}  // namespace oiler::lab
