// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>
#include <utility>

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

/// The number with the most lanes below those of V, for what remains after whole batches of V.
template <class V>
struct NarrowerOf {
    using type = V;
};
template <class T, std::size_t Bytes, std::size_t Packs>
struct NarrowerOf<Batch<Pack<T, Bytes>, Packs>> {
    static constexpr std::size_t smallest = 16;
    using type =
        std::conditional_t<(Packs > 1), Batch<Pack<T, Bytes>, 1>,
                           std::conditional_t<(Bytes > smallest), Batch<Pack<T, smallest>, 1>, T>>;
};
template <class V>
using Narrower = typename NarrowerOf<V>::type;

/// Calls f(N{}, i) for batches N of `count` numbers from `begin` on: whole batches of V first, then
/// narrower ones.
template <class V, class F>
[[gnu::always_inline]] inline void for_lanes(std::size_t begin, std::size_t count, F f) {
    std::size_t i = begin;
    for (; i + lanes_of<V> <= count; i += lanes_of<V>) f(V(Scalar<V>(0)), i);
    if constexpr (lanes_of < V >> 1) for_lanes<Narrower<V>>(i, count, f);
}

/// Like for_lanes from 0 on, beginning with the last numbers.
template <class V, class F>
[[gnu::always_inline]] inline void for_lanes_reversed(std::size_t count, F f) {
    for (; count >= lanes_of<V>; count -= lanes_of<V>) f(V(Scalar<V>(0)), count - lanes_of<V>);
    if constexpr (lanes_of < V >> 1) for_lanes_reversed<Narrower<V>>(count, f);
}

/// Like for_lanes, for an `f` that may handle an index twice: the last batch may overlap the one
/// before it.
template <class V, class F>
[[gnu::always_inline]] inline void for_overlapping_lanes(std::size_t count, F f) {
    if constexpr (lanes_of < V >> 1)
        if (count < lanes_of<V>) return for_overlapping_lanes<Narrower<V>>(count, f);
    if (count == 0) return;
    for (std::size_t i = 0; i + lanes_of<V> < count; i += lanes_of<V>) f(V(Scalar<V>(0)), i);
    f(V(Scalar<V>(0)), count - lanes_of<V>);
}

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

/// The most links in a run. It is fixed because the order of sums depends on it.
inline constexpr std::size_t most_links_per_run = 512;

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
[[gnu::always_inline]] inline void push_run(const LinkRun<T>& run,
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

/// The most links between any two rows that are computed together.
inline constexpr std::size_t most_any_links = 64;

/// Applies links between any two rows to the rows of a range, link by link.
template <class V, class T, int Axes>
[[gnu::always_inline]] inline void push_any(const LinkRun<T>& run, const AnyLinks<T>& links,
                                            const MotionColumns<T, Axes>& motion, Evaluate what,
                                            const Parameter<T>& inverse_mass, const RowRange& rows,
                                            VecColumns<T, Axes>& to) {
    using Numbers = std::array<std::array<T, most_any_links>, Axes>;
    const std::size_t first = *run.any;
    const std::uint32_t* const a = links.a.data() + first;
    const std::uint32_t* const b = links.b.data() + first;
    const auto gather = [&](const VecColumns<T, Axes>& columns, Numbers& between)
        __attribute__((always_inline)) {
        for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
            const T* const from = columns[axis].data();
            for (std::size_t i = 0; i < run.count; ++i) between[axis][i] = from[a[i]] - from[b[i]];
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
        run.count, [&]<class N>(N n, std::size_t i) __attribute__((always_inline)) {
            const LinkForce<N, Axes> link(
                load_from<N>(&links.stiffness[first + i]), load_from<N>(&links.damping[first + i]),
                load_from<N>(&links.rest_length[first + i]), run.of.rest_length == 0);
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
    for (std::size_t i = 0; i < run.count; ++i) {
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
void push_links(const LinkCache<T, Axes>& cache, const MotionColumns<T, Axes>& motion,
                Evaluate what, const RowRange& rows, VecColumns<T, Axes>& to) {
    for (const LinkRun<T>& run : cache.runs)
        if (run.any)
            push_any<V, T, Axes>(run, cache.any, motion, what, cache.inverse_mass, rows, to);
        else
            push_run<V, T, Axes>(run, motion, what, cache.inverse_mass, rows, to);
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
[[gnu::always_inline]] inline void damp_lanes(const LinkRun<T>& run, std::size_t i,
                                              const LinkCache<T, Axes>& cache,
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
    const T* const losses = cache.loss.data() + run.first + i;
    const N loss = load_ends<N, lanes>(losses, 0, 1).first;
    const bool shared = cache.inverse_mass.shared();
    const auto inverse =
        load_ends<N, lanes>(cache.inverse_mass.data(0), shared ? 0 : a, shared ? 1 : b);
    const Vec<N, Axes> force = -LinkForce<N, Axes>(run.of).velocity_loss(between, loss) *
                               N(N(T(1)) / N(inverse.first + inverse.second));
    for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
        store_ends<lanes>(N(va.axis[axis] + force.axis[axis] * inverse.first),
                          N(vb.axis[axis] - force.axis[axis] * inverse.second),
                          motion.v[axis].data(), a, b);
    });
}

/// Calls f(N{}) for the N with the most lanes, V or narrower, that has at most `most`.
template <class V, class F>
[[gnu::always_inline]] inline void with_lanes(std::size_t most, F f) {
    if constexpr (lanes_of < V >> 1)
        if (lanes_of < V >> most) return with_lanes<Narrower<V>>(most, f);
    f(V(Scalar<V>(0)));
}

/// The dampers of a run, one after the other. With lanes up to the distance of the two rows of a
/// link, no row belongs to two lanes.
template <class V, class T, int Axes>
[[gnu::always_inline]] inline void damp_in_order(const LinkRun<T>& run,
                                                 const LinkCache<T, Axes>& cache,
                                                 MotionColumns<T, Axes>& motion, bool reverse) {
    const auto damp = [&]<class N>(N, std::size_t i) __attribute__((always_inline)) {
        damp_lanes<N, Lanes::all>(run, i, cache, motion);
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
[[gnu::always_inline]] inline void damp_chain(const LinkRun<T>& run,
                                              const LinkCache<T, Axes>& cache,
                                              MotionColumns<T, Axes>& motion, bool reverse) {
    for (const std::size_t first : {reverse ? 1U : 0U, reverse ? 0U : 1U})
        for_lanes<V>(
            0, (run.count + 1 - first) / 2,
            [&]<class N>(N, std::size_t i) __attribute__((always_inline)) {
                damp_lanes<N, Lanes::every_other>(run, first + 2 * i, cache, motion);
            });
}

/// The dampers of links between any two rows, one after the other.
template <class T, int Axes>
void damp_any(const LinkRun<T>& run, const LinkCache<T, Axes>& cache,
              MotionColumns<T, Axes>& motion, bool reverse) {
    const AnyLinks<T>& links = cache.any;
    for (std::size_t i = 0; i < run.count; ++i) {
        const std::size_t link = reverse ? run.count - 1 - i : i;
        const std::size_t at = *run.any + link;
        const LinkRow<T> row{links.a[at],         links.b[at],       0,
                             links.stiffness[at], links.damping[at], links.rest_length[at]};
        damp_lanes<T, Lanes::all>(LinkRun<T>{row, run.first + link, 1, {}}, 0, cache, motion);
    }
}

template <class V, class T, int Axes>
[[gnu::always_inline]] inline void damp_run(const LinkRun<T>& run, const LinkCache<T, Axes>& cache,
                                            MotionColumns<T, Axes>& motion, bool reverse) {
    if (run.of.damping == 0) return;
    if (run.any)
        damp_any(run, cache, motion, reverse);
    else if (run.shift() == 1)
        damp_chain<V>(run, cache, motion, reverse);
    else
        damp_in_order<V>(run, cache, motion, reverse);
}

template <class V, class T, int Axes>
void damp_links(const LinkCache<T, Axes>& cache, MotionColumns<T, Axes>& motion, bool reverse) {
    const std::size_t count = cache.runs.size();
    for (std::size_t i = 0; i < count; ++i)
        damp_run<V, T, Axes>(cache.runs[reverse ? count - 1 - i : i], cache, motion, reverse);
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
