// SPDX-License-Identifier: MIT
#include "oiler/lab/looks.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

constexpr std::int64_t most_followed_bodies = 100'000;
constexpr double longest = 100'000;  // s
constexpr double usual_looks_per_second = 60;
constexpr double fewest_looks = 20;
/// Of all bodies at all looks, which are kept in memory several times over.
constexpr double most_states = 400'000;

std::int64_t largest_divisor(std::int64_t number, std::int64_t most) {
    while (number % most != 0) --most;
    return most;
}

}  // namespace

Looks looks_of(const Scene& scene) {
    const std::int64_t bodies = scene.body_count();
    if (bodies > most_followed_bodies)
        fail(
            Exit::usage,
            "{} bodies are more than can be held against a reference ({}); take a scene with fewer "
            "of the same kind",
            bodies, most_followed_bodies);
    if (!(scene.duration > 0) || scene.duration > longest)
        fail(Exit::usage, "a duration of {} s cannot be measured: give --duration from 0 to {:g} s",
             scene.duration, longest);
    const double affordable =
        most_states / static_cast<double>(std::max<std::int64_t>(1, bodies)) / scene.duration;
    const double wanted = std::max(usual_looks_per_second, fewest_looks / scene.duration);
    const double most =
        std::clamp(std::min(affordable, wanted), 1.0, static_cast<double>(scene.rate));
    Looks looks{.per_second = largest_divisor(scene.rate, static_cast<std::int64_t>(most))};
    const double intervals = scene.duration * static_cast<double>(looks.per_second);
    looks.count = static_cast<std::int64_t>(std::floor(intervals * (1 + 1e-12))) + 1;
    if (looks.count < 2)
        fail(Exit::usage, "the scene ends within one of its steps: give a longer --duration");
    return looks;
}

Follower::Follower(const Scene& scene, const Settings& settings, std::int64_t looks_per_second)
    : world_(make_world(scene, settings)), looks_per_second_(looks_per_second) {
    world_.require_applicable();
}

bool Follower::go_to(std::int64_t look) try {
    const std::int64_t product = look * world_.settings().rate.steps;
    const std::int64_t tick = product / looks_per_second_;
    alpha_ = static_cast<long double>(product % looks_per_second_) /
             static_cast<long double>(looks_per_second_);
    if (world_.tick() < tick) world_.step(tick - world_.tick());
    if (alpha_ > 0 && before_tick_ != tick) {
        remember();
        world_.step();
    }
    return true;
} catch (const Error& error) {
    if (error.exit() != Exit::diverged) throw;
    return false;
}

void Follower::remember() {
    before_tick_ = world_.tick();
    before_.clear();
    for (std::size_t row = 0; row < bodies().size(); ++row) before_.push_back(bodies().state(row));
    energy_before_ = bodies().energy().total();
}

State<long double, 3> Follower::state(std::size_t row) const {
    const State<long double, 3> after = bodies().state(row);
    if (alpha_ == 0) return after;
    const State<long double, 3>& before = before_[row];
    return {before.x + (after.x - before.x) * alpha_, before.v + (after.v - before.v) * alpha_};
}

double Follower::energy() const {
    const double after = bodies().energy().total();
    if (alpha_ == 0) return after;
    return energy_before_ + (after - energy_before_) * static_cast<double>(alpha_);
}

}  // namespace oiler
