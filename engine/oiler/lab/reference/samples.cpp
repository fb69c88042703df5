// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/samples.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/core/error.hpp"

namespace oiler::lab {
namespace {

constexpr std::int64_t most_followed_bodies = 100'000;
constexpr double longest = 100'000;  // s
constexpr double usual_samples_per_second = 60;
constexpr double fewest_samples = 20;
/// The limit of bodies × samples, which are kept in memory several times.
constexpr double most_states = 400'000;
/// The limit of bodies × samples at 1 sample per second, above which a scene is refused.
constexpr double most_kept_states = 4e6;

std::int64_t largest_divisor(std::int64_t number, double most) {
    auto divisor = static_cast<std::int64_t>(std::clamp(most, 1.0, static_cast<double>(number)));
    while (number % divisor != 0) --divisor;
    return divisor;
}

/// The divisor of the rate with the smallest ratio to `wanted`. A rate below `wanted`/4 gives a
/// multiple of the rate; a rate without a divisor within a factor of 4 gives `wanted` itself.
std::int64_t sample_rate(std::int64_t rate, double wanted) {
    constexpr double far = 4;
    if (static_cast<double>(rate) * far < wanted)
        return rate * std::llround(wanted / static_cast<double>(rate));
    std::int64_t nearest = std::llround(wanted);
    double least = far * (1 + 1e-9);
    for (std::int64_t samples = 1;
         samples <= std::min<std::int64_t>(rate, std::llround(far * wanted)); ++samples) {
        const double ratio = static_cast<double>(samples) / wanted;
        const double times = std::max(ratio, 1 / ratio);
        if (rate % samples != 0 || times >= least) continue;
        nearest = samples;
        least = times;
    }
    return nearest;
}

}  // namespace

SampleTimes sample_times_of(const Scene& scene) {
    const std::int64_t bodies = scene.body_count();
    if (bodies > most_followed_bodies)
        fail(Exit::usage,
             "{} bodies: at most {} can be compared with a reference; take a scene with fewer "
             "bodies of the same kind",
             bodies, most_followed_bodies);
    if (!(scene.duration > 0) || scene.duration > longest)
        fail(Exit::usage, "a duration of {} s cannot be measured: give --duration from 0 to {:g} s",
             scene.duration, longest);
    if (scene.duration * static_cast<double>(scene.stepping.rate.steps) < 1)
        fail(Exit::usage, "the scene ends within one of its steps: give a longer --duration");
    const double affordable =
        most_states / static_cast<double>(std::max<std::int64_t>(1, bodies)) / scene.duration;
    const double wanted = std::max(usual_samples_per_second, fewest_samples / scene.duration);
    SampleTimes samples{
        .per_second = largest_divisor(sample_rate(scene.stepping.rate.steps, wanted), affordable)};
    const double states =
        static_cast<double>(bodies) * scene.duration * static_cast<double>(samples.per_second);
    if (states > most_kept_states)
        fail(Exit::usage, "{} bodies for {:g} s take too much memory: give --duration up to {:g}",
             bodies, scene.duration, scene.duration * most_kept_states / states);
    const double intervals = scene.duration * static_cast<double>(samples.per_second);
    samples.count = static_cast<std::int64_t>(std::floor(intervals * (1 + 1e-12))) + 1;
    return samples;
}

Follower::Follower(const Scene& scene, const Settings& settings, std::int64_t samples_per_second)
    : world_(make_world(scene, settings)), samples_per_second_(samples_per_second) {
    world_.require_applicable();
}

bool Follower::go_to(std::int64_t sample) {
    const std::int64_t product = sample * world_.settings().stepping.rate.steps;
    const std::int64_t tick = product / samples_per_second_;
    alpha_ = static_cast<long double>(product % samples_per_second_) /
             static_cast<long double>(samples_per_second_);
    if (world_.tick() < tick && world_.try_step(tick - world_.tick())) return false;
    if (alpha_ > 0 && before_tick_ != tick) {
        remember();
        if (world_.try_step()) return false;
    }
    return true;
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

}  // namespace oiler::lab
