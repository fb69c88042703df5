// SPDX-License-Identifier: MIT
#include "oiler/world/collisions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "oiler/sim/bodies.hpp"
#include "oiler/world/search_ball.hpp"

namespace oiler {

void Collisions::update(const World& world) {
    ++updates_;
    const Bodies& bodies = world.bodies();
    paths_.clear();
    grid_.clear(bodies.axes());
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (const auto contact = bodies.contact(row)) add_path(world, row, contact->radius);
    grid_.build();
    sorted_.clear();
    for (const BoxGrid::Item& item : grid_.items()) sorted_.push_back(paths_[item.id]);
    meets_.clear();
    grid_.for_each_pair([this](std::size_t i, std::size_t j) { meet(sorted_[i], sorted_[j]); });
    list_pairs(world);
}

void Collisions::add_path(const World& world, std::size_t row, double radius) {
    const Entity entity = world.entity_of_row(row);
    const Vec3 position = world.bodies().position(row);
    if (!std::isfinite(largest(position))) return;
    if (entity.index >= marks_.size()) marks_.resize(entity.index + std::size_t{1});
    Mark& mark = marks_[entity.index];
    const Mark now{position, updates_, entity.generation, world.jumps(entity)};
    const bool moved =
        mark.update + 1 == updates_ && mark.generation == now.generation && mark.jumps == now.jumps;
    const Vec3& start = moved ? mark.position : position;
    grid_.add(bounds_of_path(start, position, radius), static_cast<std::uint32_t>(paths_.size()));
    paths_.push_back({start, position, radius, static_cast<std::uint32_t>(row)});
    mark = now;
}

/// The distance is least where the relative position is normal to the relative path. From there,
/// Pythagoras' theorem leads back to the first touch. Points that meet do so within round-off.
void Collisions::meet(const Path& a, const Path& b) {
    constexpr double round_off = 8 * std::numeric_limits<double>::epsilon();
    // Quarters, because differences of differences may overflow.
    const Vec3 start = b.start * 0.25 - a.start * 0.25;
    const Vec3 end = b.end * 0.25 - a.end * 0.25;
    const double radii = a.radius * 0.25 + b.radius * 0.25;
    const double scale = scale_for_squares(std::max({largest(start), largest(end), radii}));
    const Vec3 before = start * scale;
    const Vec3 after = end * scale;
    const double reach = radii * scale;
    const bool touching = squared_length(after) <= reach * reach;
    if (squared_length(before) <= reach * reach) return add_meet(a, b, 0, touching);
    const Vec3 path = after - before;
    const double squared_path = squared_length(path);
    const double closest = -quotient_or_zero(dot(before, path), squared_path);
    const double least = length(before + path * closest);
    const bool crossing =
        closest > 0 && closest < 1 && least <= reach + round_off * largest(before);
    if (!touching && !crossing) return;
    const double depth = std::max(reach * reach - least * least, 0.0);
    const double first = closest - std::sqrt(depth / squared_path);
    add_meet(a, b, std::clamp(first, 0.0, 1.0), touching);
}

void Collisions::add_meet(const Path& a, const Path& b, double fraction, bool touching) {
    meets_.push_back({std::min(a.row, b.row), std::max(a.row, b.row), fraction, touching});
}

void Collisions::list_pairs(const World& world) {
    const auto rows = [](const Meet& meet) { return std::pair(meet.a, meet.b); };
    std::ranges::sort(meets_, {}, rows);
    const auto is_repeated = [&](const Meet& a, const Meet& b) { return rows(a) == rows(b); };
    meets_.erase(std::unique(meets_.begin(), meets_.end(), is_repeated), meets_.end());
    pairs_.clear();
    for (const Meet& meet : meets_)
        pairs_.push_back({world.entity_of_row(meet.a), world.entity_of_row(meet.b), meet.fraction,
                          meet.touching});
}

}  // namespace oiler
