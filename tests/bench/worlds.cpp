// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "bench/bench.hpp"
#include "bench/scenes.hpp"

namespace oiler::bench {
namespace {

Work steps_of(World& world) {
    return [&world](long times) {
        for (long i = 0; i < times; ++i) world.step(1);
    };
}

Settings in_float() { return {.stepping = {.rate = rate, .precision = Precision::single}}; }

/// Springs with the stiffness and damping of a game, from 1 m.
World swinging(std::size_t bodies) {
    World world(3, in_float());
    reserve(world, bodies);
    for (std::size_t i = 0; i < bodies; ++i)
        world.spawn({.position = within({1, 0.5 + static_cast<double>(i % 64) / 128, -1}, 3)},
                    Spring{.stiffness = 40, .damping = 0.8});
    return world;
}

/// Those springs after many steps: copies of a few that were stepped.
World settled(std::size_t bodies, std::int64_t steps) {
    World few = swinging(64);
    few.step(steps);
    World world(3, in_float());
    reserve(world, bodies);
    for (std::size_t i = 0; i < bodies; ++i)
        world.spawn(
            {.position = few.bodies().position(i % 64), .velocity = few.bodies().velocity(i % 64)},
            Spring{.stiffness = 40, .damping = 0.8});
    return world;
}

}  // namespace

void bench_settled(Bench& bench) {
    if (!bench.wants("settled")) return;
    constexpr std::size_t bodies = 100'000;
    const std::int64_t steps = bench.full ? 1'000'000 : 300'000;
    World moving = swinging(bodies);
    World still = settled(bodies, steps);
    const std::vector<double> seconds = race({steps_of(moving), steps_of(still)}, bench.effort);
    const double at_first = Bench::ns(seconds[0], bodies);
    const double later = Bench::ns(seconds[1], bodies);
    bench.report.target({.id = "T7",
                         .what = fmt::format("10⁵ springs after {} steps", in_powers(steps)),
                         .measured = later / at_first,
                         .limit = 1.1,
                         .remark = fmt::format("{:.3f} ns, at first {:.3f} ns", later, at_first)});
}

void bench_threads(Bench& bench) {
    if (!bench.wants("threads")) return;
    if constexpr (!has_threads<Settings>) {
        bench.report.missing("threads: the engine has no setting for them");
        return;
    }
    for (const std::size_t bodies : {1000, 4000, 10'000, 100'000, 1'000'000}) {
        World alone = make_world(Scene::springs, 3, bodies, with_threads(in_float(), 1));
        World team = make_world(Scene::springs, 3, bodies, with_threads(in_float(), 2));
        const std::vector<double> seconds = race({steps_of(alone), steps_of(team)}, bench.effort);
        bench.report.add("Threads, µs per step of springs in float",
                         {in_powers(bodies), {{"1", seconds[0] * 1e6}, {"2", seconds[1] * 1e6}}});
        if (bodies > 10'000) continue;
        const double overhead = (seconds[1] - seconds[0] / 2) * 1e6;
        bench.report.target({.id = "T3",
                             .what = fmt::format("fork and join, {} bodies", in_powers(bodies)),
                             .measured = overhead,
                             .unit = "µs",
                             .limit = 1,
                             .remark = fmt::format("two threads {:.2f} µs, half of one's {:.2f} µs",
                                                   seconds[1] * 1e6, seconds[0] / 2 * 1e6)});
    }
}

}  // namespace oiler::bench
