// SPDX-License-Identifier: MIT
#include "bench/bench.hpp"
#include "bench/scenes.hpp"

namespace oiler::bench {
namespace {

constexpr double take_off = 12;  // m/s

enum class Flight { without_contact, with_contact, bouncing, resting };

/// Balls at all phases of a flight that leaves the floor at 12 m/s and returns after 147 steps.
World balls(Flight flight, std::size_t count) {
    World world(
        2,
        {.method = &find_method("velocity_verlet"), .rate = rate, .precision = Precision::single});
    world.reserve(count);
    world.set_gravity({0, gravity[1]});
    world.add_plane({.normal = {0, 1},
                     .offset = flight == Flight::with_contact ? -1e6 : 0,
                     .restitution = flight == Flight::resting ? 0.0 : 1.0});
    for (std::size_t i = 0; i < count; ++i) {
        const double t =
            2 * take_off / -gravity[1] * static_cast<double>(i) / static_cast<double>(count);
        Body body{.position = {0, (take_off + gravity[1] * t / 2) * t},
                  .velocity = {0, take_off + gravity[1] * t}};
        if (flight == Flight::resting) body.position = body.velocity = {};
        if (flight != Flight::without_contact) body.contact = Contact{};
        world.spawn(body);
    }
    return world;
}

}  // namespace

void bench_bounce_costs(Bench& bench) {
    if (!bench.wants("bounces: costs")) return;
    constexpr std::size_t count = 10'000;
    std::vector<World> worlds;
    for (const Flight flight :
         {Flight::without_contact, Flight::with_contact, Flight::bouncing, Flight::resting})
        worlds.push_back(balls(flight, count));
    std::vector<Work> work;
    for (World& world : worlds)
        work.push_back([&](long times) {
            for (long i = 0; i < times; ++i) world.step();
        });
    const std::vector<double> seconds = race(work, bench.effort);
    constexpr std::array names{"in flight, without a contact", "in flight, with a contact",
                               "a bounce every 147 steps", "at rest"};
    for (std::size_t i = 0; i < names.size(); ++i)
        bench.report.add(
            "Bounces, cost of 10⁴ balls in float, one step per call",
            {names[i],
             {{"ns each", Bench::ns(seconds[i], count)}, {"relative", seconds[i] / seconds[0]}}});
}

}  // namespace oiler::bench
