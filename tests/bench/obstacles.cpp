// SPDX-License-Identifier: MIT
// The cost of a step among obstacles, and the error of bounces on round and turned ones.

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/bench.hpp"
#include "bench/peers.hpp"
#include "bench/plots.hpp"
#include "oiler/stability/obstacle_gap.hpp"

namespace oiler::bench {

Vec3 TiledGround::tile(std::size_t i) const {
    return {width() * (static_cast<double>(i % columns()) + 0.5),
            -0.5 - static_cast<double>(i / columns())};
}

Body TiledGround::ball(std::size_t i) const {
    constexpr double take_off = 12;  // m/s
    const double part = static_cast<double>(i) / static_cast<double>(balls);
    const double t =
        2 * take_off / 9.81 * static_cast<double>(i * 37 % balls) / static_cast<double>(balls);
    Body ball{.position = {1000 * part, 0.1}, .contact = Contact{0.1}};
    if (phase != Phase::resting) {
        ball.position[1] += (take_off - 9.81 * t / 2) * t + (phase == Phase::flying ? 1 : 0);
        ball.velocity = {3, phase == Phase::flying ? 0 : take_off - 9.81 * t};
    }
    return ball;
}

namespace {

World world_of(const TiledGround& ground) {
    World world(
        2,
        {.method = &find_method("velocity_verlet"), .rate = {60}, .precision = Precision::single});
    world.set_gravity({0, ground.gravity()});
    for (std::size_t i = 0; i < ground.tiles; ++i)
        world.add_obstacle({.shape = BoxShape{ground.tile(i), {ground.width(), 1}},
                            .restitution = ground.restitution()});
    for (std::size_t i = 0; i < ground.balls; ++i) world.spawn(ground.ball(i));
    return world;
}

/// Steps once, so that all of its first work is done, and returns the ns per ball and step.
double cost(const Bench& bench, const TiledGround& ground, const Work& step) {
    step(60);
    Effort effort = bench.effort;
    effort.patience = 1;
    return Bench::ns(race({step}, effort)[0], static_cast<double>(ground.balls));
}

struct PeerOfTiles {
    const char* name;
    PeerWork (*make)(const TiledGround&);
};
constexpr std::array tile_peers{
    PeerOfTiles{"Box2D", if_found<OILER_BENCH_BOX2D, box2d_tiles>()},
    PeerOfTiles{"Bullet", if_found<OILER_BENCH_BULLET, bullet_tiles>()}};

void measure_costs(Bench& bench, std::size_t tiles) {
    constexpr std::array names{"in flight", "bouncing", "at rest"};
    for (const Phase phase : {Phase::flying, Phase::bouncing, Phase::resting}) {
        if (tiles == 0 && phase != Phase::flying) continue;
        const TiledGround ground{tiles, 10'000, phase};
        World world = world_of(ground);
        Row row{fmt::format("{} tiles, {}", in_powers(tiles), names[static_cast<int>(phase)]), {}};
        row.numbers.emplace_back("Oiler", cost(bench, ground, repeated([&] { world.step(); })));
        for (const auto& [name, make] : tile_peers)
            if (make) row.numbers.emplace_back(name, cost(bench, ground, make(ground).step));
        bench.report.add("Obstacles, ns per ball and step, 10⁴ balls in float", row);
    }
}

double real(const nlohmann::json& given) {
    return given.is_string() ? std::stod(given.get<std::string>()) : given.get<double>();
}
Vec3 point(const nlohmann::json& given) { return {real(given[0]), real(given[1])}; }

std::vector<Obstacle> obstacles_of(const nlohmann::json& scene) {
    std::vector<Obstacle> all;
    for (const auto& given : scene["obstacles"]) {
        Shape shape = CircleShape{point(given["centre"])};
        if (given["kind"] == "circle")
            std::get<CircleShape>(shape).radius = real(given["radius"]);
        else
            shape =
                BoxShape{point(given["centre"]), point(given["half"]) * 2.0, real(given["angle"])};
        all.push_back({.shape = shape, .restitution = real(given["restitution"])});
    }
    return all;
}

/// Bounces a body that is in an obstacle and moves into it, as most engines do after a step. The
/// normal is the slope of the gap.
void bounce_at_end(World& world, Entity body, const Obstacle& obstacle, double radius) {
    const auto gap_at = [&](const Vec3& x) { return gap(obstacle.shape, x, radius, 2); };
    const Vec3 x = world.position(body);
    const double depth = -gap_at(x);
    if (depth <= 0) return;
    constexpr double h = 1e-6;
    Vec3 n{gap_at(x + Vec3{h}) - gap_at(x - Vec3{h}),
           gap_at(x + Vec3{0, h}) - gap_at(x - Vec3{0, h})};
    n = n * (1 / length(n));
    const double speed = dot(n, world.velocity(body));
    if (speed >= 0) return;
    world.set_position(body, x + n * depth);
    world.set_velocity(body, world.velocity(body) - n * ((1 + obstacle.restitution) * speed));
}

/// The error of the position at a probe, m.
double error_of(const nlohmann::json& scene, const nlohmann::json& probe, const Method& method,
                int rate, bool located) {
    World world(2, {.method = &method, .rate = {rate}, .precision = Precision::double_});
    world.set_gravity({0, -9.81});
    const double radius = real(scene["radius"]);
    const Entity ball = world.spawn({.position = point(scene["start"]["position"]),
                                     .velocity = point(scene["start"]["velocity"]),
                                     .contact = Contact{radius}});
    if (const double drag = real(scene["drag"]); drag > 0) world.attach(ball, LinearDrag{drag});
    const auto obstacles = obstacles_of(scene);
    for (const Obstacle& one : obstacles)
        if (located) world.add_obstacle(one);
    const auto steps = std::llround(real(probe["t"]) * rate);
    for (std::int64_t i = 0; i < steps; ++i) {
        world.step();
        for (const Obstacle& one : obstacles)
            if (!located) bounce_at_end(world, ball, one, radius);
    }
    return length(world.position(ball) - point(probe["position"]));
}

}  // namespace

void bench_obstacles(Bench& bench) {
    for (const std::size_t tiles : {0, 10, 1000, 100'000})
        if (bench.wants(fmt::format("obstacles: {} tiles", tiles))) measure_costs(bench, tiles);
}

void bench_obstacle_errors(Bench& bench) {
    if (!bench.wants("obstacles: errors")) return;
    const auto all = nlohmann::json::parse(
        std::ifstream(std::string(OILER_SOURCE) + "/tests/data/obstacles.json"));
    for (const auto& scene : all["values"]["scenes"])
        for (const auto& probe : scene["probes"])
            for (const std::string name : {"semi_implicit_euler", "velocity_verlet", "rk4"})
                for (const bool located : {true, false}) {
                    Row row{fmt::format("{}, bounce {}, {}{}", scene["name"].get<std::string>(),
                                        probe["after_bounce"].get<int>(), name,
                                        located ? "" : ", at the end of a step"),
                            {}};
                    for (const int rate : bounce_rates)
                        row.numbers.emplace_back(
                            column_of(rate),
                            error_of(scene, probe, find_method(name), rate, located));
                    bench.report.add("Bounces on obstacles, error of the position, m", row);
                }
}

}  // namespace oiler::bench
