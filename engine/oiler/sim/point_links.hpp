// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "oiler/math/vec.hpp"

namespace oiler {

/// A spring between a row and a fixed point. Its numbers are not per unit mass.
template <std::floating_point T, int Axes>
struct PointLinkRow {
    std::uint32_t row;
    std::uint32_t slot;  ///< of the link's handle
    T stiffness;         ///< N/m
    T damping;           ///< N·s/m
    T rest_length;       ///< m
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

template <std::floating_point T, int Axes>
void sort_point_links(std::vector<PointLinkRow<T, Axes>>& links) {
    const auto key = [](const PointLinkRow<T, Axes>& link) {
        return std::tuple(link.row, link.rest_length, link.stiffness, link.damping,
                          link.point.axis);
    };
    std::stable_sort(links.begin(), links.end(),
                     [&](const auto& one, const auto& other) { return key(one) < key(other); });
}

}  // namespace oiler
