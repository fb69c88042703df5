// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "oiler/physics/state.hpp"
#include "oiler/sim/column.hpp"

namespace oiler {

/// One vector per row.
template <class T, int Axes>
using VecColumns = std::array<Column<T>, Axes>;

template <class T, std::size_t Axes>
[[nodiscard]] T largest(const std::array<Column<T>, Axes>& columns) {
    T size = 0;
    for (const Column<T>& column : columns)
        for (std::size_t row = 0; row < column.size(); ++row)
            size = larger(size, std::abs(column[row]));
    return size;
}

/// The states of all rows: the numbers that a step changes.
template <std::floating_point T, int Axes>
struct MotionColumns {
    VecColumns<T, Axes> x{generate<Axes>([](auto i) { return Column<T>(i); })};         ///< m
    VecColumns<T, Axes> v{generate<Axes>([](auto i) { return Column<T>(Axes + i); })};  ///< m/s
};

template <class T, int Axes>
void clear_padding(MotionColumns<T, Axes>& motion) {
    for (auto* vector : {&motion.x, &motion.v})
        for (Column<T>& column : *vector) column.clear_padding();
}

template <Number V, std::floating_point T>
[[gnu::always_inline]] inline V load(const Column<T>& column, std::size_t row) {
    if constexpr (std::is_same_v<V, T>)
        return column[row];
    else
        return V::load(column.data() + row);
}
template <Number V, std::floating_point T>
[[gnu::always_inline]] inline void store(const V& value, Column<T>& column, std::size_t row) {
    if constexpr (std::is_same_v<V, T>)
        column[row] = value;
    else
        value.store(column.data() + row);
}

template <Number V, class T, std::size_t Axes>
[[gnu::always_inline]] inline Vec<V, int{Axes}> load(const std::array<Column<T>, Axes>& columns,
                                                     std::size_t row) {
    return {generate<Axes>([&](auto i) { return load<V>(columns[i], row); })};
}
template <Number V, class T, std::size_t Axes, int A>
[[gnu::always_inline]] inline void store(const Vec<V, A>& value,
                                         std::array<Column<T>, Axes>& columns, std::size_t row) {
    for_each_index<Axes>([&](auto i) { store(value.axis[i], columns[i], row); });
}
template <Number V, class T, int Axes>
[[gnu::always_inline]] inline State<V, Axes> load(const MotionColumns<T, Axes>& motion,
                                                  std::size_t row) {
    return {load<V>(motion.x, row), load<V>(motion.v, row)};
}
template <Number V, class T, int Axes>
[[gnu::always_inline]] inline void store(const State<V, Axes>& state,
                                         MotionColumns<T, Axes>& motion, std::size_t row) {
    store(state.x, motion.x, row);
    store(state.v, motion.v, row);
}

}  // namespace oiler
