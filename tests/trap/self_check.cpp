// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "oiler/scene/make_world.hpp"
#include "support/reference.hpp"
#include "trap/measure.hpp"
#include "trap/traps.hpp"
#include "trap/truth.hpp"

namespace oiler::trap {
namespace {

using namespace std::string_view_literals;
using Json = nlohmann::json;

/// The largest relative difference of a check.
class Check {
public:
    Check(const char* name, Real limit) : name_(name), limit_(limit) {}

    void compare(Real a, Real b, Real size) {
        ++count_;
        largest_ = std::max(largest_, std::abs(a - b) / (size > 0 ? size : 1));
    }
    [[nodiscard]] bool report() const {
        const bool holds = count_ > 0 && largest_ <= limit_;
        fmt::print("{:<44} {:>6} numbers, largest difference {:.2g}{}\n", name_, count_, largest_,
                   holds ? "" : fmt::format(" EXCEEDS {:.2g}", limit_));
        return holds;
    }

private:
    const char* name_;
    Real limit_;
    Real largest_ = 0;
    int count_ = 0;
};

bool check_flow() {
    Check check("oscillator_response.json", 1e-17L);
    for (const Json& one : reference("oscillator_response")) {
        const Real k = number<Real>(one.at("k"));
        const Real c = number<Real>(one.at("c"));
        const Real t = number<Real>(one.at("t"));
        if (k < 0 || c < 0 || t < 0) continue;
        const Flow at = flow(k, c, t);
        // Where the result cancels, its digits do not count.
        const Real reach = number<Real>(one.at("reach"));
        const Real sway = number<Real>(one.at("sway"));
        const Real turned = 1 + std::sqrt(k) * t;
        check.compare(at.xv, reach,
                      turned * std::max(std::abs(reach), k > 0 ? 1e-3L / std::sqrt(k) : 0));
        check.compare(at.xf, sway, turned * std::abs(sway));
        check.compare(at.vv, number<Real>(one.at("decay")), turned);
    }
    return check.report();
}

/// The states at whole multiples of 0.5 s, in the order of the file.
void compare_states(Check& check, Motion& motion, const Json& states, Real size) {
    std::vector<std::pair<Real, Point>> expected;
    for (const Json& state : states)
        expected.emplace_back(number<Real>(state.at("t")),
                              Point{state.contains("x") ? number<Real>(state.at("x")) : 0,
                                    number<Real>(state.at("y")), 0});
    motion.prepare(1000, 0);
    Point point;
    for (const auto& [t, exact] : expected) {
        const auto tick = std::llround(t * 1000);
        if (std::abs(static_cast<Real>(tick) / 1000 - t) > 1e-15L) continue;
        motion.sample(tick, &point);
        for (std::size_t axis = 0; axis < 2; ++axis) check.compare(point[axis], exact[axis], size);
    }
}

bool check_linear_drag() {
    Check check("linear_drag.json", 1e-17L);
    const Real pi = std::acos(Real(-1));
    for (const Json& one : reference("linear_drag")) {
        const Real v = number<Real>(one.at("v0"));
        const Real angle = number<Real>(one.at("deg")) * pi / 180;
        Oscillators bodies;
        bodies.add({.c = number<Real>(one.at("beta")),
                    .f = {0, -number<Real>(one.at("g")), 0},
                    .x = {0, number<Real>(one.at("y0")), 0},
                    .v = {v * std::cos(angle), v * std::sin(angle), 0}});
        compare_states(check, bodies, one.at("states"), 10);
    }
    return check.report();
}

bool check_quadratic_drag() {
    Check check("projectile_, vertical_quadratic_drag.json", 1e-14L);
    for (const Json& one : reference("projectile_quadratic_drag")) {
        System system{.gravity = {0, -number<Real>(one.at("g")), 0}};
        system.bodies.push_back(
            {.quadratic_drag = number<Real>(one.at("k_per_m")),
             .x = {number<Real>(one.at("x0")), number<Real>(one.at("y0")), 0},
             .v = {number<Real>(one.at("vx0")), number<Real>(one.at("vy0")), 0}});
        Integration motion(system, 60, 1e-16L, 1000);
        compare_states(check, motion, one.at("states"), 10);
    }
    for (const Json& one : reference("vertical_quadratic_drag")) {
        const Real g = number<Real>(one.at("g"));
        const Real terminal = number<Real>(one.at("vt"));
        System system{.gravity = {0, -g, 0}};
        system.bodies.push_back({.quadratic_drag = g / (terminal * terminal),
                                 .x = {0, number<Real>(one.at("y0")), 0},
                                 .v = {0, number<Real>(one.at("v0")), 0}});
        Integration motion(system, 60, 1e-16L, 1000);
        compare_states(check, motion, one.at("states"), 10);
    }
    return check.report();
}

bool check_coupled() {
    Check check("coupled_and_kepler.json: two masses", 1e-16L);
    System system;
    system.bodies = {{.x = {1}}, {}};
    system.springs = {{.body = 0, .stiffness = 15},
                      {.body = 1, .stiffness = 15},
                      {.body = 0, .to = 1, .stiffness = 1.5L}};
    const Json file = reference("coupled_and_kepler");
    for (const auto& [t, state] : file.at("two_coupled_equal").at("states").items()) {
        LinearSystem motion(system);
        motion.prepare(2, 0);
        std::array<Point, 2> points;
        motion.sample(std::llround(2 * std::stod(t)), points.data());
        check.compare(points[0][0], number<Real>(state.at(0)), 1);
        check.compare(points[1][0], number<Real>(state.at(2)), 1);
    }
    return check.report();
}

bool check_kepler() {
    Check check("coupled_and_kepler.json: ellipses", 1e-14L);
    const Json file = reference("coupled_and_kepler");
    for (const Json& one : file.at("kepler_GM1_a1").at("values")) {
        const Json& start = one.at("start");
        const Orbit orbit({}, 1, {number<Real>(start.at("x")), number<Real>(start.at("y"))},
                          {number<Real>(start.at("vx")), number<Real>(start.at("vy"))});
        for (const auto& [t, state] : one.at("states (x,y,vx,vy)").items()) {
            const Point point = orbit.at(std::stold(t));
            check.compare(point[0], number<Real>(state.at(0)), 1);
            check.compare(point[1], number<Real>(state.at(1)), 1);
        }
    }
    return check.report();
}

/// A system of one body over a floor with friction.
System over_floor(const Point& x, const Point& v, Real restitution, Real friction) {
    System system{
        .gravity = {0, -10, 0},
        .surfaces = {{.normal = {0, 1, 0}, .restitution = restitution, .friction = friction}}};
    system.bodies.push_back({.x = x, .v = v, .contact = 0});
    return system;
}

/// A body that falls 1 m and bounces twice, with friction, and one that slides to a stop.
bool check_floor() {
    Check check("closed forms of bounces and slides", 1e-15L);
    Integration ball(over_floor({0, 1, 0}, {3, 0, 0}, 0.5L, 0.1L), 1.2L, 1e-16L, 20'000);
    Integration slide(over_floor({0, 0, 0}, {4, 0, 0}, 0, 0.25L), 2, 1e-16L, 20'000);
    const Real first = std::sqrt(Real(2) / 10);
    const Real second = first + first;  // the flight between lasts 2 · 0.5 · 10 · first / 10
    Point point;
    for (Real t = 0.013L; t < second + first / 2; t += 0.017L) {
        Real x = 3 * t;
        Real y = 1 - 5 * t * t;
        for (const auto& [at, speed] : {std::pair{first, 10 * first}, {second, 5 * first}}) {
            if (t <= at) continue;
            const Real after = t - at;
            x -= 0.1L * 1.5L * speed * after;
            y = speed / 2 * after - 5 * after * after;
        }
        ball.positions(t, &point);
        check.compare(point[0], x, 1);
        check.compare(point[1], y, 1);
    }
    for (Real t = 0.013L; t < 2; t += 0.017L) {
        slide.positions(t, &point);
        check.compare(point[0], t < 1.6L ? 4 * t - 1.25L * t * t : 3.2L, 1);
        check.compare(point[1], 0, 1);
    }
    return check.report();
}

/// A ball slides off a circle with friction, to an angle from the top; one bounces on a platform
/// that swings. The numbers are roots with 40 digits.
bool check_obstacles() {
    Check check("a circle and a swinging platform", 1e-14L);
    System system{.gravity = {0, -9.81L, 0},
                  .surfaces = {{.shape = Surface::Shape::disc, .size = 1, .friction = 0.1L}}};
    const Real c = std::cos(0.1L);
    const Real s = std::sin(0.1L);
    system.bodies.push_back({.x = {1.25L * s, 1.25L * c, 0}, .v = {c, -s, 0}, .contact = 0.25L});
    const Integration slide(system, 1, 1e-16L, 20'000);
    constexpr Real leaves = 0.59476779440946307L;
    constexpr Real angle = 0.84862064697511152L;
    constexpr Real speed = 2.847058660783602L;
    Point point;
    for (const Real after : {Real(0), 0.1L, 0.3L}) {
        slide.positions(leaves + after, &point);
        check.compare(point[0], 1.25L * std::sin(angle) + speed * std::cos(angle) * after, 1);
        check.compare(
            point[1],
            1.25L * std::cos(angle) - speed * std::sin(angle) * after - 9.81L / 2 * after * after,
            1);
    }
    system.surfaces = {{.shape = Surface::Shape::bar,
                        .centre = {0, -0.5L, 0},
                        .normal = {0, 1, 0},
                        .size = 0.5L,
                        .reach = 2,
                        .restitution = 0.8L,
                        .swing = {0, 0.3L, 0},
                        .omega = 2 * std::acos(Real(-1)) / 1.5L}};
    system.bodies = {{.x = {0, 2.25L, 0}, .contact = 0.25L}};
    const Integration bounces(system, 4, 1e-16L, 20'000);
    for (const auto& [t, y] : {std::pair{0.61178656265236793L, 0.16414287462299144L},
                               {1.3136459234322334L, -0.21111135374316552L},
                               {2.6413346687202709L, -0.29929802814620174L},
                               {3.9053424658345925L, -0.18172233855587831L}}) {
        bounces.positions(t, &point);
        check.compare(point[1], y + 0.25L, 1);
    }
    return check.report();
}

/// The article's spring after the steps of a method.
bool check_steps() {
    Check check("spring_states.json: steps", 1e-10L);
    const std::pair<const char*, const char*> names[]{{"explicit_euler", "explicit_euler"},
                                                      {"implicit_midpoint", "implicit_midpoint"},
                                                      {"rk4_classic", "rk4"}};
    for (const Json& one : reference("spring_states")) {
        Scene scene;
        scene.bodies.push_back({.position = {1000, 0, 0}});
        scene.springs.push_back({.stiffness = 15, .damping = one.at("b").get<double>()});
        const auto rate = std::llround(1 / std::stod(one.at("dt").get<std::string>()));
        const auto steps = one.at("steps").get<std::int64_t>();
        for (const auto& [theirs, ours] : names) {
            Stepped run(scene, {.method = &find_method(ours), .rate = Rate{rate}});
            run.go_to(steps - 1);
            const Real x = number<Real>(one.at("state").at(theirs).at(0));
            check.compare(run.after()[0][0], x, std::max(std::abs(x), Real(1000)));
        }
    }
    return check.report();
}

/// The positions of both truths at 20 times and between.
void compare_truths(Check& check, const Scene& scene, Truth& best, Truth& other) {
    constexpr std::size_t inside = 7;
    const auto rate = static_cast<std::int64_t>(std::ceil(20 / scene.duration));
    // Scenes at rest have an extent of round-off.
    const Real size = best.extent(scene.duration) + 1e-6L;
    best.prepare(rate, inside);
    other.prepare(rate, inside);
    const auto steps =
        static_cast<std::int64_t>(std::floor(scene.duration * static_cast<double>(rate)));
    for (std::int64_t n = 0; n < steps; ++n) {
        const std::vector<Point>& a = best.sample(n);
        const std::vector<Point>& b = other.sample(n);
        for (std::size_t i = 0; i < a.size(); ++i)
            for (std::size_t axis = 0; axis < 3; ++axis)
                check.compare(a[i][axis], b[i][axis], size);
    }
}

/// Two ways to the motion of random scenes of some kinds.
bool compare(const char* name, std::uint64_t seed, Truth::From from,
             std::initializer_list<std::string_view> kinds_of_scene) {
    Check check(name, 1e-12L);
    constexpr std::uint64_t scenes = 72;
    for (std::uint64_t one = seed; one < seed + scenes; ++one) {
        const Kind& kind = kind_of(one);
        if (std::ranges::find(kinds_of_scene, kind.name) == kinds_of_scene.end()) continue;
        Scene scene = make_trap(one, kind, true).scene;
        try {
            // The integration follows few periods, and no strong damping.
            scene.duration = static_cast<double>(
                std::min(static_cast<Real>(scene.duration), 20 * Truth(scene).shortest_period()));
            Truth best(scene);
            Truth other(scene, from, 1000);
            compare_truths(check, scene, best, other);
        } catch (const std::domain_error&) {
        }
    }
    return check.report();
}

}  // namespace

bool self_check(std::uint64_t seed) {
    using From = Truth::From;
    const auto uncoupled = {"spring"sv,      "springs"sv,     "slow and fast"sv, "aliased"sv,
                            "linear drag"sv, "free flight"sv, "at rest"sv};
    const std::array all{
        check_flow(),
        check_linear_drag(),
        check_quadratic_drag(),
        check_coupled(),
        check_kepler(),
        check_floor(),
        check_obstacles(),
        check_steps(),
        compare("uncoupled bodies as a matrix", seed, From::matrix, uncoupled),
        compare("uncoupled bodies integrated", seed, From::integration, uncoupled),
        compare("coupled springs integrated", seed, From::integration, {"pair", "chain"}),
        compare("orbits integrated", seed, From::integration, {"orbit"})};
    return std::ranges::all_of(all, [](bool holds) { return holds; });
}

}  // namespace oiler::trap
