// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "oiler/physics/forces/force.hpp"

namespace oiler {

/// A point that attracts like a planet: acceleration −gm·d/|d|³, d = x − centre, independent of the
/// body's mass, and NaN at the centre. |d|³ must neither underflow nor overflow:
/// 10⁻¹² < |d| < 10¹² m in float.
template <Number V, int Axes>
struct AttractorForce {
    Vec<V, Axes> centre{};  ///< m
    V gm{};                 ///< m³/s²

    static constexpr std::string_view name = "attractor";
    static constexpr std::string_view plural = "attractors";
    static constexpr bool everywhere = false;
    static constexpr auto fields() {
        return std::tuple(KeyedField{"position", &AttractorForce::centre},
                          KeyedField{"gm", &AttractorForce::gm});
    }
    constexpr AttractorForce per_unit_mass(V) const { return *this; }

    [[gnu::always_inline]] constexpr Vec<V, Axes> field(const Vec<V, Axes>& x, double) const {
        using std::sqrt;
        const Vec<V, Axes> d = x - centre;
        const V squared = squared_length(d);
        const V cubed = squared * sqrt(squared);
        // NaN where the cube is not finite, instead of no attraction.
        return d * ((cubed - cubed) - quotient_of_nonzero(gm, cubed));
    }
    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double t) const {
        return field(state.x, t);
    }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>& state) const {
        using M = Matrix<V, Axes>;
        const Direction<V, Axes> d(state.x - centre);
        const V pull = quotient_of_nonzero(gm, d.length * d.length * d.length);
        return {M::outer(d.unit, d.unit * (V(3) * pull)) - M::scalar(pull), {}};
    }
    constexpr V potential(const State<V, Axes>& state) const {
        return -quotient_of_nonzero(gm, Direction<V, Axes>(state.x - centre).length);
    }
    /// The angular speed of a circular orbit at the distance of closest approach. A body that falls
    /// straight in passes the attractor arbitrarily fast; its orbit is bounded at 10⁻³ of the
    /// distance.
    V fastest(const State<V, Axes>& state) const {
        constexpr V least = 1e-3;
        const Vec<V, Axes> from = state.x - centre;
        const V distance = length(from);
        if (distance == 0 || gm == 0) return 0;
        const V size = std::abs(gm);
        const V along = dot(from, state.v);
        const V area2 = distance * distance * squared_length(state.v) - along * along;
        const V energy = squared_length(state.v) / 2 - size / distance;
        const V e = std::sqrt(std::max(V(0), 1 + 2 * energy * area2 / (size * size)));
        const V nearest = std::clamp(area2 / size / (1 + e), least * distance, distance);
        return std::sqrt(size / nearest) / nearest;
    }
};

}  // namespace oiler
