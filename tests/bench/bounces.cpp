// SPDX-License-Identifier: MIT
// The error of the tenth apex of a ball that bounces on a floor.
//
// An apex is the height that the motion reaches between two steps: that after the last step of the
// rise, and the closed form of what is left of the rise, without drag v²/2g. The highest sample,
// which a player sees, is up to g·dt²/8 lower than the apex.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "bench/bench.hpp"
#include "bench/peers.hpp"
#include "bench/plots.hpp"

namespace oiler::bench {
namespace {

constexpr double g = 9.81;
constexpr double take_off = 12;  // m/s
constexpr double restitution = 0.9;
constexpr int tenth = 10;
constexpr double longest = 30;  // s; the eleventh impact is after 17 s
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr Plane ground{.normal = {1}, .restitution = restitution};

/// The height of a flight that leaves the floor at `speed`, ∫ v/(g + c·v) dv; with a negative speed
/// that of a fall that ends with it.
long double height_of(long double speed, long double drag) {
    if (drag == 0) return speed * speed / (2 * g);
    return speed / drag - g / (drag * drag) * std::log1p(speed * drag / g);
}

long double exact_apex(long double drag) {
    long double speed = take_off;
    for (int bounce = 0; bounce < tenth; ++bounce) {
        const long double height = height_of(speed, drag);
        long double low = 0;
        long double high = speed;
        for (int i = 0; i < std::numeric_limits<long double>::digits; ++i) {
            const long double middle = (low + high) / 2;
            (height_of(-middle, drag) < height ? low : high) = middle;
        }
        speed = static_cast<long double>(restitution) * low;
    }
    return height_of(speed, drag);
}

struct Ball {
    World world;
    Entity entity;

    Ball(std::string_view method, int rate, double drag)
        : world(1,
                {.method = &find_method(method), .rate = {rate}, .precision = Precision::double_}),
          entity(world.spawn({.velocity = {take_off}, .contact = Contact{}})) {
        world.set_gravity({-g});
        if (drag > 0) world.attach(entity, LinearDrag{drag});
    }
};

BouncingBall located(std::string_view method, int rate, double drag) {
    const auto ball = std::make_shared<Ball>(method, rate, drag);
    ball->world.add_plane(ground);
    return {
        [=] { ball->world.step(); }, [=] { return ball->world.position(ball->entity)[0]; },
        [=] { return ball->world.velocity(ball->entity)[0]; },
        [=] { return std::ranges::count(ball->world.impacts(), Meeting::bounce, &Impact::kind); }};
}

BouncingBall at_end(std::string_view method, int rate, double drag) {
    const auto free = std::make_shared<Ball>(method, rate, drag);
    return {[=] {
                free->world.step();
                bounce_at_end(free->world, free->entity, ground, 0);
            },
            [=] { return free->world.position(free->entity)[0]; },
            [=] { return free->world.velocity(free->entity)[0]; }};
}

struct TenthApex {
    std::optional<double> height;  ///< m
    long bounces = 0;
};

/// If impacts are not listed, a bounce leaves the floor with 0.1 m/s or more: bodies at rest may
/// tremble.
TenthApex measure(const BouncingBall& ball, int rate, double drag) {
    TenthApex apex;
    for (int step = 0; step < longest * rate; ++step) {
        const double x = ball.height();
        const double v = ball.velocity();
        ball.step();
        apex.bounces += ball.impacts ? ball.impacts() : v < 0 && ball.velocity() > 0.1;
        if (apex.bounces < tenth || v <= 0 || ball.velocity() > 0) continue;
        apex.height = x + static_cast<double>(height_of(v, drag));
        return apex;
    }
    return apex;
}

/// Adds the errors of a ball at all rates and returns the largest.
template <class Make>
double add_row(Report& report, const std::string& name, double drag, Make make) {
    Row row{name, {}};
    double largest = 0;
    for (const int rate : bounce_rates) {
        const TenthApex apex = measure(make(rate), rate, drag);
        if (!apex.height)
            report.missing(fmt::format("{} at {} Hz: the ball sticks to the floor after bounce {}",
                                       name, rate, apex.bounces));
        const double error =
            apex.height ? static_cast<double>(*apex.height - exact_apex(drag)) : none;
        row.numbers.emplace_back(column_of(rate), error);
        largest = std::max(largest, apex.height ? std::abs(error) : INFINITY);
    }
    report.add(std::string(drag > 0 ? dragged_bounces : free_bounces), row);
    return largest;
}

struct PeerOfBall {
    std::string_view name;
    BouncingBall (*make)(double speed, double restitution, double dt);
};
constexpr std::array peers{PeerOfBall{"Box2D", if_found<OILER_BENCH_BOX2D, box2d_ball>()},
                           PeerOfBall{"ODE", if_found<OILER_BENCH_ODE, ode_ball>()},
                           PeerOfBall{"Bullet", if_found<OILER_BENCH_BULLET, bullet_ball>()}};

void measure_peers(Report& report) {
    for (const auto& [name, make] : peers)
        if (make)
            add_row(report, std::string(name), 0,
                    [&](int rate) { return make(take_off, restitution, 1.0 / rate); });
        else
            report.missing(fmt::format("{}, bounces: it is not installed", name));
}

/// Ten flights and 9000 steps at 640 Hz add round-off of a few units of 7 m.
void demand_exact(Report& report, std::string_view method, double largest) {
    report.target({"T9", fmt::format("{}, without drag, any rate", method), largest,
                   at_most(2e-13, "m"), "the largest error of the tenth apex"});
}

void measure_methods(Report& report, double drag) {
    for (const std::string method : {"semi_implicit_euler", "velocity_verlet", "rk4"}) {
        const double largest =
            add_row(report, method, drag, [&](int rate) { return located(method, rate, drag); });
        if (drag == 0 && find_method(method).order > 1) demand_exact(report, method, largest);
    }
    for (const std::string method : {"velocity_verlet", "rk4"})
        add_row(report, method + ", at the end of a step", drag,
                [&](int rate) { return at_end(method, rate, drag); });
}

}  // namespace

std::string column_of(int rate) { return fmt::format("{} Hz", rate); }

void bounce_at_end(World& world, Entity body, const Plane& plane, double radius) {
    const Vec3 x = world.position(body);
    const Vec3 v = world.velocity(body);
    const double below = -gap(plane, x, radius);
    const double speed = -leaving_speed(plane, v);
    if (below <= 0 || speed <= 0) return;
    world.set_position(body, x + plane.normal * below);
    const Vec3 along = landed(plane, v, speed);
    world.set_velocity(body, pushed_off(plane, along, plane.restitution * speed));
}

void bench_bounces(Bench& bench) {
    if (!bench.wants("bounces: errors")) return;
    bench.report.fact("tenth apex, exact", fmt::format("{:.6f} m, with drag {:.9f} m",
                                                       exact_apex(0), exact_apex(bounce_drag)));
    bench.report.fact(
        "tenth apex, measured",
        "the height after the last step of the rise, plus the closed form of the rest of the "
        "rise");
    measure_methods(bench.report, 0);
    measure_peers(bench.report);
    measure_methods(bench.report, bounce_drag);
}

}  // namespace oiler::bench
