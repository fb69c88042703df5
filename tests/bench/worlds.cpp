// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <chrono>
#include <random>

#include "bench/bench.hpp"
#include "bench/peers.hpp"
#include "bench/scenes.hpp"
#include "oiler/capture/png.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/step_clock.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/platform/surface.hpp"
#include "oiler/render/renderer.hpp"

namespace oiler::bench {
namespace {

Work steps_of(World& world) {
    return repeated([&world] { world.step(1); });
}

Settings in_float(int threads = 1) {
    return {.stepping = {.rate = rate, .precision = Precision::single}, .threads = threads};
}

/// Springs with the stiffness and damping of a game, from 1 m.
World swinging(std::size_t bodies) {
    World world(3, in_float());
    world.reserve(bodies);
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
    world.reserve(bodies);
    for (std::size_t i = 0; i < bodies; ++i)
        world.spawn(
            {.position = few.bodies().position(i % 64), .velocity = few.bodies().velocity(i % 64)},
            Spring{.stiffness = 40, .damping = 0.8});
    return world;
}

/// ns per spring and step. A pinned net hangs from two corners.
double cost(const Bench& bench, const Net& net, const Links& links, const Link& link,
            bool pinned = false) {
    World world = make_net(net, links, link);
    for (std::size_t i = 0; pinned && i < 2; ++i) {
        const Entity corner = world.entity_of_row(i * (net.side - 1));
        world.link_to_point(corner, world.position(corner), link);
    }
    const std::vector<double> seconds = race({repeated([&] { world.step(1); })}, bench.effort);
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
    bench.report.target({"T5", name, with, at_most(most, "ns")});
    bench.report.target(
        {"T5", name + ", hung from two corners / not", pinned / with, at_most(1.05)});
    bench.report.target({"T5", name + " bodies, links between any two", random, at_most(4, "ns")});
}

constexpr std::size_t elements = 10'000;

/// A disc for each body, as a game's `picture()` makes them.
Picture picture_of(const Bodies& bodies) {
    Picture picture;
    picture.discs.reserve(bodies.size());
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        const Vec3 at = bodies.position(row);
        picture.discs.push_back({.key = {.object = row + 1},
                                 .centre = {static_cast<float>(at[0]), static_cast<float>(at[1])},
                                 .radius = 0.05F,
                                 .colour = palette::blue});
    }
    return picture;
}

/// Frames are 1280 × 720.
void measure_frames(Bench& bench, const Picture& picture, std::size_t discs) {
    const std::unique_ptr<Surface> surface = open_offscreen(Offscreen::automatic);
    Renderer renderer([&](const char* name) { return surface->procedure(name); });
    constexpr Size size{1280, 720};
    Pixels pixels;
    const auto draw = repeated([&] {
        renderer.draw(picture, size);
        renderer.read(pixels);
    });
    const auto encode = repeated([&] { keep(encode_png(pixels.size, pixels.rgb)); });
    draw(1);
    const std::vector<double> seconds = race({draw, encode}, bench.effort);
    bench.report.add("Frames of 1280 × 720 a second",
                     {fmt::format("{} discs, {}", in_powers(discs), surface->provider()),
                      {{"drawn and read back", 1 / seconds[0]},
                       {"encoded as PNG", 1 / seconds[1]},
                       {"both", 1 / (seconds[0] + seconds[1])}}});
}

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

void bench_settled(Bench& bench) {
    if (!bench.wants("settled")) return;
    constexpr std::size_t bodies = 100'000;
    const std::int64_t steps = bench.full ? 1'000'000 : 300'000;
    World moving = swinging(bodies);
    World still = settled(bodies, steps);
    const std::vector<double> seconds = race({steps_of(moving), steps_of(still)}, bench.effort);
    const double at_first = Bench::ns(seconds[0], bodies);
    const double later = Bench::ns(seconds[1], bodies);
    bench.report.target({"T7", fmt::format("10⁵ springs after {} steps", in_powers(steps)),
                         later / at_first, at_most(1.1),
                         fmt::format("{:.3f} ns, at first {:.3f} ns", later, at_first)});
}

void bench_threads(Bench& bench) {
    if (!bench.wants("threads")) return;
    for (const std::size_t bodies : {1000, 4000, 10'000, 100'000, 1'000'000}) {
        World alone = make_world(Scene::springs, 3, bodies, in_float(1));
        World team = make_world(Scene::springs, 3, bodies, in_float(2));
        const std::vector<double> seconds = race({steps_of(alone), steps_of(team)}, bench.effort);
        bench.report.add("Threads, µs per step of springs in float",
                         {in_powers(bodies), {{"1", seconds[0] * 1e6}, {"2", seconds[1] * 1e6}}});
        if (bodies > 10'000) continue;
        const double overhead = (seconds[1] - seconds[0] / 2) * 1e6;
        bench.report.target({"T3", fmt::format("fork and join, {} bodies", in_powers(bodies)),
                             overhead, at_most(1, "µs"),
                             fmt::format("two threads {:.2f} µs, half of one's {:.2f} µs",
                                         seconds[1] * 1e6, seconds[0] / 2 * 1e6)});
    }
}

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
    world.reserve(net.bodies());
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

void bench_loop(Bench& bench) {
    if (!bench.wants("loop")) return;
    Bodies bodies = make_bodies(Scene::projectiles, 2, elements, Precision::single);
    const Picture before = picture_of(bodies);
    bodies.step(find_method("semi_implicit_euler"), {.rate = rate});
    const Picture after = picture_of(bodies);
    StepClock clock(60);
    std::chrono::nanoseconds now{0};
    const auto advance =
        repeated([&] { keep(clock.advance(now += std::chrono::microseconds(16667))); });
    const auto snapshot = repeated([&] { keep(picture_of(bodies)); });
    const auto interpolate = repeated([&] { keep(between(before, after, 0.5F)); });
    const std::vector<double> seconds = race({advance, snapshot, interpolate}, bench.effort);
    const std::string title = "The loop around the step, ns";
    bench.report.add(title, {"StepClock::advance, a frame", {{"ns", Bench::ns(seconds[0], 1)}}});
    bench.report.add(title, {"picture, an element", {{"ns", Bench::ns(seconds[1], elements)}}});
    bench.report.add(title, {"between, an element", {{"ns", Bench::ns(seconds[2], elements)}}});
}

void bench_frames(Bench& bench) {
    if (!bench.wants("frames")) return;
    try {
        for (const std::size_t discs :
             {std::size_t{1000}, bench.full ? std::size_t{100'000} : std::size_t{10'000}}) {
            Picture picture =
                picture_of(make_bodies(Scene::projectiles, 2, discs, Precision::single));
            picture.camera = {.centre = {1.5F, -1.5F}, .height = 1.5F};
            measure_frames(bench, picture, discs);
        }
    } catch (const Error& error) {
        bench.report.missing(fmt::format("frames: {}", error.what()));
    }
}

void bench_bounce_costs(Bench& bench) {
    if (!bench.wants("bounces: costs")) return;
    constexpr std::size_t count = 10'000;
    std::vector<World> worlds;
    for (const Flight flight :
         {Flight::without_contact, Flight::with_contact, Flight::bouncing, Flight::resting})
        worlds.push_back(balls(flight, count));
    std::vector<Work> work;
    for (World& world : worlds) work.push_back(repeated([&] { world.step(); }));
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
