// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "oiler/sim/links/lanes.hpp"
#include "oiler/sim/links/link_force.hpp"
#include "oiler/sim/rows/row_physics.hpp"

namespace oiler {

/// Adds the accelerations by forces on `count` rows from `row` on, or subtracts them.
template <class V, class T, std::size_t Axes>
[[gnu::always_inline]] inline void push_rows(const std::array<const T*, Axes>& force,
                                             std::size_t count, const Parameter<T>& inverse_mass,
                                             bool subtract, std::array<Column<T>, Axes>& to,
                                             std::size_t row) {
    for_lanes<V>(
        0, count, [&]<class N>(N, std::size_t i) __attribute__((always_inline)) {
            const N inverse = load_from<N>(inverse_mass.data(row + i));
            for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
                T* const at = to[axis].data() + row + i;
                const N push = load_from<N>(force[axis] + i) * inverse;
                const N was = load_from<N>(at);
                store_to<N>(subtract ? N(was - push) : N(was + push), at);
            });
        });
}

/// The links of a run whose rows from `first` on are in a range.
struct LinksInRange {
    [[gnu::always_inline]] LinksInRange(std::size_t first, std::size_t count, const RowRange& rows)
        : begin(std::min(count, rows.begin - std::min(rows.begin, first))),
          end(std::max(begin, std::min(count, rows.end - std::min(rows.end, first)))) {}

    std::size_t begin;
    std::size_t end;
};

/// Applies a run of links to the rows of a range: first to all their first rows, then to all their
/// second rows.
template <class V, class T, int Axes>
[[gnu::always_inline]] inline void push_run(const LinkGroup<T>& run,
                                            const MotionColumns<T, Axes>& motion, Evaluate what,
                                            const Parameter<T>& inverse_mass, const RowRange& rows,
                                            VecColumns<T, Axes>& to) {
    const LinksInRange of_a(run.of.a, run.count, rows);
    const LinksInRange of_b(run.of.b, run.count, rows);
    const std::size_t begin = std::min(of_a.begin, of_b.begin);
    const std::size_t end = std::max(of_a.end, of_b.end);
    alignas(column_alignment) std::array<std::array<T, most_links_per_run>, Axes> force;
    const auto ends = [&]<class N>(N, const VecColumns<T, Axes>& columns, std::size_t i)
        __attribute__((always_inline)) {
        return Vec<N, Axes>{generate<Axes>([&](auto axis) __attribute__((always_inline)) {
            return N(load_from<N>(columns[axis].data() + run.of.a + i) -
                     load_from<N>(columns[axis].data() + run.of.b + i));
        })};
    };
    for_overlapping_lanes<V>(
        end - begin, [&]<class N>(N, std::size_t from) __attribute__((always_inline)) {
            const std::size_t i = begin + from;
            const LinkForce<N, Axes> link(run.of);
            const Vec<N, Axes> d = ends(N(T(0)), motion.x, i);
            const Vec<N, Axes> f = what == Evaluate::field
                                       ? link.field(d)
                                       : link.accelerate({d, ends(N(T(0)), motion.v, i)});
            for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
                store_to<N>(f.axis[axis], force[axis].data() + i);
            });
        });
    const auto push = [&](const LinksInRange& links, bool subtract, std::size_t first)
        __attribute__((always_inline)) {
        std::array<const T*, Axes> from;
        for (std::size_t axis = 0; axis < Axes; ++axis)
            from[axis] = force[axis].data() + links.begin;
        push_rows<V>(from, links.end - links.begin, inverse_mass, subtract, to,
                     first + links.begin);
    };
    push(of_a, false, run.of.a);
    push(of_b, true, run.of.b);
}

/// Applies links between any two rows to the rows of a range, link by link.
template <class V, class T, int Axes>
[[gnu::always_inline]] inline void push_scattered(const LinkGroup<T>& group,
                                                  const ScatteredLinks<T>& links,
                                                  const MotionColumns<T, Axes>& motion,
                                                  Evaluate what, const Parameter<T>& inverse_mass,
                                                  const RowRange& rows, VecColumns<T, Axes>& to) {
    using Numbers = std::array<std::array<T, most_scattered_links>, Axes>;
    const std::size_t first = *group.scattered;
    const std::uint32_t* const a = links.a.data() + first;
    const std::uint32_t* const b = links.b.data() + first;
    const auto gather = [&](const VecColumns<T, Axes>& columns, Numbers& between)
        __attribute__((always_inline)) {
        for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
            const T* const from = columns[axis].data();
            for (std::size_t i = 0; i < group.count; ++i)
                between[axis][i] = from[a[i]] - from[b[i]];
        });
    };
    const auto load_rows = [&]<class N>(N, const Numbers& numbers, std::size_t i)
        __attribute__((always_inline)) {
        return Vec<N, Axes>{
            generate<Axes>([&](auto axis) { return load_from<N>(&numbers[axis][i]); })};
    };
    alignas(column_alignment) Numbers x;
    alignas(column_alignment) Numbers v;
    alignas(column_alignment) Numbers force;
    gather(motion.x, x);
    if (what == Evaluate::all) gather(motion.v, v);
    for_overlapping_lanes<V>(
        group.count, [&]<class N>(N n, std::size_t i) __attribute__((always_inline)) {
            const LinkForce<N, Axes> link(load_from<N>(&links.stiffness[first + i]),
                                          load_from<N>(&links.damping[first + i]),
                                          load_from<N>(&links.rest_length[first + i]),
                                          group.of.rest_length == 0, group.of.pulls_only);
            const Vec<N, Axes> d = load_rows(n, x, i);
            const Vec<N, Axes> f =
                what == Evaluate::field ? link.field(d) : link.accelerate({d, load_rows(n, v, i)});
            for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
                store_to<N>(f.axis[axis], &force[axis][i]);
            });
        });
    const T* const inverse = inverse_mass.data(0);
    const std::size_t stride = inverse_mass.shared() ? 0 : 1;
    const bool all_rows = rows.begin == 0 && rows.end == motion.x[0].size();
    for (std::size_t i = 0; i < group.count; ++i) {
        const auto push = [&](std::size_t row, T sign) __attribute__((always_inline)) {
            if (!all_rows && !rows.holds(row)) return;
            const T scale = sign * inverse[row * stride];
            for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
                T& at = to[axis][row];
                at = at + force[axis][i] * scale;
            });
        };
        push(a[i], T(1));
        push(b[i], T(-1));
    }
}

template <class V, class T, int Axes>
void push_links(const PreparedLinks<T>& prepared, const MotionColumns<T, Axes>& motion,
                Evaluate what, const RowRange& rows, VecColumns<T, Axes>& to) {
    for (const LinkGroup<T>& group : prepared.groups)
        if (group.scattered)
            push_scattered<V, T, Axes>(group, prepared.scattered, motion, what,
                                       prepared.inverse_mass, rows, to);
        else
            push_run<V, T, Axes>(group, motion, what, prepared.inverse_mass, rows, to);
}

/// The links in the lanes of a batch: link after link of a run, or every other link of a chain, in
/// which each link joins a row with the next one.
enum class Lanes { all, every_other };

/// The numbers in a column of the first and second rows of links; `a` and `b` are the rows of the
/// first of them.
template <class N, Lanes lanes, class T>
[[gnu::always_inline]] inline std::pair<N, N> load_ends(const T* column, std::size_t a,
                                                        std::size_t b) {
    if constexpr (lanes == Lanes::all || lanes_of<N> == 1)
        return {load_from<N>(column + a), load_from<N>(column + b)};
    else {
        const auto [low, high] = N::load_pairs(column + std::min(a, b));
        return a < b ? std::pair(low, high) : std::pair(high, low);
    }
}
template <Lanes lanes, class N, class T>
[[gnu::always_inline]] inline void store_ends(const N& of_a, const N& of_b, T* column,
                                              std::size_t a, std::size_t b) {
    if constexpr (lanes == Lanes::all || lanes_of<N> == 1) {
        store_to<N>(of_a, column + a);
        store_to<N>(of_b, column + b);
    } else if (a < b)
        N::store_pairs(of_a, of_b, column + a);
    else
        N::store_pairs(of_b, of_a, column + b);
}

/// The dampers of the links from `i` on of a run, for as many links as N has lanes.
template <class N, Lanes lanes, class T, int Axes>
[[gnu::always_inline]] inline void damp_lanes(const LinkGroup<T>& run, std::size_t i,
                                              const PreparedLinks<T>& prepared,
                                              MotionColumns<T, Axes>& motion) {
    const std::size_t a = run.of.a + i;
    const std::size_t b = run.of.b + i;
    State<N, Axes> between;
    Vec<N, Axes> va;
    Vec<N, Axes> vb;
    for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
        const auto x = load_ends<N, lanes>(motion.x[axis].data(), a, b);
        std::tie(va.axis[axis], vb.axis[axis]) = load_ends<N, lanes>(motion.v[axis].data(), a, b);
        between.x.axis[axis] = x.first - x.second;
        between.v.axis[axis] = va.axis[axis] - vb.axis[axis];
    });
    const T* const losses = prepared.loss.data() + run.first + i;
    const N loss = load_ends<N, lanes>(losses, 0, 1).first;
    const bool shared = prepared.inverse_mass.shared();
    const auto inverse =
        load_ends<N, lanes>(prepared.inverse_mass.data(0), shared ? 0 : a, shared ? 1 : b);
    const Vec<N, Axes> force = -LinkForce<N, Axes>(run.of).velocity_loss(between, loss) *
                               N(N(T(1)) / N(inverse.first + inverse.second));
    for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
        store_ends<lanes>(N(va.axis[axis] + force.axis[axis] * inverse.first),
                          N(vb.axis[axis] - force.axis[axis] * inverse.second),
                          motion.v[axis].data(), a, b);
    });
}

/// The dampers of a run, one after the other. With lanes up to the distance of the two rows of a
/// link, no row belongs to two lanes.
template <class V, class T, int Axes>
[[gnu::always_inline]] inline void damp_in_order(const LinkGroup<T>& run,
                                                 const PreparedLinks<T>& prepared,
                                                 MotionColumns<T, Axes>& motion, bool reverse) {
    const auto damp = [&]<class N>(N, std::size_t i) __attribute__((always_inline)) {
        damp_lanes<N, Lanes::all>(run, i, prepared, motion);
    };
    with_lanes<V>(
        run.shift(), [&]<class Widest>(Widest) __attribute__((always_inline)) {
            if (reverse)
                for_lanes_reversed<Widest>(run.count, damp);
            else
                for_lanes<Widest>(0, run.count, damp);
        });
}

/// The dampers of a chain: every other link, so that no link waits for the one before it.
template <class V, class T, int Axes>
[[gnu::always_inline]] inline void damp_chain(const LinkGroup<T>& run,
                                              const PreparedLinks<T>& prepared,
                                              MotionColumns<T, Axes>& motion, bool reverse) {
    for (const std::size_t first : {reverse ? 1U : 0U, reverse ? 0U : 1U})
        for_lanes<V>(
            0, (run.count + 1 - first) / 2,
            [&]<class N>(N, std::size_t i) __attribute__((always_inline)) {
                damp_lanes<N, Lanes::every_other>(run, first + 2 * i, prepared, motion);
            });
}

/// The dampers of links between any two rows, one after the other.
template <class T, int Axes>
[[gnu::always_inline]] inline void damp_scattered(const LinkGroup<T>& group,
                                                  const PreparedLinks<T>& prepared,
                                                  MotionColumns<T, Axes>& motion, bool reverse) {
    const ScatteredLinks<T>& links = prepared.scattered;
    for (std::size_t i = 0; i < group.count; ++i) {
        const std::size_t link = reverse ? group.count - 1 - i : i;
        const std::size_t at = *group.scattered + link;
        const LinkRow<T> row{links.a[at],         links.b[at],       0,
                             links.stiffness[at], links.damping[at], links.rest_length[at],
                             group.of.pulls_only};
        damp_lanes<T, Lanes::all>(LinkGroup<T>{row, group.first + link, 1, {}}, 0, prepared,
                                  motion);
    }
}

template <class V, class T, int Axes>
[[gnu::always_inline]] inline void damp_group(const LinkGroup<T>& group,
                                              const PreparedLinks<T>& prepared,
                                              MotionColumns<T, Axes>& motion, bool reverse) {
    if (group.of.damping == 0) return;
    if (group.scattered)
        damp_scattered(group, prepared, motion, reverse);
    else if (group.shift() == 1)
        damp_chain<V>(group, prepared, motion, reverse);
    else
        damp_in_order<V>(group, prepared, motion, reverse);
}

template <class V, class T, int Axes>
void damp_links(const PreparedLinks<T>& prepared, MotionColumns<T, Axes>& motion, bool reverse) {
    const std::size_t count = prepared.groups.size();
    for (std::size_t i = 0; i < count; ++i)
        damp_group<V, T, Axes>(prepared.groups[reverse ? count - 1 - i : i], prepared, motion,
                               reverse);
}

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
        drift(state, views.flows[flow], row);
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
