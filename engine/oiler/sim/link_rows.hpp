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

/// The most links between any two rows that are gathered together.
inline constexpr std::size_t most_links_per_gather = 64;

/// The first `count` runs, of one link each, between any two rows.
template <std::floating_point T, int Axes>
class GatheredLinks {
public:
    using Motion = MotionColumns<T, Axes>;

    [[gnu::always_inline]] GatheredLinks(const LinkRun<T>* runs, std::size_t count,
                                         const Motion& motion)
        : runs_(runs), count_(count), without_length_(runs->of.rest_length == 0) {
        for (std::size_t i = 0; i < count_; ++i) {
            const LinkRow<T>& link = runs_[i].of;
            stiffness_[i] = link.stiffness;
            damping_[i] = link.damping;
            rest_length_[i] = link.rest_length;
            for (std::size_t axis = 0; axis < Axes; ++axis) {
                x_[axis][i] = motion.x[axis][link.a] - motion.x[axis][link.b];
                v_[axis][i] = motion.v[axis][link.a] - motion.v[axis][link.b];
            }
        }
    }
    /// Adds the accelerations, link by link.
    template <class V>
    void push(Evaluate what, const Parameter<T>& inverse_mass, VecColumns<T, Axes>& to) {
        for_overlapping_lanes<V, T>(
            count_, [&]<class N>(N, std::size_t i) __attribute__((always_inline)) {
                const LinkForce<N, Axes> link(load_from<N>(&stiffness_[i]),
                                              load_from<N>(&damping_[i]),
                                              load_from<N>(&rest_length_[i]), without_length_);
                const State<N, Axes> between{load_rows<N>(x_, i), load_rows<N>(v_, i)};
                const Vec<N, Axes> f =
                    what == Evaluate::field ? link.field(between.x) : link.accelerate(between);
                for (std::size_t axis = 0; axis < Axes; ++axis)
                    store_to<N>(f.axis[axis], &force_[axis][i]);
            });
        for (std::size_t i = 0; i < count_; ++i) {
            const auto [a, b] = std::pair{runs_[i].of.a, runs_[i].of.b};
            for (std::size_t axis = 0; axis < Axes; ++axis) {
                T* const at = to[axis].data();
                at[a] = at[a] + force_[axis][i] * inverse_mass[a];
                at[b] = at[b] - force_[axis][i] * inverse_mass[b];
            }
        }
    }

private:
    using Numbers = std::array<T, most_links_per_gather>;

    template <class N>
    [[gnu::always_inline]] static Vec<N, Axes> load_rows(const std::array<Numbers, Axes>& numbers,
                                                         std::size_t i) {
        return {generate<Axes>([&](auto axis) { return load_from<N>(&numbers[axis][i]); })};
    }

    const LinkRun<T>* runs_;
    std::size_t count_;
    bool without_length_;
    Numbers stiffness_, damping_, rest_length_;
    std::array<Numbers, Axes> x_, v_, force_;
};

/// How many runs from `first` on are of one link, with the same law of force.
template <class T>
[[gnu::always_inline]] inline std::size_t count_single_links(const std::vector<LinkRun<T>>& runs,
                                                             std::size_t first) {
    const auto has_length = [&](std::size_t i) { return runs[i].of.rest_length != 0; };
    const std::size_t end = std::min(runs.size(), first + most_links_per_gather);
    std::size_t i = first;
    while (i < end && runs[i].count == 1 && has_length(i) == has_length(first)) ++i;
    return i - first;
}

template <class V, class T, int Axes>
void push_links(const LinkCache<T, Axes>& cache, const MotionColumns<T, Axes>& motion,
                Evaluate what, VecColumns<T, Axes>& to) {
    for (std::size_t i = 0; i < cache.runs.size();) {
        const LinkRun<T>& run = cache.runs[i];
        const std::size_t single = count_single_links(cache.runs, i);
        if (single > 0)
            GatheredLinks<T, Axes>(&run, single, motion)
                .template push<V>(what, cache.inverse_mass, to);
        else if (run.count < lanes_of<V>)
            push_run<T, T, Axes>(run, motion, what, cache.inverse_mass, to);
        else
            push_run<V, T, Axes>(run, motion, what, cache.inverse_mass, to);
        i += std::max<std::size_t>(1, single);
    }
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

/// The dampers of a run, one after the other. With lanes up to the distance of the two rows of a
/// link, no row belongs to two lanes.
template <class V, class T, int Axes>
[[gnu::always_inline]] inline void damp_in_order(const LinkRun<T>& run,
                                                 const LinkCache<T, Axes>& cache,
                                                 MotionColumns<T, Axes>& motion, bool reverse) {
    if (!reverse) {
        for_lanes<V, T>(
            run.count, [&]<class N>(N, std::size_t i) __attribute__((always_inline)) {
                damp_lanes<N>(run, i, cache, motion);
            });
        return;
    }
    std::size_t left = run.count;
    for (; left >= lanes_of<V>; left -= lanes_of<V>)
        damp_lanes<V>(run, left - lanes_of<V>, cache, motion);
    while (left > 0) damp_lanes<T>(run, --left, cache, motion);
}

/// The dampers of a chain: every other link, so that no link waits for the one before it.
template <class T, int Axes>
[[gnu::always_inline]] inline void damp_chain(const LinkRun<T>& run,
                                              const LinkCache<T, Axes>& cache,
                                              MotionColumns<T, Axes>& motion, bool reverse) {
    for (const std::size_t first : {reverse ? 1U : 0U, reverse ? 0U : 1U})
        for (std::size_t i = first; i < run.count; i += 2) damp_lanes<T>(run, i, cache, motion);
}

template <class V, class T, int Axes>
[[gnu::always_inline]] inline void damp_run(const LinkRun<T>& run, const LinkCache<T, Axes>& cache,
                                            MotionColumns<T, Axes>& motion, bool reverse) {
    if (run.of.damping == 0) return;
    if (run.shift() == 1)
        damp_chain(run, cache, motion, reverse);
    else if (run.shift() >= lanes_of<V>)
        damp_in_order<V>(run, cache, motion, reverse);
    else
        damp_in_order<T>(run, cache, motion, reverse);
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
