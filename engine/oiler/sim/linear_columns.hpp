// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/columns.hpp"
#include "oiler/sim/number_view.hpp"

namespace oiler {

/// The numbers of the linear forces on all rows along one axis.
template <std::floating_point T>
struct LinearAxis {
    NumberView<T> constant{};   ///< m/s²
    NumberView<T> centre{};     ///< m
    NumberView<T> stiffness{};  ///< 1/s²
    NumberView<T> damping{};    ///< 1/s
    NumberView<T> applied{};    ///< m/s², added to the constant
    Kinds spring_kinds = 0;     ///< the kinds that have a stiffness
    Kinds damping_kinds = 0;

    /// The parts that act on rows with these kinds of force.
    [[nodiscard]] [[gnu::always_inline]] LinearParts parts(Kinds kinds) const {
        return {constant || applied, stiffness && (kinds & spring_kinds) != 0,
                damping && (kinds & damping_kinds) != 0};
    }
    /// The force on row `row`, or on a batch of rows from `row` on.
    template <Number V, class Parts>
    [[nodiscard]] [[gnu::always_inline]] LinearForce<V, 1> load_at(std::size_t row,
                                                                   const Parts& parts) const {
        return {{parts.constant ? constant_at<V>(row) : V(T(0))},
                {parts.spring ? centre.template at<V>(row) : V(T(0))},
                parts.spring ? stiffness.template at<V>(row) : V(T(0)),
                parts.damping ? damping.template at<V>(row) : V(T(0))};
    }
    /// The constant of that row, or of a batch, m/s²; 0 if there is none.
    template <Number V>
    [[nodiscard]] [[gnu::always_inline]] V constant_at(std::size_t row) const {
        if (!applied) return constant ? constant.template at<V>(row) : V(T(0));
        const V pushed = applied.template at<V>(row);
        return constant ? V(constant.template at<V>(row) + pushed) : pushed;
    }
};

/// The numbers of the linear forces on all rows, valid until the columns change.
template <std::floating_point T, int Axes>
struct LinearColumns {
    std::array<LinearAxis<T>, Axes> axis;

    /// The parts that act along any axis.
    [[nodiscard]] [[gnu::always_inline]] LinearParts parts(Kinds kinds) const {
        LinearParts any;
        for (const LinearAxis<T>& one : axis) {
            const LinearParts parts = one.parts(kinds);
            any = {any.constant || parts.constant, any.spring || parts.spring,
                   any.damping || parts.damping};
        }
        return any;
    }
    /// The force on row `row`, or on a batch of rows from `row` on.
    template <Number V>
    [[nodiscard]] [[gnu::always_inline]] LinearForce<V, Axes> load_at(
        std::size_t row, const LinearParts& parts) const {
        const auto along = [&](auto load) __attribute__((always_inline)) {
            return Vec<V, Axes>{generate<Axes>(load)};
        };
        return {along([&](auto i) { return axis[i].template constant_at<V>(row); }),
                along([&](auto i) {
                    return parts.spring ? axis[i].centre.template at<V>(row) : V(T(0));
                }),
                parts.spring ? axis[0].stiffness.template at<V>(row) : V(T(0)),
                parts.damping ? axis[0].damping.template at<V>(row) : V(T(0))};
    }
};

/// Computes the sums of linear forces if two forces share a number, such as two springs.
template <std::floating_point T, int Axes>
[[nodiscard]] LinearColumns<T, Axes> linear_columns(Columns<T, Axes>& columns);

}  // namespace oiler
