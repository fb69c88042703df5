// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/samples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "oiler/core/error.hpp"
#include "oiler/core/random.hpp"
#include "oiler/lab/reference/scales.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/stability/obstacle_gap.hpp"

namespace oiler::lab {
namespace {

constexpr std::int64_t most_followed_bodies = 100'000;
constexpr double longest_scene = 100'000;  // s
constexpr double fewest_per_second = 60;
constexpr double fewest_samples = 20;
/// The limit of bodies × samples, which are kept in memory several times.
constexpr double most_kept = 1.5e6;

constexpr double touching = 1e-9;  // m

/// Whether obstacles other than planes keep a perturbed body where it was: it touched one of them,
/// or would do so now.
bool is_kept_by(const std::vector<Obstacle>& obstacles, const Bodies& bodies, std::size_t row,
                const Vec3& perturbed) {
    const auto contact = bodies.contact(row);
    return contact && std::ranges::any_of(obstacles, [&](const Obstacle& one) {
               const auto is_near = [&](const Vec3& x) {
                   return gap(one.shape, x, contact->radius, bodies.axes()) <= touching;
               };
               return is_near(bodies.position(row)) || is_near(perturbed);
           });
}

std::vector<Obstacle> bounded_obstacles(const Bodies& bodies) {
    std::vector<Obstacle> bounded;
    for (const ObstacleHandle handle : bodies.obstacles()) {
        Obstacle one = bodies.obstacle(handle);
        if (one.solid && !std::holds_alternative<HalfSpaceShape>(one.shape))
            bounded.push_back(std::move(one));
    }
    return bounded;
}

/// Keeps a perturbed body on the planes that it touches, and out of the others: a body that slides
/// must not bounce.
void keep_on_planes(const Bodies& bodies, std::size_t row, State<double, 3>& state) {
    const auto contact = bodies.contact(row);
    if (!contact) return;
    for (const Plane& plane : bodies.planes(contact->meets)) {
        const double size = length(plane.normal);
        const Vec3 normal = plane.normal * (1 / size);
        const double least = plane.offset / size + contact->radius;
        const bool touches = dot(normal, bodies.position(row)) - least <= touching;
        const double gap = dot(normal, state.x) - least;
        if (touches || gap < 0) state.x = state.x - normal * gap;
        if (touches) state.v = state.v - normal * dot(normal, state.v - bodies.velocity(row));
    }
}

}  // namespace

World make_world(const Scene& scene, const Settings& settings, const Perturbation& perturbation) {
    World world = make_world(scene, settings);
    if (perturbation.seed == 0) return world;
    Random random(Random::mixed(perturbation.seed));
    const auto moved = [&](Vec3 vector, double most) {
        for (int axis = 0; axis < scene.axes; ++axis)
            vector[axis] += most * (2 * random.fraction() - 1);
        return vector;
    };
    const std::vector<Obstacle> bounded = bounded_obstacles(world.bodies());
    for (std::size_t row = 0; row < world.body_count(); ++row) {
        const Entity entity = world.entity_of_row(row);
        State<double, 3> state{moved(world.position(entity), perturbation.position),
                               moved(world.velocity(entity), perturbation.velocity)};
        keep_on_planes(world.bodies(), row, state);
        if (is_kept_by(bounded, world.bodies(), row, state.x)) continue;
        world.teleport(entity, state.x);
        world.set_velocity(entity, state.v);
    }
    return world;
}

Bodies make_exact_bodies(const Scene& scene, const Perturbation& perturbation) {
    const Stepping exact{scene.stepping.method, scene.stepping.rate, Precision::extended};
    return make_world(scene, Settings{exact}, perturbation).bodies();
}

void require_measurable(const Scene& scene) {
    const std::int64_t bodies = scene.body_count();
    if (bodies > most_followed_bodies)
        fail(Exit::usage,
             "{} bodies: at most {} can be compared with a reference; take a scene with fewer "
             "bodies of the same kind",
             bodies, most_followed_bodies);
    if (!(scene.duration > 0) || scene.duration > longest_scene)
        fail(Exit::usage, "a duration of {} s cannot be measured: give --duration from 0 to {:g} s",
             scene.duration, longest_scene);
}

SampleTimes sample_times_of(const Scene& scene, const Bodies& start, const Density& density) {
    const double periods = fastest_motion(start) / (2 * std::numbers::pi);
    const double wanted =
        density.times * std::max({fewest_per_second, fewest_samples / scene.duration,
                                  density.per_period * periods});
    const double in_memory = most_kept / static_cast<double>(density.bodies) / scene.duration;
    const double most = std::floor(std::min(in_memory, density.most_per_second));
    SampleTimes samples{.per_second = std::llround(std::max(1.0, std::min(wanted, most)))};
    const double intervals = scene.duration * static_cast<double>(samples.per_second);
    samples.count = static_cast<std::int64_t>(std::ceil(intervals * (1 - 1e-12))) + 1;
    return samples;
}

Follower::Follower(const Scene& scene, const Settings& settings, const Perturbation& start,
                   std::int64_t samples_per_second)
    : world_(make_world(scene, settings, start)),
      steps_per_sample_(settings.stepping.rate.steps / samples_per_second) {
    world_.require_applicable();
}

bool Follower::go_to(std::int64_t sample) {
    const std::int64_t steps = sample * steps_per_sample_ - world_.tick();
    if (steps > 0) divergence_ = world_.try_step(steps);
    return !divergence_;
}

RunWork::RunWork(const Scene& scene)
    : StepWork(make_world(scene, Settings{scene.stepping}).bodies()) {}

}  // namespace oiler::lab
