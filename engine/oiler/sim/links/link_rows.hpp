// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/links/lanes.hpp"
#include "oiler/sim/links/link_dampers.hpp"
#include "oiler/sim/links/link_pushes.hpp"

namespace oiler {

// The operations on all rows in steps of linked rows, each written once over a Number that may be a
// batch of rows or of links.

/// The accelerations of each row of a range, without its links.
template <class V, class T, int Axes>
void accelerate_rows(const Columns<T, Axes>& columns, const RowViews<T, Axes>& views,
                     const MotionColumns<T, Axes>& motion, Evaluate what, double t,
                     const RowRange& rows, VecColumns<T, Axes>& out) {
    Kinds kinds = 0;
    for (std::size_t row = rows.begin; row < rows.end; row += lanes_of<V>) {
        if (row % row_padding == 0) kinds = kinds_of_block(columns, row);
        const auto forces = physics_of<V>(views, row, kinds, Damping::in_kick).forces();
        if (what == Evaluate::field)
            store(forces.field(load<V>(motion.x, row), t), out, row);
        else
            store(forces.accelerate(load<V>(motion, row), t), out, row);
    }
}

template <class V, class T, int Axes>
void drift_rows(const RowViews<T, Axes>& views, std::size_t flow, const RowRange& rows,
                MotionColumns<T, Axes>& motion) {
    for (std::size_t row = rows.begin; row < rows.end; row += lanes_of<V>) {
        State<V, Axes> state = load<V>(motion, row);
        drift(state, views.flows()[flow], row);
        store(state, motion, row);
    }
}

template <class V, class T, std::size_t Axes>
void add_scaled_rows(std::array<Column<T>, Axes>& to, const std::array<Column<T>, Axes>& what, T s,
                     const RowRange& rows) {
    for (std::size_t axis = 0; axis < Axes; ++axis)
        for (std::size_t row = rows.begin; row < rows.end; row += lanes_of<V>)
            store(V(load<V>(to[axis], row) + load<V>(what[axis], row) * V(s)), to[axis], row);
}

/// Whether a number of any row may no longer be finite.
template <class V, class T, int Axes>
bool motion_may_be_infinite(const MotionColumns<T, Axes>& motion, const RowRange& rows) {
    V total(T(0));
    for (std::size_t row = rows.begin; row < rows.end; row += lanes_of<V>)
        for (std::size_t axis = 0; axis < Axes; ++axis)
            total = total + (load<V>(motion.x[axis], row) + load<V>(motion.v[axis], row));
    return !is_finite(total);
}

/// The operations on all rows in steps of linked rows, as functions of this file.
template <std::floating_point T, int Axes>
struct LinkedKernels {
    void (*accelerate)(const Columns<T, Axes>&, const RowViews<T, Axes>&,
                       const MotionColumns<T, Axes>&, Evaluate, double t, const RowRange&,
                       VecColumns<T, Axes>& out);
    void (*push_links)(const PreparedLinks<T>&, const MotionColumns<T, Axes>&, Evaluate,
                       const RowRange&, VecColumns<T, Axes>& to);
    /// Half-steps of the dampers at fixed positions, one link after the other; `reverse` begins
    /// with the last.
    void (*damp_links)(const PreparedLinks<T>&, MotionColumns<T, Axes>&, bool reverse);
    /// A drift with linear damping, see RowPhysics::drift.
    void (*drift)(const RowViews<T, Axes>&, std::size_t flow, const RowRange&,
                  MotionColumns<T, Axes>&);
    void (*add_scaled)(VecColumns<T, Axes>& to, const VecColumns<T, Axes>& what, T s,
                       const RowRange&);
    bool (*may_be_infinite)(const MotionColumns<T, Axes>&, const RowRange&);
};

template <class V, class T, int Axes>
constexpr LinkedKernels<T, Axes> linked_kernels() {
    return {accelerate_rows<V, T, Axes>,
            push_links<V, T, Axes>,
            damp_links<V, T, Axes>,
            drift_rows<V, T, Axes>,
            add_scaled_rows<V, T, std::size_t{Axes}>,
            motion_may_be_infinite<V, T, Axes>};
}

}  // namespace oiler
