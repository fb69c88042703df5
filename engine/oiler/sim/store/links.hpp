// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "oiler/math/vec.hpp"
#include "oiler/sim/store/column.hpp"

namespace oiler {

/// The most links in a run. It is fixed because the order of sums depends on it.
inline constexpr std::size_t most_links_per_run = 512;
/// The most scattered links in a group.
inline constexpr std::size_t most_scattered_links = 64;

/// A spring between two rows. Its numbers are not per unit mass, because it acts on two masses.
template <std::floating_point T>
struct LinkRow {
    std::uint32_t a;
    std::uint32_t b;
    std::uint32_t slot;  ///< of the link's handle
    T stiffness;         ///< N/m
    T damping;           ///< N·s/m
    T rest_length;       ///< m
    bool pulls_only;

    template <class F>
    void for_each_row(F f) {
        f(a), f(b);
    }
};

/// `count` links that are computed together; `of` is the first, with the largest damping of all.
template <std::floating_point T>
struct LinkGroup {
    LinkRow<T> of;
    std::size_t first;  ///< its index in the order of computation
    std::size_t count;
    /// Where the links are among the scattered ones. If absent, they are a run: all have the same
    /// numbers, and each joins the rows after those of the link before it.
    std::optional<std::size_t> scattered;

    /// The distance of the two rows of a link of a run.
    [[nodiscard]] [[gnu::always_inline]] std::size_t shift() const {
        return std::max(of.a, of.b) - std::min(of.a, of.b);
    }
};

/// Links between any two rows. In a group, all have rest lengths or none has, and all are ropes or
/// none is.
template <class T>
struct ScatteredLinks {
    std::vector<std::uint32_t> a;
    std::vector<std::uint32_t> b;
    std::vector<T> stiffness;    ///< N/m
    std::vector<T> damping;      ///< N·s/m
    std::vector<T> rest_length;  ///< m
};

/// The sums over the links of a row.
template <class T>
struct LinksOfRow {
    T stiffness = 0;  ///< N/m
    T damping = 0;    ///< kg/s
};

/// The links as steps compute them. The order does not depend on the order in which bodies were
/// linked, so that a net has long runs in any case.
template <std::floating_point T>
struct PreparedLinks {
    std::vector<LinkGroup<T>> groups;
    ScatteredLinks<T> scattered;
    bool any_damped = false;
    Parameter<T> inverse_mass;           ///< 1/kg, per row
    std::vector<LinksOfRow<T>> of_rows;  ///< per row
    T half_step = 0;                     ///< s
    /// Per link, and one more: 1 − e^(−b·(1/m₁ + 1/m₂)·τ) over a half-step.
    std::vector<T> loss;
};

/// A spring between a row and a fixed point. Its numbers are not per unit mass.
template <std::floating_point T, int Axes>
struct PointLinkRow {
    std::uint32_t row;
    std::uint32_t slot;  ///< of the link's handle
    T stiffness;         ///< N/m
    T damping;           ///< N·s/m
    T rest_length;       ///< m
    bool pulls_only;
    Vec<T, Axes> point;  ///< m

    template <class F>
    void for_each_row(F f) {
        f(row);
    }
};

/// The springs to fixed points as steps compute them, one by one: a net has few of them. The order
/// does not depend on the order in which they were added.
template <std::floating_point T, int Axes>
struct PointLinks {
    std::vector<PointLinkRow<T, Axes>> links;
    std::vector<T> loss;  ///< per link: 1 − e^(−b·τ/m) over a half-step
};

/// The damper of a rope that is taut at the start of an implicit step, to whose end it acts. A
/// damper that begins within the step would be a jump, for which the step may have no solution.
template <std::floating_point T, int Axes>
struct HeldDamper {
    std::uint32_t row;
    std::optional<std::uint32_t> other;  ///< absent for a point
    T damping;                           ///< N·s/m
    Vec<T, Axes> point;                  ///< m
};

/// Prepares links between rows of these masses (kg) for dampers over `half_step` (s).
template <std::floating_point T>
[[nodiscard]] PreparedLinks<T> prepare_links(std::vector<LinkRow<T>> links,
                                             const Parameter<double>& mass, std::size_t rows,
                                             T half_step);

/// The indices of links in the order of their dampers in the first half of a step; the second half
/// has the reverse order.
template <std::floating_point T>
[[nodiscard]] std::vector<std::size_t> damping_order(std::vector<LinkRow<T>> links);

}  // namespace oiler
