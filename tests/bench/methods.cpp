// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bench/bench.hpp"
#include "bench/scenes.hpp"

namespace oiler::bench {
namespace {

constexpr int per_call = 256;

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
        work.push_back([&bodies, method, count](long times) {
            for (long i = 0; i < times; ++i) bodies.step(*method, {.rate = rate, .count = count});
        });
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
            {.id = "T3",
             .what = fmt::format("{}, {}, {}", limit.method, name_of(scene), in_powers(bodies)),
             .measured = cost / costs.front(),
             .limit = limit.most,
             .remark = fmt::format("{:.2f} ns, semi_implicit_euler {:.2f} ns", cost, costs[0])});
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
