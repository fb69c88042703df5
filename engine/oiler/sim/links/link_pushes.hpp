// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>

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
            const LinkForce<N, Axes> link(
                load_from<N>(&links.stiffness[first + i]), load_from<N>(&links.damping[first + i]),
                load_from<N>(&links.rest_length[first + i]), group.of.rest_length == 0);
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

}  // namespace oiler
