// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/math/vec.hpp"

namespace oiler {

/// A square matrix over the axes, stored by rows.
template <Number V, int Axes>
struct Matrix {
    std::array<Vec<V, Axes>, Axes> row{};

    [[nodiscard]] static constexpr Matrix scalar(const V& diagonal) {
        Matrix m;
        for (int i = 0; i < Axes; ++i) m(i, i) = diagonal;
        return m;
    }
    /// a·bᵀ.
    [[nodiscard]] static constexpr Matrix outer(const Vec<V, Axes>& a, const Vec<V, Axes>& b) {
        return {generate<Axes>([&](auto i) { return b * a.axis[i]; })};
    }

    constexpr V& operator()(int i, int j) { return row[static_cast<std::size_t>(i)][j]; }
    constexpr const V& operator()(int i, int j) const {
        return row[static_cast<std::size_t>(i)][j];
    }

    friend constexpr Matrix operator+(const Matrix& a, const Matrix& b) {
        return {generate<Axes>([&](auto i) { return a.row[i] + b.row[i]; })};
    }
    friend constexpr Matrix operator-(const Matrix& a, const Matrix& b) {
        return {generate<Axes>([&](auto i) { return a.row[i] - b.row[i]; })};
    }
    friend constexpr Matrix operator*(const Matrix& a, const V& s) {
        return {generate<Axes>([&](auto i) { return a.row[i] * s; })};
    }
};

/// Solves m·x = b by Gaussian elimination with partial pivoting. Not finite if m is singular.
template <std::floating_point T, int Axes>
[[nodiscard]] Vec<T, Axes> solve(Matrix<T, Axes> m, Vec<T, Axes> b) {
    for (int column = 0; column < Axes; ++column) {
        int pivot = column;
        for (int i = column + 1; i < Axes; ++i)
            if (std::abs(m(i, column)) > std::abs(m(pivot, column))) pivot = i;
        std::swap(m.row[static_cast<std::size_t>(column)], m.row[static_cast<std::size_t>(pivot)]);
        std::swap(b[column], b[pivot]);
        for (int i = column + 1; i < Axes; ++i) {
            const T factor = m(i, column) / m(column, column);
            for (int j = column; j < Axes; ++j) m(i, j) -= factor * m(column, j);
            b[i] -= factor * b[column];
        }
    }
    for (int i = Axes - 1; i >= 0; --i) {
        for (int j = i + 1; j < Axes; ++j) b[i] -= m(i, j) * b[j];
        b[i] /= m(i, i);
    }
    return b;
}

}  // namespace oiler
