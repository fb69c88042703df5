// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/kernels.hpp"
#include "oiler/sim/link_force.hpp"

namespace oiler {

// The operations on all rows in steps of linked rows, each written once over a Number that may be a
// batch of rows or of links.

template <class V>
constexpr std::size_t lanes_of = 1;
template <class Pack, std::size_t Packs>
constexpr std::size_t lanes_of<Batch<Pack, Packs>> = Batch<Pack, Packs>::lanes;

template <class V, class T>
[[gnu::always_inline]] inline V load_from(const T* from) {
    if constexpr (std::is_same_v<V, T>)
        return *from;
    else
        return V::load(from);
}
template <class V, class T>
[[gnu::always_inline]] inline void store_to(const V& value, T* to) {
    if constexpr (std::is_same_v<V, T>)
        *to = value;
    else
        value.store(to);
}

/// The accelerations of each row, without its links.
template <class V, class T, int Axes>
void accelerate_rows(const Columns<T, Axes>& columns, const RowViews<T, Axes>& views,
                     const MotionColumns<T, Axes>& motion, Evaluate what, double t,
                     VecColumns<T, Axes>& out) {
    Kinds kinds = 0;
    for (std::size_t row = 0; row < columns.size; row += lanes_of<V>) {
        if (row % row_padding == 0) kinds = kinds_of_block(columns, row);
        const auto forces = physics_of<V>(views, row, kinds, Damping::in_kick).forces();
        if (what == Evaluate::field)
            store(forces.field(load<V>(motion.x, row), t), out, row);
        else
            store(forces.accelerate(load<V>(motion, row), t), out, row);
    }
}

/// Calls f(V{}, i) for whole batches of V from 0 on, then f(T{}, i) for the remainder of `count`.
template <class V, class T, class F>
[[gnu::always_inline]] inline void for_lanes(std::size_t count, F f) {
    std::size_t i = 0;
    for (; i + lanes_of<V> <= count; i += lanes_of<V>) f(V(T(0)), i);
    for (; i < count; ++i) f(T(0), i);
}

/// Like for_lanes, for an `f` that may handle an index twice: the last batch may overlap the one
/// before it.
template <class V, class T, class F>
[[gnu::always_inline]] inline void for_overlapping_lanes(std::size_t count, F f) {
    if (count < lanes_of<V>) {
        for (std::size_t i = 0; i < count; ++i) f(T(0), i);
        return;
    }
    for (std::size_t i = 0; i + lanes_of<V> < count; i += lanes_of<V>) f(V(T(0)), i);
    f(V(T(0)), count - lanes_of<V>);
}

/// Adds the accelerations by forces on `count` rows from `row` on, or subtracts them.
template <class V, class T, std::size_t Axes>
[[gnu::always_inline]] inline void push_rows(const std::array<const T*, Axes>& force,
                                             std::size_t count, const Parameter<T>& inverse_mass,
                                             bool subtract, std::array<Column<T>, Axes>& to,
                                             std::size_t row) {
    for_lanes<V, T>(
        count, [&]<class N>(N, std::size_t i) __attribute__((always_inline)) {
            const N inverse = load_from<N>(inverse_mass.data(row + i));
            for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
                T* const at = to[axis].data() + row + i;
                const N push = load_from<N>(force[axis] + i) * inverse;
                const N was = load_from<N>(at);
                store_to<N>(subtract ? N(was - push) : N(was + push), at);
            });
        });
}

/// The most links in a run. It is fixed because the order of sums depends on it.
inline constexpr std::size_t most_links_per_run = 512;

/// Applies a run of links: first to all their first rows, then to all their second rows.
template <class V, class T, int Axes>
[[gnu::always_inline]] inline void push_run(const LinkRun<T>& run,
                                            const MotionColumns<T, Axes>& motion, Evaluate what,
                                            const Parameter<T>& inverse_mass,
                                            VecColumns<T, Axes>& to) {
    alignas(column_alignment) std::array<std::array<T, most_links_per_run>, Axes> force;
    const auto ends = [&]<class N>(N, const VecColumns<T, Axes>& columns, std::size_t i)
        __attribute__((always_inline)) {
        return Vec<N, Axes>{generate<Axes>([&](auto axis) __attribute__((always_inline)) {
            return N(load_from<N>(columns[axis].data() + run.of.a + i) -
                     load_from<N>(columns[axis].data() + run.of.b + i));
        })};
    };
    for_overlapping_lanes<V, T>(
        run.count, [&]<class N>(N, std::size_t i) __attribute__((always_inline)) {
            const LinkForce<N, Axes> link(run.of);
            const Vec<N, Axes> d = ends(N(T(0)), motion.x, i);
            const Vec<N, Axes> f = what == Evaluate::field
                                       ? link.field(d)
                                       : link.accelerate({d, ends(N(T(0)), motion.v, i)});
            for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
                store_to<N>(f.axis[axis], force[axis].data() + i);
            });
        });
    std::array<const T*, Axes> from;
    for (std::size_t axis = 0; axis < Axes; ++axis) from[axis] = force[axis].data();
    push_rows<V>(from, run.count, inverse_mass, false, to, run.of.a);
    push_rows<V>(from, run.count, inverse_mass, true, to, run.of.b);
}

/// Applies one link, without storing its force; the sum is that of push_run.
template <class T, int Axes>
[[gnu::always_inline]] inline void push_link(const LinkRow<T>& link,
                                             const MotionColumns<T, Axes>& motion, Evaluate what,
                                             const Parameter<T>& inverse_mass,
                                             VecColumns<T, Axes>& to) {
    const LinkForce<T, Axes> force(link);
    const Vec<T, Axes> d = load<T>(motion.x, link.a) - load<T>(motion.x, link.b);
    const Vec<T, Axes> f =
        what == Evaluate::field
            ? force.field(d)
            : force.accelerate({d, load<T>(motion.v, link.a) - load<T>(motion.v, link.b)});
    const T a = inverse_mass[link.a];
    const T b = inverse_mass[link.b];
    for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
        T* const at = to[axis].data();
        at[link.a] = at[link.a] + f.axis[axis] * a;
        at[link.b] = at[link.b] - f.axis[axis] * b;
    });
}

template <class V, class T, int Axes>
void push_links(const LinkCache<T, Axes>& cache, const MotionColumns<T, Axes>& motion,
                Evaluate what, VecColumns<T, Axes>& to) {
    for (const LinkRun<T>& run : cache.runs)
        if (run.count == 1)
            push_link<T, Axes>(run.of, motion, what, cache.inverse_mass, to);
        else if (run.count < lanes_of<V>)
            push_run<T, T, Axes>(run, motion, what, cache.inverse_mass, to);
        else
            push_run<V, T, Axes>(run, motion, what, cache.inverse_mass, to);
}

/// The dampers of the links from `i` on of a run, for as many links as N has lanes.
template <class N, class T, int Axes>
[[gnu::always_inline]] inline void damp_lanes(const LinkRun<T>& run, std::size_t i,
                                              const LinkCache<T, Axes>& cache,
                                              MotionColumns<T, Axes>& motion) {
    const std::size_t a = run.of.a + i;
    const std::size_t b = run.of.b + i;
    const auto load_rows =
        [](const VecColumns<T, Axes>& columns, std::size_t row) __attribute__((always_inline)) {
        return Vec<N, Axes>{
            generate<Axes>([&](auto axis) { return load_from<N>(columns[axis].data() + row); })};
    };
    const Vec<N, Axes> va = load_rows(motion.v, a);
    const Vec<N, Axes> vb = load_rows(motion.v, b);
    const State<N, Axes> between{load_rows(motion.x, a) - load_rows(motion.x, b), va - vb};
    const N loss = load_from<N>(cache.loss.data() + run.first + i);
    const N of_a = load_from<N>(cache.inverse_mass.data(a));
    const N of_b = load_from<N>(cache.inverse_mass.data(b));
    const Vec<N, Axes> force =
        -LinkForce<N, Axes>(run.of).velocity_loss(between, loss) * N(N(T(1)) / N(of_a + of_b));
    for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
        store_to<N>(N(va.axis[axis] + force.axis[axis] * of_a), motion.v[axis].data() + a);
        store_to<N>(N(vb.axis[axis] - force.axis[axis] * of_b), motion.v[axis].data() + b);
    });
}

template <class V, class T, int Axes>
[[gnu::always_inline]] inline void damp_run(const LinkRun<T>& run, const LinkCache<T, Axes>& cache,
                                            MotionColumns<T, Axes>& motion, bool reverse) {
    if (run.of.damping == 0) return;
    if (run.is_disjoint()) {
        for_lanes<V, T>(
            run.count, [&]<class N>(N, std::size_t i) __attribute__((always_inline)) {
                damp_lanes<N>(run, i, cache, motion);
            });
        return;
    }
    for (std::size_t i = 0; i < run.count; ++i)
        damp_lanes<T>(run, reverse ? run.count - 1 - i : i, cache, motion);
}

template <class V, class T, int Axes>
void damp_links(const LinkCache<T, Axes>& cache, MotionColumns<T, Axes>& motion, bool reverse) {
    const std::size_t count = cache.runs.size();
    for (std::size_t i = 0; i < count; ++i)
        damp_run<V, T, Axes>(cache.runs[reverse ? count - 1 - i : i], cache, motion, reverse);
}

template <class V, class T, int Axes>
void drift_rows(const RowViews<T, Axes>& views, std::size_t rows, std::size_t flow,
                MotionColumns<T, Axes>& motion) {
    for (std::size_t row = 0; row < rows; row += lanes_of<V>) {
        State<V, Axes> state = load<V>(motion, row);
        drift(state, views.flows()[flow], row);
        store(state, motion, row);
    }
}

template <class V, class T, std::size_t Axes>
void add_scaled_rows(std::array<Column<T>, Axes>& to, const std::array<Column<T>, Axes>& what,
                     T s) {
    for (std::size_t axis = 0; axis < Axes; ++axis)
        for (std::size_t row = 0; row < to[axis].size(); row += lanes_of<V>)
            store(V(load<V>(to[axis], row) + load<V>(what[axis], row) * V(s)), to[axis], row);
}

/// Whether a number of any row may no longer be finite.
template <class V, class T, int Axes>
bool motion_may_be_infinite(const MotionColumns<T, Axes>& motion) {
    V total(T(0));
    for (std::size_t row = 0; row < motion.x[0].size(); row += lanes_of<V>)
        for (std::size_t axis = 0; axis < Axes; ++axis)
            total = total + (load<V>(motion.x[axis], row) + load<V>(motion.v[axis], row));
    return !is_finite(total);
}

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
