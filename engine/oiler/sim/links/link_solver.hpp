// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <vector>

namespace oiler {

/// An entry of a sparse matrix. Entries at the same row and column add up.
template <std::floating_point T>
struct MatrixEntry {
    std::size_t row;
    std::size_t column;
    T value;
};

/// A square sparse matrix, factorised once for many solutions.
template <class T>
class LinkSolver {
public:
    LinkSolver(std::size_t size, const std::vector<MatrixEntry<T>>& entries);
    ~LinkSolver();
    LinkSolver(const LinkSolver&) = delete;
    LinkSolver& operator=(const LinkSolver&) = delete;

    /// The solution is not finite if the matrix is singular.
    [[nodiscard]] std::vector<T> solve(const std::vector<T>& right) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace oiler
