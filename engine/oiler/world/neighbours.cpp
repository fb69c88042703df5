// SPDX-License-Identifier: MIT
#include "oiler/world/neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "oiler/sim/bodies.hpp"
#include "oiler/world/search_ball.hpp"

namespace oiler {
namespace {

constexpr std::size_t most_samples = 256;

/// Half the extent of the inner three quarters of the bodies along an axis, from a sample, m. A few
/// bodies far away do not change it.
double half_extent(const Bodies& bodies, int axis) {
    const std::size_t samples = std::min(most_samples, bodies.size());
    std::array<double, most_samples> sample;
    auto end = sample.begin();
    for (std::size_t i = 0; i < samples; ++i) {
        const double place = bodies.position(i * bodies.size() / samples)[axis];
        if (std::isfinite(place)) *end++ = place;
    }
    if (end == sample.begin()) return 0;
    std::sort(sample.begin(), end);
    const auto eighth = (end - sample.begin()) / 8;
    return *(end - 1 - eighth) / 2 - *(sample.begin() + eighth) / 2;
}

/// The exponent of cells, 2^exponent m wide, that hold about one body each if the bodies are spread
/// evenly. An axis along which all bodies are within one cell does not count.
int exponent_of_spacing(const Bodies& bodies) {
    std::array<double, 3> extents;
    extents.fill(-INFINITY);
    for (int axis = 0; axis < bodies.axes(); ++axis)
        extents[static_cast<std::size_t>(axis)] = std::log2(half_extent(bodies, axis));
    std::sort(extents.begin(), extents.end(), std::greater<>());
    double exponent = BoxGrid::least_exponent;
    double volume = -std::log2(static_cast<double>(bodies.size()));
    int axes = 0;
    for (const double next : extents)
        if (next > exponent) exponent = (volume += next) / ++axes;
    return static_cast<int>(std::max(std::ceil(exponent), double{BoxGrid::least_exponent}));
}

}  // namespace

void Neighbours::update(const World& world) {
    const Bodies& bodies = world.bodies();
    axes_ = bodies.axes();
    entities_.clear();
    grid_.clear(axes_, exponent_of_spacing(bodies));
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        entities_.push_back(world.entity_of_row(row));
        grid_.add({bodies.position(row), bodies.position(row)}, static_cast<std::uint32_t>(row));
    }
    grid_.build();
}

std::vector<Entity> Neighbours::within(const Vec3& point, double radius) const {
    const SearchBall ball(point, radius, axes_);
    std::vector<std::uint32_t> rows;
    grid_.for_each_overlap(ball.bounds(), [&](std::size_t i) {
        const BoxGrid::Item& item = grid_.items()[i];
        if (ball.contains(item.box.low)) rows.push_back(item.id);
    });
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    std::vector<Entity> entities;
    entities.reserve(rows.size());
    for (const std::uint32_t row : rows) entities.push_back(entities_[row]);
    return entities;
}

}  // namespace oiler
