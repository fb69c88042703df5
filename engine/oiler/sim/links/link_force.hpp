// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/store/columns.hpp"

namespace oiler {

/// The part of an acceleration to evaluate: the part that depends on position alone, or all.
enum class Evaluate { field, all };

/// The rows that one thread writes; it begins a block.
struct RowRange {
    std::size_t begin;
    std::size_t end;

    [[nodiscard]] [[gnu::always_inline]] bool holds(std::size_t row) const {
        return row >= begin && row < end;
    }
};

/// The force (N) of a link on its first body; its second has the opposite one. A link with a rest
/// length is a CoilSpringForce to the other body. A link without one is damped in all directions:
/// force −k·d − b·ḋ, d = x₁ − x₂.
template <Number V, int Axes>
struct LinkForce {
    CoilSpringForce<V, Axes> coil;
    bool without_length;

    [[gnu::always_inline]] LinkForce(V stiffness, V damping, V rest_length, bool has_no_length)
        : coil{Vec<V, Axes>{generate<Axes>([](auto) { return V(0); })}, stiffness, damping,
               rest_length},
          without_length(has_no_length) {}
    [[gnu::always_inline]] explicit LinkForce(const LinkRow<Scalar<V>>& link)
        : LinkForce(V(link.stiffness), V(link.damping), V(link.rest_length),
                    link.rest_length == 0) {}

    /// `between` is the state of the first body relative to the second.
    [[nodiscard]] [[gnu::always_inline]] Vec<V, Axes> field(const Vec<V, Axes>& between) const {
        return without_length ? between * -coil.stiffness : coil.field(between, 0);
    }
    [[nodiscard]] [[gnu::always_inline]] Vec<V, Axes> accelerate(
        const State<V, Axes>& between) const {
        return without_length ? between.x * -coil.stiffness - between.v * coil.damping
                              : coil.accelerate(between, 0);
    }
    [[nodiscard]] Jacobian<V, Axes> jacobian(const State<V, Axes>& between) const {
        using M = Matrix<V, Axes>;
        return without_length
                   ? Jacobian<V, Axes>{M::scalar(-coil.stiffness), M::scalar(-coil.damping)}
                   : coil.jacobian(between);
    }
    /// The relative velocity that the damper removes; `loss` is its fraction along the damper.
    [[nodiscard]] [[gnu::always_inline]] Vec<V, Axes> velocity_loss(State<V, Axes> between,
                                                                    V loss) const {
        if (without_length) return between.v * loss;
        const Vec<V, Axes> before = between.v;
        coil.damp(between, loss);
        return before - between.v;
    }
    [[nodiscard]] V potential(const State<V, Axes>& between) const {
        return coil.potential(between);
    }
};

}  // namespace oiler
