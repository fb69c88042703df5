// SPDX-License-Identifier: MIT
#include "oiler/overlay/motion_overlay.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "oiler/core/length_text.hpp"
#include "oiler/game/look.hpp"
#include "oiler/overlay/overlays.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"
#include "oiler/picture/theme.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

State<double, 3> state_of(const Bodies& bodies, std::size_t row) {
    return {bodies.position(row), bodies.velocity(row)};
}

Vec3 acceleration_by_forces(const Bodies& bodies, std::size_t row, double time) {
    const State<double, 3> state = state_of(bodies, row);
    Vec3 sum{};
    for_each_force_on(bodies, row, [&](const auto& force) {
        if (acts(force)) sum = sum + accelerate(force, state, time);
    });
    return sum;
}

double length(const Vec3& a) { return std::hypot(a[0], a[1], a[2]); }

/// The force, N, of a link on its first end.
Vec3 force_of(const Bodies& bodies, std::size_t link) {
    const LinkEnds ends = bodies.link_ends(link);
    const Link numbers = bodies.link_at(link);
    const State<double, 3> first = state_of(bodies, ends.row);
    const State<double, 3> other =
        ends.other ? state_of(bodies, *ends.other) : State<double, 3>{ends.point, {}};
    const State<double, 3> between{first.x - other.x, first.v - other.v};
    if (numbers.pulls_only && length(between.x) <= numbers.rest_length) return {};
    if (numbers.rest_length == 0)
        return between.x * -numbers.stiffness - between.v * numbers.damping;
    return CoilSpring{{}, numbers.stiffness, numbers.damping, numbers.rest_length}.accelerate(
        between, 0);
}

constexpr std::size_t most_springs = 10'000;

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

/// The largest added value, but at most twice the root mean square.
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

constexpr std::size_t most_bodies_shown = 100;
constexpr double longest_arrow = 0.2;  // of the picture's height

std::vector<Entity> bodies_to_show(const World& world, const std::optional<Entity>& followed) {
    std::vector<Entity> bodies;
    const std::size_t count = std::min(world.body_count(), most_bodies_shown);
    for (std::size_t row = 0; row < count; ++row) bodies.push_back(world.entity_of_row(row));
    if (followed && world.has_body(*followed) && world.row(*followed) >= count)
        bodies.push_back(*followed);
    return bodies;
}

/// The smallest of 1, 2 and 5 times a power of ten that is at least `value`; 1 for 0.
double round_up(double value) {
    if (!(value > 0) || !std::isfinite(value)) return 1;
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (digit * power >= value) return digit * power;
    return 10 * power;
}

}  // namespace

std::vector<BodyMotion> motions_of(const World& world, const std::vector<Entity>& bodies) {
    const Bodies& all = world.bodies();
    std::vector<BodyMotion> motions;
    std::unordered_map<std::size_t, std::size_t> place_of_row;
    for (const Entity body : bodies) {
        const std::size_t row = world.row(body);
        place_of_row[row] = motions.size();
        motions.push_back({body, all.position(row), all.velocity(row),
                           acceleration_by_forces(all, row, world.time())});
    }
    const auto push = [&](std::size_t row, const Vec3& force) {
        if (const auto found = place_of_row.find(row); found != place_of_row.end()) {
            Vec3& sum = motions[found->second].acceleration;
            sum = sum + force / all.mass(row);
        }
    };
    for (std::size_t i = 0; i < all.link_count(); ++i) {
        const LinkEnds ends = all.link_ends(i);
        const bool is_wanted =
            place_of_row.contains(ends.row) || (ends.other && place_of_row.contains(*ends.other));
        if (!is_wanted) continue;
        const Vec3 force = force_of(all, i);
        push(ends.row, force);
        if (ends.other) push(*ends.other, -force);
    }
    return motions;
}

std::vector<BodyMotion> between(const std::vector<BodyMotion>& before,
                                const std::vector<BodyMotion>& after, double alpha) {
    const auto mix = [&](const Vec3& from, const Vec3& to) { return from + (to - from) * alpha; };
    std::vector<BodyMotion> motions;
    for (const BodyMotion& to : after) {
        const auto from = std::ranges::find(before, to.body, &BodyMotion::body);
        if (from == before.end()) continue;
        motions.push_back({to.body, mix(from->position, to.position),
                           mix(from->velocity, to.velocity),
                           mix(from->acceleration, to.acceleration)});
    }
    return motions;
}

double largest(const std::vector<BodyMotion>& motions, Vec3 BodyMotion::*vector) {
    double most = 0;
    for (const BodyMotion& motion : motions) {
        const Vec3& one = motion.*vector;
        most = std::max(most, std::hypot(one[0], one[1], one[2]));
    }
    return most;
}

void add_arrows(Picture& picture, const DrawnBodies& bodies, const std::vector<BodyMotion>& motions,
                Vec3 BodyMotion::*vector, double per_metre, Colour colour) {
    const float width = 2 * picture.camera.height / canvas_height;
    for (const BodyMotion& motion : motions) {
        const DrawnBodies::Body* const body = bodies.find(motion.body);
        const Point from = body ? body->centre : to_point(motion.position);
        const Point way = to_point(motion.*vector / per_metre);
        if (!std::isfinite(way.x) || !std::isfinite(way.y)) continue;
        picture.polygons.push_back({.points = arrow(from, {from.x + way.x, from.y + way.y}, width),
                                    .colour = colour,
                                    .layer = overlay_layer});
    }
}

double DrawnSpring::stretch() const {
    const double stretch = length(to.at - from.at) - rest_length;
    return pulls_only ? std::max(stretch, 0.0) : stretch;
}

std::vector<DrawnSpring> springs_of(const World& world) {
    std::vector<DrawnSpring> springs;
    const Bodies& bodies = world.bodies();
    for (std::size_t i = 0; i < std::min(bodies.link_count(), most_springs); ++i) {
        const LinkEnds ends = bodies.link_ends(i);
        springs.push_back(
            {end_at(world, ends.row),
             ends.other ? end_at(world, *ends.other) : DrawnSpring::End{{}, ends.point},
             bodies.link_at(i).rest_length, bodies.link_at(i).pulls_only});
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

void MotionOverlay::add(Picture& picture, const World& world, const Shown& shown,
                        const Frame& frame) {
    if (shown == Shown{}) {
        *this = {};
        return;
    }
    sample(world, shown, bodies_to_show(world, frame.followed));
    const DrawnBodies drawn(picture);
    double alpha = 1;
    if (before_ && after_->time > before_->time)
        alpha = std::clamp((frame.time - before_->time) / (after_->time - before_->time), 0.0, 1.0);
    if (shown.springs) add_springs_at(picture, drawn, alpha);
    if (shown.trails) {
        trails_.add(drawn, world, bodies_, frame.ghosts, frame.time);
        trails_.draw(picture, frame.factor);
    }
    if (!shown.velocities && !shown.accelerations) return;
    const std::vector<BodyMotion> motions =
        before_ ? between(before_->motions, after_->motions, alpha) : after_->motions;
    const double length = longest_arrow * static_cast<double>(picture.camera.height);
    scales_.velocity = round_up(largest_.speed / length);
    scales_.acceleration = round_up(largest_.acceleration / length);
    if (shown.accelerations)
        add_arrows(picture, drawn, motions, &BodyMotion::acceleration, scales_.acceleration,
                   theme_of(picture.background).ink);
    if (shown.velocities)
        add_arrows(picture, drawn, motions, &BodyMotion::velocity, scales_.velocity,
                   Inspected::Scales::colour_of_velocity);
}

void MotionOverlay::sample(const World& world, const Shown& shown,
                           const std::vector<Entity>& bodies) {
    const bool is_back = after_ && world.time() < after_->time;
    if (is_back) largest_ = {};
    if (shown != shown_ || bodies != bodies_ || is_back) {
        before_.reset();
        after_.reset();
    }
    if (!shown.trails) trails_.clear();
    shown_ = shown;
    bodies_ = bodies;
    if (after_ && after_->time == world.time()) return;
    before_ = std::exchange(after_, Sample{.time = world.time()});
    scales_.bodies = bodies.size() < world.body_count() ? bodies.size() : 0;
    if (shown.velocities || shown.accelerations) {
        after_->motions = motions_of(world, bodies);
        largest_.speed = std::max(largest_.speed, largest(after_->motions, &BodyMotion::velocity));
        largest_.acceleration =
            std::max(largest_.acceleration, largest(after_->motions, &BodyMotion::acceleration));
    }
    if (shown.springs) {
        after_->springs = springs_of(world);
        const FullColour now = full_colour(after_->springs);
        largest_.springs = {std::max(largest_.springs.strain, now.strain),
                            std::max(largest_.springs.stretch, now.stretch)};
    }
}

void MotionOverlay::add_springs_at(Picture& picture, const DrawnBodies& drawn, double alpha) {
    const FullColour& most = largest_.springs;
    const FullColour full{round_up(most.strain), round_up(most.stretch)};
    add_springs(picture, drawn,
                before_ ? between(before_->springs, after_->springs, alpha) : after_->springs,
                full);
    scales_.springs = after_->springs.size();
    scales_.strain = most.strain > 0 ? full.strain : 0;
    scales_.stretch = most.stretch > 0 ? length_text(full.stretch) : "";
}

}  // namespace oiler
