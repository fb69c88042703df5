// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "oiler/math/vec.hpp"
#include "oiler/physics/methods/methods.hpp"
#include "oiler/physics/rate.hpp"

namespace oiler {

/// A body and an attractor that nothing else disturbs.
struct Orbit {
    Vec3 centre;  ///< m
    Vec3 r;       ///< m, from the attractor
    Vec3 v;       ///< m/s
    double gm;    ///< m³/s²

    /// Per unit mass, J/kg; negative if the body returns.
    [[nodiscard]] double energy() const;
    /// The least distance from now on: the periapsis h²/(gm·(1 + e)), unless the body leaves for
    /// ever, m.
    [[nodiscard]] double closest() const;
    [[nodiscard]] double farthest() const;  ///< m, of an orbit that returns
    [[nodiscard]] double period() const;    ///< s, of an orbit that returns
};

/// Runs 20 revolutions of an orbit that returns, at most 200,000 steps, and tells whether the body
/// stays on an orbit of that size: its energy never changes by `tolerance` of the initial energy.
/// No local frequency decides that: steps that are too long scatter the body by chance. Adds the
/// number of steps to `steps`.
[[nodiscard]] bool is_followed(const Orbit& orbit, const Method& method, Damping damping,
                               const Rate& rate, double tolerance, std::int64_t& steps);

/// The rate of steps of dt·`factor`, to seven digits or more.
[[nodiscard]] Rate scaled_rate(const Rate& rate, double factor);

}  // namespace oiler
