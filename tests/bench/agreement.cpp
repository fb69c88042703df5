// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/bench.hpp"
#include "bench/scenes.hpp"
#include "oiler/core/error.hpp"

namespace oiler::bench {
namespace {

constexpr int per_call = 256;

/// The largest difference between the engine and the hand-written loops, over the largest number.
template <class T>
double disagreement(const Bodies& bodies, const HandScene<T>& hand) {
    double difference = 0;
    double size = 0;
    for (std::size_t row = 0; row < bodies.size(); ++row)
        for (int a = 0; a < hand.axes; ++a) {
            const double x = static_cast<double>(hand.x[a][row]);
            const double v = static_cast<double>(hand.v[a][row]);
            difference = std::max({difference, std::abs(bodies.position(row)[a] - x),
                                   std::abs(bodies.velocity(row)[a] - v)});
            size = std::max({size, std::abs(x), std::abs(v)});
        }
    return difference / size;
}

template <class T>
void agree(Bench& bench, Scene scene) {
    constexpr std::size_t bodies = 1000;
    constexpr int rounds = 4;
    World world =
        make_world(scene, 3, bodies, {.stepping = {.rate = rate, .precision = precision_of<T>}});
    const HandBodies<T> one(3, bodies);
    const HandBodies<T> many(3, bodies);
    const HandLoops<T>& loops = bench.limits.loops<T>();
    const bool falls = scene == Scene::projectiles;
    for (int round = 0; round < rounds; ++round) {
        world.step(per_call);
        for (int i = 0; i < per_call; ++i) (falls ? loops.fall : loops.spring)(one.scene());
        (falls ? loops.fall_many : loops.spring_many)(many.scene(), per_call);
    }
    const double apart = disagreement(world.bodies(), one.scene());
    const double far_apart = disagreement(world.bodies(), many.scene());
    if (!(std::max(apart, far_apart) < 1e-3))
        fail(Exit::comparison_failed, "the hand-written loops and the engine differ on {}",
             name_of(scene));
    bench.report.add("Agreement after 1024 steps: largest difference over largest number",
                     {fmt::format("{}, {}", name_of(scene), name_of(precision_of<T>)),
                      {{"one step by hand", apart}, {"in registers", far_apart}}});
}

}  // namespace

void bench_agreement(Bench& bench) {
    if (!bench.wants("agreement")) return;
    for (const Scene scene : {Scene::projectiles, Scene::springs}) {
        agree<float>(bench, scene);
        agree<double>(bench, scene);
    }
}

}  // namespace oiler::bench
