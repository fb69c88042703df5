// SPDX-License-Identifier: MIT
#include "bench/peers.hpp"

#include <fmt/format.h>

#include <optional>

#include "bench/bench.hpp"
#include "bench/scenes.hpp"

namespace oiler::bench {
namespace {

enum class Task { fall, oscillate };

/// A peer, its task, and its precision and axes.
struct Peer {
    std::string_view name;
    std::string_view package;  ///< of Debian
    PeerWork (*make)(std::size_t bodies);
    Task task;
    int axes;
    Precision precision;
    std::string_view method;
    double least;  ///< the wanted speed of Oiler, as a multiple of the peer's
    std::string_view besides;
};

const std::vector<Peer>& peers() {
    constexpr auto single = Precision::single;
    constexpr auto twice = Precision::double_;
    static const std::vector<Peer> all{
        {"Bullet", "libbullet-dev", if_found<OILER_BENCH_BULLET, bullet_fall>(), Task::fall, 3,
         single, "semi_implicit_euler", 500, "rotation, bounding boxes in a tree, islands"},
        {"Box2D, no fixtures", "libbox2d-dev", if_found<OILER_BENCH_BOX2D, box2d_fall>(),
         Task::fall, 2, single, "semi_implicit_euler", 350, "rotation, islands"},
        {"Box2D, a circle each", "libbox2d-dev", if_found<OILER_BENCH_BOX2D, box2d_fall_fixtures>(),
         Task::fall, 2, single, "semi_implicit_euler", 350,
         "rotation, islands, fixtures in a tree"},
        {"ODE", "libode-dev", if_found<OILER_BENCH_ODE, ode_fall>(), Task::fall, 3, single,
         "semi_implicit_euler", 250, "rotation, islands; in double, Oiler in float"},
        {"Odeint runge_kutta4", "libboost-dev", if_found<OILER_BENCH_ODEINT, odeint_rk4>(),
         Task::oscillate, 1, twice, "rk4", 5, "any system of equations"},
        {"Odeint symplectic_euler", "libboost-dev",
         if_found<OILER_BENCH_ODEINT, odeint_symplectic_euler>(), Task::oscillate, 1, twice,
         "semi_implicit_euler", 2, "any separable system"},
        {"GSL rk4", "libgsl-dev", if_found<OILER_BENCH_GSL, gsl_rk4>(), Task::oscillate, 1, twice,
         "rk4", 40, "an estimate of its error: three steps for one"}};
    return all;
}

/// Falling bodies share gravity; oscillators are undamped.
World our_world(const Peer& peer, std::size_t bodies) {
    World world(peer.axes,
                {.method = &find_method(peer.method), .rate = rate, .precision = peer.precision});
    world.reserve(bodies);
    if (peer.task == Task::fall) world.set_gravity({0, -9.81, 0});
    for (std::size_t i = 0; i < bodies; ++i) {
        if (peer.task == Task::fall)
            world.spawn(start_of(i, peer.axes));
        else
            world.spawn(start_of(i, peer.axes), Spring{.stiffness = peer_stiffness});
    }
    return world;
}

struct Costs {
    double theirs;
    double one;
    double many;
};

/// ns per body and step; none if the peer does not do its work.
std::optional<Costs> race_with(const Bench& bench, const Peer& peer, std::size_t bodies) {
    constexpr int per_call = 256;
    World world = our_world(peer, bodies);
    World far = world;
    const PeerWork work = peer.make(bodies);
    const double before = work.measure();
    const std::vector<double> seconds =
        race({work.step, repeated([&] { world.step(1); }), repeated([&] { far.step(per_call); })},
             bench.effort);
    if (work.measure() == before) return std::nullopt;
    const auto each = static_cast<double>(bodies);
    return Costs{Bench::ns(seconds[0], each), Bench::ns(seconds[1], each),
                 Bench::ns(seconds[2], each * per_call)};
}

void measure(Bench& bench, const Peer& peer) {
    const bool falls = peer.task == Task::fall;
    const std::size_t bodies = falls && !bench.full ? 10'000 : 100'000;
    const std::string name = fmt::format("{}, {}", peer.name, in_powers(bodies));
    if (!bench.wants("peers: " + name)) return;
    if (!peer.make)
        return bench.report.missing(
            fmt::format("{}: {} is not installed", peer.name, peer.package));
    const std::optional<Costs> c = race_with(bench, peer, bodies);
    if (!c) return bench.report.missing(fmt::format("{}: no body moves", peer.name));
    bench.report.add("Peers, ns per body and step",
                     {name, {{"peer", c->theirs}, {"one step", c->one}, {"256 at once", c->many}}});
    const double ours = falls ? c->one : c->many;
    bench.report.target(
        {"T4", name + (falls ? ", one step per call" : ", 256 steps per call"), c->theirs / ours,
         at_least(peer.least, "×"),
         fmt::format("{:.3g} ns, Oiler {:.3g} ns; besides: {}", c->theirs, ours, peer.besides)});
}

void measure_net(Bench& bench) {
    const Net net{100};
    if (!bench.wants("peers: Bullet soft body, 100 × 100")) return;
    if constexpr (!OILER_BENCH_BULLET) {
        bench.report.missing("Bullet soft body: libbullet-dev is not installed");
        return;
    } else {
        World world =
            make_net(net, net.links(), {.stiffness = 50, .damping = 0.5, .rest_length = 1});
        const PeerWork work = bullet_net(net);
        const std::vector<double> seconds =
            race({work.step, repeated([&] { world.step(); })}, bench.effort);
        const auto springs = static_cast<double>(net.links().size());
        bench.report.target(
            {"T5", "Bullet soft body, 100 × 100", seconds[0] / seconds[1], at_least(50, "×"),
             fmt::format("{:.3g} ns, Oiler {:.3g} ns a spring; besides: "
                         "normals, bounding box, one solver iteration",
                         Bench::ns(seconds[0], springs), Bench::ns(seconds[1], springs))});
    }
}

}  // namespace

void bench_peers(Bench& bench) {
    for (const Peer& peer : peers()) measure(bench, peer);
    measure_net(bench);
}

}  // namespace oiler::bench
