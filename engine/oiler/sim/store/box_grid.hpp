// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "oiler/math/vec.hpp"

namespace oiler {

/// A closed box along the axes, m.
struct Bounds {
    Vec3 low;
    Vec3 high;
};

/// Has no branches, because a processor could not predict them.
[[nodiscard]] inline bool overlap(const Bounds& a, const Bounds& b) {
    unsigned common = 1;
    for_each_index<3>([&](auto i) {
        common &= unsigned{a.low.axis[i] <= b.high.axis[i]};
        common &= unsigned{b.low.axis[i] <= a.high.axis[i]};
    });
    return common != 0;
}

/// Bounds of a ball of `radius` m that moves along a line, with a margin for round-off.
[[nodiscard]] Bounds bounds_of_path(const Vec3& start, const Vec3& end, double radius);

/// Finds overlapping boxes. For each size of boxes, a power of two, there is a grid with cells of
/// that size. A box is in the cell of its lowest corner, so it reaches into the next cells at most.
/// A hash gives each cell of all grids a number, and the boxes are sorted by the numbers of their
/// cells. Sizes and distances therefore change neither the memory nor the time to build it.
class BoxGrid {
public:
    struct Item {
        Bounds box;
        std::uint32_t id;
        std::int32_t exponent;  ///< its cells are 2^exponent m wide
    };
    static constexpr int least_exponent = -1000;

    /// Removes all boxes and keeps the memory. Cells will be at least 2^finest m wide.
    void clear(int axes, int finest = least_exponent);
    /// Adds a box if it is finite.
    void add(const Bounds& box, std::uint32_t id);
    /// Sorts the boxes. The functions below need this call after the last box.
    void build();

    /// The width of the finest cells, m; 0 without boxes.
    [[nodiscard]] double finest_width() const {
        return levels_.empty() ? 0 : 1 / levels_.front().per_cell;
    }
    /// The boxes in the order of their cells' numbers.
    [[nodiscard]] const std::vector<Item>& items() const { return items_; }

    /// Calls f(i) for each of items() that overlaps `box`, for some of them several times. If `box`
    /// covers more cells of a grid than there are boxes, all boxes are tested instead.
    template <class F>
    void for_each_overlap(const Bounds& box, F f) const {
        for (const Level& level : levels_) visit(box, level, f);
    }
    /// Calls f(i, j) for each pair of items() that overlap, for some pairs several times.
    template <class F>
    void for_each_pair(F f) const {
        for (std::size_t i = 0; i < items_.size(); ++i) {
            auto with_i = [&](std::size_t j) {
                if (j != i) f(i, j);
            };
            for (const Level& level : levels_) {
                if (level.exponent == items_[i].exponent) visit_before(i, level, with_i);
                if (level.exponent > items_[i].exponent) visit(items_[i].box, level, with_i);
            }
        }
    }

private:
    /// The grid of one width of cells.
    struct Level {
        std::int32_t exponent;
        double per_cell;  ///< 2^−exponent, 1/m
    };
    using Cell = std::array<std::int64_t, 3>;

    /// Cells along x whose numbers are consecutive.
    static constexpr int run_bits = 6;
    static constexpr std::int64_t run = std::int64_t{1} << run_bits;

    /// Rounds towards 0: the cells at the origin are twice as wide. The outermost cells have no
    /// end.
    [[nodiscard]] Cell cell_of(const Vec3& corner, double per_cell) const {
        Cell cell{};
        for (std::size_t i = 0; i < axes_; ++i)
            cell[i] =
                static_cast<std::int64_t>(std::clamp(corner.axis[i] * per_cell, -0x1p61, 0x1p61));
        return cell;
    }
    /// The number of the first cell of a run: random factors, and the finaliser of SplitMix64
    /// (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014).
    [[nodiscard]] std::size_t number_of_run(const Level& level, std::int64_t x, std::int64_t y,
                                            std::int64_t z) const {
        std::uint64_t bits = static_cast<std::uint64_t>(level.exponent) * 0x9e3779b97f4a7c15U +
                             static_cast<std::uint64_t>(x) * 0xd1342543de82ef95U +
                             static_cast<std::uint64_t>(y) * 0xaf251af3b0f025b5U +
                             static_cast<std::uint64_t>(z) * 0x8cb92ba72f3d8dd7U;
        bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9U;
        bits = (bits ^ bits >> 27) * 0x94d049bb133111ebU;
        return (bits ^ bits >> 31) & mask_;
    }
    [[nodiscard]] static std::size_t place_in_run(std::int64_t x) {
        return static_cast<std::size_t>(x & (run - 1));
    }
    [[nodiscard]] std::size_t number_of_cell(const Item& item) const;
    void list_levels();
    void count_cells();

    /// The cell with the lowest corners of boxes that reach into `cell`.
    [[nodiscard]] Cell before(Cell cell) const {
        for (std::size_t i = 0; i < axes_; ++i) --cell[i];
        return cell;
    }
    template <class F>
    void visit(const Bounds& box, const Level& level, F& f) const {
        const Cell first = before(cell_of(box.low, level.per_cell));
        const Cell last = cell_of(box.high, level.per_cell);
        double runs = static_cast<double>((last[0] >> run_bits) - (first[0] >> run_bits) + 1);
        for (std::size_t i = 1; i < 3; ++i) runs *= static_cast<double>(last[i] - first[i] + 1);
        if (runs > static_cast<double>(items_.size())) return test(0, items_.size(), box, level, f);
        for (std::int64_t z = first[2]; z <= last[2]; ++z)
            for (std::int64_t y = first[1]; y <= last[1]; ++y)
                visit_row(first[0], last[0], y, z, box, level, f);
    }
    /// Visits the items before item i of its own grid: in cells that precede its own in the order
    /// of z, y, x, and in its own cell.
    template <class F>
    void visit_before(std::size_t i, const Level& level, F& f) const {
        const Bounds& box = items_[i].box;
        const Cell own = cell_of(box.low, level.per_cell);
        const Cell first = before(own);
        const Cell last = cell_of(box.high, level.per_cell);
        for (std::int64_t z = first[2]; z <= own[2]; ++z)
            for (std::int64_t y = first[1]; y <= (z < own[2] ? last[1] : own[1]); ++y)
                visit_row(first[0], z < own[2] || y < own[1] ? last[0] : first[0], y, z, box, level,
                          f);
        test(starts_[number_of_cell(items_[i])], i, box, level, f);
    }
    /// Visits the cells from x to `last`.
    template <class F>
    void visit_row(std::int64_t x, std::int64_t last, std::int64_t y, std::int64_t z,
                   const Bounds& box, const Level& level, F& f) const {
        for (; x <= last; x = (x | (run - 1)) + 1) {
            const std::size_t number = number_of_run(level, x >> run_bits, y, z);
            const std::int64_t end = std::min(last, x | (run - 1));
            test(starts_[number + place_in_run(x)], starts_[number + place_in_run(end) + 1], box,
                 level, f);
        }
    }
    template <class F>
    void test(std::size_t begin, std::size_t end, const Bounds& box, const Level& level,
              F& f) const {
        for (std::size_t i = begin; i < end; ++i)
            if (items_[i].exponent == level.exponent && overlap(items_[i].box, box)) f(i);
    }

    std::size_t axes_ = 0;
    int finest_ = least_exponent;
    std::vector<Item> added_;
    std::vector<Item> items_;
    std::vector<Level> levels_;          ///< those that have boxes, from the finest to the coarsest
    std::vector<std::uint32_t> starts_;  ///< for each number, the first item of the cell
    std::vector<std::uint32_t> numbers_;  ///< for each of added_, its cell's number
    std::vector<double> per_cell_;        ///< of each exponent, from the least; 0 if no box has it
    std::size_t mask_ = 0;                ///< of the numbers of runs
};

}  // namespace oiler
