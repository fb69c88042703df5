// SPDX-License-Identifier: MIT
#include "bench/nets.hpp"

#include <fmt/format.h>

#include <random>

#include "bench/bench.hpp"
#include "bench/scenes.hpp"

namespace oiler::bench {
namespace {

/// ns per spring and step. A pinned net hangs from two corners.
double cost(const Bench& bench, const Net& net, const Links& links, const Link& link,
            bool pinned = false) {
    World world = make_net(net, links, link);
    for (std::size_t i = 0; pinned && i < 2; ++i) {
        const Entity corner = world.entity_of_row(i * (net.side - 1));
        world.link_to_point(corner, world.position(corner), link);
    }
    const std::vector<double> seconds = race({[&](long times) {
                                                 for (long i = 0; i < times; ++i) world.step(1);
                                             }},
                                             bench.effort);
    return Bench::ns(seconds[0], static_cast<double>(links.size()));
}

constexpr Link damped{.stiffness = 50, .damping = 0.5, .rest_length = 1};
constexpr Link undamped{.stiffness = 50, .rest_length = 1};
constexpr Link no_length{.stiffness = 5, .damping = 0.1};
/// Links between random bodies: four springs per body on average, some have many more.
constexpr Link gentle{.stiffness = 5, .damping = 0.1, .rest_length = 1};

void measure(Bench& bench, std::size_t side, double most) {
    const std::string name = fmt::format("{0} × {0}", side);
    if (!bench.wants("nets: " + name)) return;
    const Net net{side};
    const double with = cost(bench, net, net.links(), damped);
    const double pinned = cost(bench, net, net.links(), damped, true);
    const double random = cost(bench, net, net.random_links(), gentle);
    bench.report.add("Nets, ns per spring and step",
                     {name,
                      {{"rest length and damping", with},
                       {"hung from two corners", pinned},
                       {"rest length", cost(bench, net, net.links(), undamped)},
                       {"damping", cost(bench, net, net.links(), no_length)},
                       {"between any two", random}}});
    bench.report.target({.id = "T5", .what = name, .measured = with, .unit = "ns", .limit = most});
    bench.report.target({.id = "T5",
                         .what = name + ", hung from two corners / not",
                         .measured = pinned / with,
                         .limit = 1.05});
    bench.report.target({.id = "T5",
                         .what = name + " bodies, links between any two",
                         .measured = random,
                         .unit = "ns",
                         .limit = 4});
}

}  // namespace

Vec3 Net::position(std::size_t i) const {
    const auto across = static_cast<double>(i % side);
    const auto down = static_cast<double>(i / side);
    return {across * 1.02, down * 1.02, static_cast<double>(i % 7) / 16};
}

Links Net::links() const {
    Links all;
    for (std::size_t i = 0; i < bodies(); ++i)
        if (i % side + 1 < side) all.push_back({i, i + 1});
    for (std::size_t i = 0; i + side < bodies(); ++i) all.push_back({i, i + side});
    return all;
}

Links Net::random_links() const {
    std::mt19937 random(1);
    const auto any = [&] { return static_cast<std::size_t>(random() % bodies()); };
    Links all;
    while (all.size() < 2 * side * (side - 1)) {
        const std::size_t a = any();
        const std::size_t b = any();
        if (a != b) all.push_back({a, b});
    }
    return all;
}

World make_net(const Net& net, const Links& links, const Link& link) {
    World world(3, {.rate = rate, .precision = Precision::single});
    reserve(world, net.bodies());
    std::vector<Entity> entities;
    entities.reserve(net.bodies());
    for (std::size_t i = 0; i < net.bodies(); ++i)
        entities.push_back(world.spawn({.position = net.position(i)}));
    for (const auto& [a, b] : links) world.link(entities[a], entities[b], link);
    return world;
}

void bench_nets(Bench& bench) {
    measure(bench, 100, 1.6);
    measure(bench, 300, 2.0);
}

}  // namespace oiler::bench
