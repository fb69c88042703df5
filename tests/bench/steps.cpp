// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>

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
    std::vector<Work> work{repeated([&] { world.step(1); }), repeated([&] {
                               keep(factor);
                               loops.sweep(swept.scene(), factor);
                           }),
                           repeated([&] { step(hand.scene()); })};
    if (with_many) {
        work.push_back(repeated([&] { far.step(per_call); }));
        work.push_back(repeated([&] { steps(held.scene(), per_call); }));
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
        bench.report.target({"T1", what + ": cost / hand-written loop", c.one / c.hand_one,
                             at_most(1.5), beside(c.one, "hand-written", c.hand_one)});
    else
        bench.report.target({"T1", what + ": speed / sweep", c.sweep / c.one, at_least(0.9),
                             beside(c.one, "sweep", c.sweep)});
    if (bodies <= 1'000'000)
        bench.report.target({"T2", what + ": cost / hand-written loop", c.many / c.hand_many,
                             at_most(1.3), beside(c.many, "hand-written", c.hand_many)});
}

/// Targets that the cost of many steps per call does not depend on the number of bodies.
void add_flatness(Bench& bench, Scene scene, const std::vector<double>& many) {
    if (many.empty()) return;
    const auto [least, most] = std::ranges::minmax(many);
    const double goal = scene == Scene::projectiles ? 1e10 : 4e9;
    bench.report.target({"T2", fmt::format("{}: most expensive N / cheapest", name_of(scene)),
                         most / least, at_most(1.15),
                         "10³ to 10⁶ bodies; 1.15 allows for the machine's noise"});
    bench.report.target({"T2", fmt::format("{}: body-steps per second (goal)", name_of(scene)),
                         1e9 / least, at_least(goal)});
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

/// The largest ratio of a method's cost to that of semi_implicit_euler, from memory.
struct Limit {
    std::string_view method;
    double most;
};
constexpr std::array limits{Limit{"rk4", 1.3}, Limit{"velocity_verlet", 1.1},
                            Limit{"rk2_midpoint", 1.1}, Limit{"exact", 1.1}};

/// The measured methods, semi_implicit_euler first. Implicit methods are slow and are measured over
/// few bodies only, except with --full.
std::vector<const Method*> chosen(const Bench& bench, std::size_t count) {
    std::vector<const Method*> all;
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk2_midpoint", "rk4",
                             "pefrl", "implicit_midpoint", "exact"})
        all.push_back(&find_method(name));
    if (bench.all_methods)
        for (const Method& method : methods())
            if (std::ranges::find(all, &method) == all.end()) all.push_back(&method);
    if (!bench.full && count > 100'000)
        std::erase_if(all, [](const Method* method) { return method->evaluations == 0; });
    return all;
}

/// ns per body and step of each method over the same bodies, `count` steps per call.
std::vector<double> race_methods(const Bench& bench, const std::vector<const Method*>& all,
                                 Bodies& bodies, int count) {
    std::vector<Work> work;
    for (const Method* method : all)
        work.push_back(repeated(
            [&bodies, method, count] { bodies.step(*method, {.rate = rate, .count = count}); }));
    Effort effort = bench.effort;
    effort.prepared = true;  // bodies keep a method's data until the next method
    std::vector<double> costs = race(work, effort);
    for (double& cost : costs) cost = Bench::ns(cost, static_cast<double>(bodies.size()) * count);
    return costs;
}

void add_targets(Bench& bench, const std::vector<const Method*>& all,
                 const std::vector<double>& costs, Scene scene, std::size_t bodies) {
    for (const Limit& limit : limits) {
        const auto at = std::ranges::find(all, limit.method, &Method::name) - all.begin();
        const double cost = costs[static_cast<std::size_t>(at)];
        bench.report.target(
            {"T3", fmt::format("{}, {}, {}", limit.method, name_of(scene), in_powers(bodies)),
             cost / costs.front(), at_most(limit.most),
             fmt::format("{:.2f} ns, semi_implicit_euler {:.2f} ns", cost, costs[0])});
    }
}

void measure(Bench& bench, Scene scene, Precision precision, int axes, std::size_t count) {
    const std::string name =
        fmt::format("{}, {}, {}", name_of(scene), columns(precision, axes), in_powers(count));
    if (!bench.wants("methods: " + name)) return;
    const std::vector<const Method*> all = chosen(bench, count);
    Bodies bodies = make_bodies(scene, axes, count, precision);
    const std::vector<double> one = race_methods(bench, all, bodies, 1);
    const bool races = count <= 100'000 || bench.full;
    const std::vector<double> many =
        races ? race_methods(bench, all, bodies, per_call) : std::vector<double>();
    for (std::size_t i = 0; i < all.size(); ++i) {
        Row row{std::string(all[i]->name), {{"one step", one[i]}}};
        if (races) row.numbers.emplace_back("256 at once", many[i]);
        bench.report.add("Methods, ns per body and step: " + name, std::move(row));
    }
    if (precision == Precision::single && axes == 3 && count == bench.memory_bodies())
        add_targets(bench, all, one, scene, count);
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

void bench_methods(Bench& bench) {
    for (const Scene scene : {Scene::projectiles, Scene::springs}) {
        if (!bench.full) {
            measure(bench, scene, Precision::single, 3, 1000);
            measure(bench, scene, Precision::single, 3, bench.memory_bodies());
            continue;
        }
        for (const Precision precision : {Precision::single, Precision::double_})
            for (const int axes : {1, 2, 3})
                for (const std::size_t count :
                     {std::size_t{1000}, std::size_t{10'000}, std::size_t{100'000},
                      std::size_t{1'000'000}, bench.memory_bodies()})
                    measure(bench, scene, precision, axes, count);
    }
}

}  // namespace oiler::bench
