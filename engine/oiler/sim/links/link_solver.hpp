// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <vector>

namespace oiler {

/// An entry of a sparse matrix. Entries at the same row and column add up.
template <std::floating_point T>
struct MatrixEntry {
    std::size_t row;
    std::size_t column;
    T value;
};

/// Factorises a square sparse matrix once. Returns a function of the right side of its equations
/// that returns their solution, which is not finite if the matrix is singular.
template <class T>
[[nodiscard]] std::function<std::vector<T>(const std::vector<T>& right)> factorised(
    std::size_t size, const std::vector<MatrixEntry<T>>& entries);

}  // namespace oiler
