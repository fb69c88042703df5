// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <vector>

#include "oiler/sim/motion_columns.hpp"

namespace oiler {

/// The forces from outside over the next step, such as a thrust.
template <std::floating_point T, int Axes>
struct AppliedForces {
    VecColumns<T, Axes> acceleration;  ///< m/s²; without rows until the first force
    std::vector<std::size_t> rows;     ///< those on which a force was applied, perhaps twice

    [[nodiscard]] bool empty() const { return rows.empty(); }
    void add(std::size_t row, const Vec<T, Axes>& change, std::size_t row_count) {
        for (std::size_t i = 0; i < Axes; ++i) {
            while (acceleration[i].size() < row_count) acceleration[i].push(T(0));
            acceleration[i][row] += change.axis[i];
        }
        rows.push_back(row);
    }
    /// The sum of the accelerations of a row, m/s².
    [[nodiscard]] Vec<T, Axes> sum(std::size_t row) const {
        if (row >= acceleration[0].size()) return {};
        return {generate<Axes>([&](auto axis) { return acceleration[axis][row]; })};
    }
    void clear() {
        for (const std::size_t row : rows)
            for (Column<T>& column : acceleration) column[row] = T(0);
        rows.clear();
    }
    void push_row() {
        if (acceleration[0].size() > 0)
            for (Column<T>& column : acceleration) column.push(T(0));
    }
    /// Removes `row`, to whose place row `last` moves.
    void swap_remove(std::size_t row, std::size_t last) {
        if (acceleration[0].size() > 0)
            for (Column<T>& column : acceleration) column.swap_remove(row);
        std::erase(rows, row);
        std::replace(rows.begin(), rows.end(), last, row);
    }
};

}  // namespace oiler
