// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/bench.hpp"
#include "bench/limits.hpp"
#include "bench/scenes.hpp"
#include "oiler/core/error.hpp"

namespace oiler::bench {
namespace {

/// The bandwidth of one level of memory, in bytes per ns = GB/s.
void measure_place(Bench& bench, const std::string& place, std::size_t rows) {
    const HandBodies<float> swept(3, rows);
    const std::vector<float> numbers(swept.scene().rows * 6);
    const HandLoops<float>& loops = bench.limits.loops<float>();
    float factor = 1;
    const auto read = repeated([&] { keep(loops.read(numbers.data(), numbers.size())); });
    const auto sweep = repeated([&] {
        keep(factor);
        loops.sweep(swept.scene(), factor);
    });
    const std::vector<double> seconds = race({read, sweep}, bench.effort);
    const double bytes = static_cast<double>(numbers.size() * sizeof(float));
    bench.report.add("Bandwidth of one core, GB/s",
                     {place,
                      {{"read", bytes / seconds[0] * 1e-9},
                       {"read and write in place", 2 * bytes / seconds[1] * 1e-9}}});
}

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

#define OILER_BENCH_DECLARE(isa)              \
    namespace isa {                           \
    extern const HandLoops<float> in_float;   \
    extern const HandLoops<double> in_double; \
    }
OILER_BENCH_DECLARE(sse2)
OILER_BENCH_DECLARE(avx2)
OILER_BENCH_DECLARE(avx512)
#undef OILER_BENCH_DECLARE

std::vector<Limits> supported_limits() {
    std::vector<Limits> all{{"SSE2", &sse2::in_float, &sse2::in_double}};
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("bmi2"))
        all.push_back({"AVX2", &avx2::in_float, &avx2::in_double});
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
        all.push_back({"AVX-512", &avx512::in_float, &avx512::in_double});
    return all;
}

void bench_limits(Bench& bench) {
    if (!bench.wants("bandwidth")) return;
    measure_place(bench, "L1, 24 KB", 1024);
    measure_place(bench, "L2, 480 KB", 20'480);
    measure_place(bench, fmt::format("memory, {} MB", bench.memory_bodies() * 24 / 1'000'000),
                  bench.memory_bodies());
}

void bench_agreement(Bench& bench) {
    if (!bench.wants("agreement")) return;
    for (const Scene scene : {Scene::projectiles, Scene::springs}) {
        agree<float>(bench, scene);
        agree<double>(bench, scene);
    }
}

}  // namespace oiler::bench
