// SPDX-License-Identifier: MIT
#include "oiler/overlay/motion_overlay.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "oiler/picture/palette.hpp"
#include "oiler/whatif/verdict.hpp"

namespace oiler {
namespace {

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
                   Inspected::Scales::colour_of_acceleration);
    if (shown.velocities)
        add_arrows(picture, drawn, motions, &BodyMotion::velocity, scales_.velocity,
                   Inspected::Scales::colour_of_velocity);
}

void MotionOverlay::sample(const World& world, const Shown& shown,
                           const std::vector<Entity>& bodies) {
    const bool is_back = after_ && world.time() < after_->time;
    if (is_back) largest_ = {};
    if (shown != shown_ || bodies != bodies_ || is_back) before_ = after_ = std::nullopt;
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
