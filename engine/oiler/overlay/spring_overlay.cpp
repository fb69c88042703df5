// SPDX-License-Identifier: MIT
#include "oiler/overlay/spring_overlay.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/game/look.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

constexpr std::size_t most_springs = 10'000;

double length(const Vec3& a) { return std::hypot(a[0], a[1], a[2]); }

DrawnSpring::End end_at(const World& world, std::size_t row) {
    return {world.entity_of_row(row), world.position_of_row(row)};
}

/// Adds the springs from the body in a row to their anchors.
void add_anchored(const World& world, std::size_t row, std::vector<DrawnSpring>& springs) {
    const Bodies& bodies = world.bodies();
    for (std::size_t i = 0; i < bodies.most_forces_of_a_kind(); ++i) {
        const GivenForces forces = bodies.forces_per_mass(row, i);
        if (const auto& spring = std::get<std::optional<Spring>>(forces);
            spring && spring->stiffness != 0)
            springs.push_back({{{}, spring->anchor}, end_at(world, row)});
        if (const auto& coil = std::get<std::optional<CoilSpring>>(forces);
            coil && coil->stiffness != 0)
            springs.push_back({{{}, coil->anchor}, end_at(world, row), coil->rest_length});
    }
}

/// The largest value of those added, but at most twice their root mean square.
class Spread {
public:
    void add(double value) {
        largest_ = std::max(largest_, std::abs(value));
        squares_ += value * value;
        count_ += 1;
    }
    [[nodiscard]] double value() const {
        return count_ == 0 ? 0 : std::min(largest_, 2 * std::sqrt(squares_ / count_));
    }

private:
    double largest_ = 0;
    double squares_ = 0;
    double count_ = 0;
};

bool is_same(const DrawnSpring& a, const DrawnSpring& b) {
    return a.from.body == b.from.body && a.to.body == b.to.body;
}

DrawnSpring::End mix(const DrawnSpring::End& from, const DrawnSpring::End& to, double alpha) {
    return {to.body, from.at + (to.at - from.at) * alpha};
}

}  // namespace

double DrawnSpring::stretch() const { return length(to.at - from.at) - rest_length; }

std::vector<DrawnSpring> springs_of(const World& world) {
    std::vector<DrawnSpring> springs;
    const Bodies& bodies = world.bodies();
    for (std::size_t i = 0; i < std::min(bodies.link_count(), most_springs); ++i) {
        const LinkEnds ends = bodies.link_ends(i);
        springs.push_back(
            {end_at(world, ends.row),
             ends.other ? end_at(world, *ends.other) : DrawnSpring::End{{}, ends.point},
             bodies.link_at(i).rest_length});
    }
    for (std::size_t row = 0; row < std::min(bodies.size(), most_springs); ++row)
        add_anchored(world, row, springs);
    return springs;
}

std::vector<DrawnSpring> between(const std::vector<DrawnSpring>& before,
                                 const std::vector<DrawnSpring>& after, double alpha) {
    if (!std::ranges::equal(before, after, is_same)) return after;
    std::vector<DrawnSpring> springs = after;
    for (std::size_t i = 0; i < springs.size(); ++i) {
        springs[i].from = mix(before[i].from, after[i].from, alpha);
        springs[i].to = mix(before[i].to, after[i].to, alpha);
    }
    return springs;
}

FullColour full_colour(const std::vector<DrawnSpring>& springs) {
    Spread strain;
    Spread stretch;
    for (const DrawnSpring& spring : springs)
        spring.has_strain() ? strain.add(spring.stretch() / spring.rest_length)
                            : stretch.add(spring.stretch());
    return {strain.value(), stretch.value()};
}

Colour colour_of_strain(double strain) {
    const auto share = static_cast<float>(std::clamp(std::abs(strain), 0.0, 1.0));
    return palette::mix(palette::grey, strain < 0 ? palette::blue : palette::vermilion, share);
}

void add_springs(Picture& picture, const DrawnBodies& bodies,
                 const std::vector<DrawnSpring>& springs, const FullColour& full) {
    constexpr std::size_t few = 500;
    const float width = springs.size() < few ? 2 : 0.8F;
    const auto place = [&](const DrawnSpring::End& end) {
        const DrawnBodies::Body* const body = end.body ? bodies.find(*end.body) : nullptr;
        return body ? body->centre : to_point(end.at);
    };
    for (const DrawnSpring& spring : springs) {
        const double whole = spring.has_strain() ? full.strain * spring.rest_length : full.stretch;
        picture.polylines.push_back(
            {.points = {place(spring.from), place(spring.to)},
             .width = width,
             .colour = colour_of_strain(whole > 0 ? spring.stretch() / whole : 0)});
    }
}

}  // namespace oiler
