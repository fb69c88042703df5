// SPDX-License-Identifier: MIT
#include "oiler/sim/store/box_grid.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace oiler {
namespace {

constexpr int greatest_exponent = 1025;

/// The exponent of the smallest cells that are wider than the box; none if it is not finite.
std::optional<int> exponent_of(const Bounds& box) {
    if (!std::isfinite(larger(largest(box.low), largest(box.high)))) return std::nullopt;
    const double half = std::max(largest(box.high / 2 - box.low / 2), 0x1p-1002);
    return static_cast<int>(std::bit_cast<std::uint64_t>(half) >> 52) - 1021;
}

}  // namespace

void BoxGrid::clear(int axes, int finest) {
    axes_ = static_cast<std::size_t>(axes);
    finest_ = std::clamp(finest, least_exponent, greatest_exponent);
    added_.clear();
    per_cell_.assign(greatest_exponent - least_exponent + 1, 0);
}

void BoxGrid::add(const Bounds& box, std::uint32_t id) {
    const std::optional<int> least = exponent_of(box);
    if (!least) return;
    const int exponent = std::max(*least, finest_);
    double& per_cell = per_cell_[static_cast<std::size_t>(exponent - least_exponent)];
    if (per_cell == 0) per_cell = std::ldexp(1.0, -exponent);
    added_.push_back({box, id, exponent});
}

void BoxGrid::build() {
    list_levels();
    count_cells();
    items_.resize(added_.size());
    for (std::size_t i = added_.size(); i-- > 0;) items_[--starts_[numbers_[i]]] = added_[i];
}

void BoxGrid::list_levels() {
    levels_.clear();
    for (std::size_t i = 0; i < per_cell_.size(); ++i)
        if (per_cell_[i] != 0)
            levels_.push_back({least_exponent + static_cast<int>(i), per_cell_[i]});
}

/// Leaves in `starts_` the end of each cell's items.
void BoxGrid::count_cells() {
    mask_ = std::bit_ceil(added_.size()) - 1;
    starts_.assign(mask_ + run + 2, 0);
    numbers_.clear();
    for (const Item& item : added_) {
        const std::size_t number = number_of_cell(item);
        numbers_.push_back(static_cast<std::uint32_t>(number));
        ++starts_[number];
    }
    std::uint32_t end = 0;
    for (std::uint32_t& start : starts_) start = end += start;
}

std::size_t BoxGrid::number_of_cell(const Item& item) const {
    const double per_cell = per_cell_[static_cast<std::size_t>(item.exponent - least_exponent)];
    const auto [x, y, z] = cell_of(item.box.low, per_cell);
    return number_of_run({item.exponent, per_cell}, x >> run_bits, y, z) + place_in_run(x);
}

Bounds bounds_of_path(const Vec3& start, const Vec3& end, double radius) {
    constexpr double largest_number = std::numeric_limits<double>::max();
    Bounds box;
    for (int i = 0; i < 3; ++i) {
        const double margin =
            0x1p-50 * radius + 0x1p-50 * std::abs(start[i]) + 0x1p-50 * std::abs(end[i]);
        box.low[i] = std::max(std::min(start[i], end[i]) - radius - margin, -largest_number);
        box.high[i] = std::min(std::max(start[i], end[i]) + radius + margin, largest_number);
    }
    return box;
}

}  // namespace oiler
