// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "bench/bench.hpp"
#include "bench/scenes.hpp"

namespace oiler::bench {
namespace {

constexpr int per_call = 256;

/// ns per body and step.
struct Costs {
    double one;        ///< the engine, one step per call
    double sweep;      ///< one in-place sweep over the same bytes
    double hand_one;   ///< hand-written loop, one step per call
    double many;       ///< the engine, 256 steps per call; 0 if not measured
    double hand_many;  ///< hand-written loop in registers; 0 if not measured
};

template <class T>
Costs race_steps(const Bench& bench, Scene scene, int axes, std::size_t bodies, bool with_many) {
    World world =
        make_world(scene, axes, bodies, {.stepping = {.rate = rate, .precision = precision_of<T>}});
    World far = world;
    const HandBodies<T> swept(axes, bodies);
    const HandBodies<T> hand(axes, bodies);
    const HandBodies<T> held(axes, bodies);
    const HandLoops<T>& loops = bench.limits.loops<T>();
    const bool falls = scene == Scene::projectiles;
    const auto step = falls ? loops.fall : loops.spring;
    const auto steps = falls ? loops.fall_many : loops.spring_many;
    T factor = 1;
    const auto repeat = [](auto f) {
        return [=](long times) mutable {
            for (long i = 0; i < times; ++i) f();
        };
    };
    std::vector<Work> work{repeat([&] { world.step(1); }), repeat([&] {
                               keep(factor);
                               loops.sweep(swept.scene(), factor);
                           }),
                           repeat([&] { step(hand.scene()); })};
    if (with_many) {
        work.push_back(repeat([&] { far.step(per_call); }));
        work.push_back(repeat([&] { steps(held.scene(), per_call); }));
    }
    const std::vector<double> seconds = race(work, bench.effort);
    const auto each = [&](std::size_t i, int count) {
        return Bench::ns(seconds[i], static_cast<double>(bodies) * count);
    };
    return {each(0, 1), each(1, 1), each(2, 1), with_many ? each(3, per_call) : 0,
            with_many ? each(4, per_call) : 0};
}

std::string beside(double ours, std::string_view other, double theirs) {
    return fmt::format("{:.3f} ns, {} {:.3f} ns", ours, other, theirs);
}

void add_targets(Bench& bench, Scene scene, std::size_t bodies, const Costs& c) {
    const std::string what = fmt::format("{}, {}", name_of(scene), in_powers(bodies));
    if (bodies < 10'000)
        bench.report.target({.id = "T1",
                             .what = what + ": cost / hand-written loop",
                             .measured = c.one / c.hand_one,
                             .limit = 1.5,
                             .remark = beside(c.one, "hand-written", c.hand_one)});
    else
        bench.report.target({.id = "T1",
                             .what = what + ": speed / sweep",
                             .measured = c.sweep / c.one,
                             .wanted = Wanted::at_least,
                             .limit = 0.9,
                             .remark = beside(c.one, "sweep", c.sweep)});
    if (bodies <= 1'000'000)
        bench.report.target({.id = "T2",
                             .what = what + ": cost / hand-written loop",
                             .measured = c.many / c.hand_many,
                             .limit = 1.3,
                             .remark = beside(c.many, "hand-written", c.hand_many)});
}

/// Targets that the cost of many steps per call does not depend on the number of bodies.
void add_flatness(Bench& bench, Scene scene, const std::vector<double>& many) {
    if (many.empty()) return;
    const auto [least, most] = std::ranges::minmax(many);
    const double goal = scene == Scene::projectiles ? 1e10 : 4e9;
    bench.report.target({.id = "T2",
                         .what = fmt::format("{}: most expensive N / cheapest", name_of(scene)),
                         .measured = most / least,
                         .limit = 1.15,
                         .remark = "10³ to 10⁶ bodies; 1.15 allows for the machine's noise"});
    bench.report.target({.id = "T2",
                         .what = fmt::format("{}: body-steps per second (goal)", name_of(scene)),
                         .measured = 1e9 / least,
                         .wanted = Wanted::at_least,
                         .limit = goal});
}

template <class T>
void measure(Bench& bench, Scene scene, int axes, const std::vector<std::size_t>& sizes) {
    const bool aimed_at = precision_of<T> == Precision::single && axes == 3;
    std::vector<double> many;
    for (const std::size_t bodies : sizes) {
        const std::string name = fmt::format("{}, {}, {}", name_of(scene),
                                             columns(precision_of<T>, axes), in_powers(bodies));
        if (!bench.wants("steps: " + name)) continue;
        const bool with_many = bodies <= 1'000'000 || bench.full;
        const Costs c = race_steps<T>(bench, scene, axes, bodies, with_many);
        Row row{name, {{"one step", c.one}, {"sweep", c.sweep}, {"hand-written", c.hand_one}}};
        if (with_many) {
            row.numbers.emplace_back("256 at once", c.many);
            row.numbers.emplace_back("by hand, in registers", c.hand_many);
        }
        bench.report.add("Steps, ns per body and step", std::move(row));
        if (!aimed_at) continue;
        add_targets(bench, scene, bodies, c);
        if (bodies <= 1'000'000) many.push_back(c.many);
    }
    add_flatness(bench, scene, many);
}

}  // namespace

void bench_steps(Bench& bench) {
    const std::size_t memory = bench.memory_bodies();
    const std::vector<std::size_t> all{1000, 10'000, 100'000, 1'000'000, memory};
    const std::vector<std::size_t> some =
        bench.full ? all : std::vector<std::size_t>{1000, 100'000};
    for (const Scene scene : {Scene::projectiles, Scene::springs}) {
        measure<float>(bench, scene, 3, all);
        for (const int axes : {1, 2}) measure<float>(bench, scene, axes, some);
        for (const int axes : {1, 2, 3}) measure<double>(bench, scene, axes, some);
    }
}

}  // namespace oiler::bench
