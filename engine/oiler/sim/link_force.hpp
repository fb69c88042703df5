// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/columns.hpp"

namespace oiler {

/// The force (N) of a link on its first body; its second has the opposite one. A link with a rest
/// length is a CoilSpringForce to the other body, one without is damped in all directions: force
/// −k·d − b·ḋ, d = x₁ − x₂.
template <std::floating_point T, int Axes>
struct LinkForce {
    CoilSpringForce<T, Axes> coil;
    bool without_length;

    explicit LinkForce(const LinkRow<T>& link)
        : coil{{}, link.stiffness, link.damping, link.rest_length},
          without_length(link.rest_length == 0) {}

    /// `between` is the state of the first as seen from the second.
    [[nodiscard]] Vec<T, Axes> field(const Vec<T, Axes>& between) const {
        return without_length ? between * -coil.stiffness : coil.field(between, 0);
    }
    [[nodiscard]] Vec<T, Axes> accelerate(const State<T, Axes>& between) const {
        return without_length ? between.x * -coil.stiffness - between.v * coil.damping
                              : coil.accelerate(between, 0);
    }
    [[nodiscard]] Jacobian<T, Axes> jacobian(const State<T, Axes>& between) const {
        using M = Matrix<T, Axes>;
        return without_length
                   ? Jacobian<T, Axes>{M::scalar(-coil.stiffness), M::scalar(-coil.damping)}
                   : coil.jacobian(between);
    }
    /// How much of the relative velocity the damper takes when it takes `loss` of what it sees.
    [[nodiscard]] Vec<T, Axes> lost(State<T, Axes> between, T loss) const {
        if (without_length) return between.v * loss;
        const Vec<T, Axes> before = between.v;
        coil.slow(between, loss);
        return before - between.v;
    }
    [[nodiscard]] T potential(const State<T, Axes>& between) const {
        return coil.potential(between);
    }
};

}  // namespace oiler
