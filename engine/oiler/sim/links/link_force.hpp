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
/// force −k·d − b·ḋ, d = x₁ − x₂. That of a rope is 0 while it is slack.
template <Number V, int Axes>
struct LinkForce {
    CoilSpringForce<V, Axes> coil;
    bool without_length;
    bool pulls_only;

    [[gnu::always_inline]] LinkForce(V stiffness, V damping, V rest_length, bool has_no_length,
                                     bool is_rope)
        : coil{Vec<V, Axes>{generate<Axes>([](auto) { return V(0); })}, stiffness, damping,
               rest_length},
          without_length(has_no_length),
          pulls_only(is_rope) {}
    /// Of a Link, or of a link as columns store it.
    template <class AnyLink>
    [[gnu::always_inline]] explicit LinkForce(const AnyLink& link)
        : LinkForce(
              V(static_cast<Scalar<V>>(link.stiffness)), V(static_cast<Scalar<V>>(link.damping)),
              V(static_cast<Scalar<V>>(link.rest_length)), link.rest_length == 0, link.pulls_only) {
    }

    /// `between` is the state of the first body relative to the second.
    [[nodiscard]] [[gnu::always_inline]] Vec<V, Axes> field(const Vec<V, Axes>& between) const {
        return without_length ? between * -coil.stiffness
                              : if_taut(between, coil.field(between, 0));
    }
    [[nodiscard]] [[gnu::always_inline]] Vec<V, Axes> accelerate(
        const State<V, Axes>& between) const {
        return without_length ? between.x * -coil.stiffness - between.v * coil.damping
                              : if_taut(between.x, coil.accelerate(between, 0));
    }
    [[nodiscard]] Jacobian<V, Axes> jacobian(const State<V, Axes>& between) const {
        using M = Matrix<V, Axes>;
        if (is_slack(between.x)) return {M::scalar(V(0)), M::scalar(V(0))};
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
        return if_taut(between.x, before - between.v);
    }
    [[nodiscard]] V potential(const State<V, Axes>& between) const {
        return is_slack(between.x) ? V(0) : coil.potential(between);
    }
    [[nodiscard]] bool is_slack(const Vec<V, Axes>& between) const {
        return pulls_only && !(Direction<V, Axes>(between).length > coil.rest_length);
    }

private:
    /// `what`; 0 in lanes of slack ropes.
    [[nodiscard]] [[gnu::always_inline]] Vec<V, Axes> if_taut(const Vec<V, Axes>& between,
                                                              const Vec<V, Axes>& what) const {
        if (!pulls_only) return what;
        const V length = Direction<V, Axes>(between).length;
        return {generate<Axes>([&](auto axis) __attribute__((always_inline)) {
            return V(value_above(what.axis[axis], length, coil.rest_length));
        })};
    }
};

}  // namespace oiler
