// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <tuple>
#include <utility>

#include "oiler/sim/links/lanes.hpp"
#include "oiler/sim/links/link_force.hpp"
#include "oiler/sim/rows/row_physics.hpp"

namespace oiler {

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
                             links.stiffness[at], links.damping[at], links.rest_length[at]};
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

}  // namespace oiler
