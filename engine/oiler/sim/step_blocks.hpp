// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "oiler/sim/take_steps.hpp"

namespace oiler {

// Steps of rows without links: each row, or batch of rows, is loaded, stepped `steps.count` times
// and stored. Rows under linear forces alone are stepped axis by axis, because their axes are
// independent of each other.

/// The rows along one axis.
template <std::floating_point T>
struct AxisRows {
    T* x;
    T* v;
    LinearAxis<T> forces;
    const FlowView<T>* flows;
    std::int64_t* evaluations;  ///< of the first row; null if another axis counts them
};

template <Number V, class Parts>
[[nodiscard]] [[gnu::always_inline]] inline auto physics_of(const AxisRows<Scalar<V>>& rows,
                                                            std::size_t row, const Parts& parts,
                                                            Damping damping) {
    return RowPhysics<V, 1, AxisForces<V, Parts>>(
        [&]() __attribute__((always_inline)) {
            return AxisForces<V, Parts>{rows.forces.template load_at<V>(row, parts), parts, {}};
        },
        rows.flows, row, damping);
}

template <Number V, std::floating_point T, int Axes>
[[nodiscard]] [[gnu::always_inline]] inline auto physics_of(const RowViews<T, Axes>& views,
                                                            std::size_t row, Kinds kinds,
                                                            Damping damping) {
    const LinearParts parts = views.linear().parts(kinds);
    return RowPhysics<V, Axes, RowForces<V, Axes>>(
        [&]() __attribute__((always_inline)) {
            return RowForces<V, Axes>{views.linear().template load_at<V>(row, parts), parts,
                                      OtherForces<V, Axes>(views, row, kinds)};
        },
        views.flows(), row, damping);
}

template <class V, int Axes>
[[gnu::always_inline]] inline bool may_be_infinite(const State<V, Axes>& state) {
    V total = state.x.axis[0] + state.v.axis[0];
    for_each_index<Axes - 1>([&](auto i) __attribute__((always_inline)) {
        total = total + (state.x.axis[i + 1] + state.v.axis[i + 1]);
    });
    return !is_finite(total);
}

/// Rows whose numbers along one axis stay in the cache while the other axes are stepped, few enough
/// that memory is read in as many streams as there are columns.
inline constexpr std::size_t rows_per_axis = 8 * row_padding;

/// Where steps along several axes are: at `row`, along `axis`, in the stretch of rows from `begin`.
struct AxisPlace {
    std::size_t begin;
    std::size_t axis;
    std::size_t row;
};

/// Steps the rows from `begin` to `end` along one axis, in batches of V. Returns `end`, or the
/// first row of a batch that it did not store because a number in it may no longer be finite.
template <class V, class Parts, bool OneStep, class T, class Rule>
[[gnu::always_inline]] inline std::size_t step_axis_batches(const AxisRows<T>& given,
                                                            const Rule& rule, const Steps& steps,
                                                            std::size_t begin, std::size_t end) {
    const AxisRows<T> rows = given;  // no store changes a local value
    for (std::size_t row = begin; row < end; row += V::lanes) {
        auto physics = physics_of<V>(rows, row, Parts{}, damping_of(rule));
        State<V, 1> state{{V::load(rows.x + row)}, {V::load(rows.v + row)}};
        if constexpr (OneStep)
            take_one_step(rule, state, physics, steps);
        else
            take_steps(rule, state, physics, steps);
        if (may_be_infinite(state)) return row;
        state.x.axis[0].store(rows.x + row);
        state.v.axis[0].store(rows.v + row);
        if (row == 0 && rows.evaluations) *rows.evaluations += physics.evaluations();
    }
    return end;
}

/// The same along all axes, for rows with forces of these kinds.
template <class V, class T, int Axes, class Rule>
[[gnu::always_inline]] inline std::size_t step_batches(Columns<T, Axes>& columns,
                                                       const RowViews<T, Axes>& views, Kinds kinds,
                                                       const Rule& rule, const Steps& steps,
                                                       std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; row += V::lanes) {
        auto physics = physics_of<V>(views, row, kinds, damping_of(rule));
        State<V, Axes> state = load<V>(columns.motion, row);
        take_steps(rule, state, physics, steps);
        if (may_be_infinite(state)) return row;
        store(state, columns.motion, row);
        if (row == 0) columns.evaluations += physics.evaluations();
    }
    return end;
}

}  // namespace oiler
