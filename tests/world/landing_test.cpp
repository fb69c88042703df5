// SPDX-License-Identifier: MIT
// Bodies that meet planes: bounces in flight; between several planes, in wedges_test.cpp. How they
// rest and slide is in resting_test.cpp and sliding_test.cpp.
#include <random>

#include "oiler/sim/bodies.hpp"
#include "world/contacts.hpp"

namespace oiler::test {
namespace {

/// The speed after `bounces` bounces of a ball that leaves the floor at `u` with restitution `e`
/// under gravity and linear drag `c`, 1/s; Newton's iteration on the closed form of its height.
long double speed_after_bounces(long double u, long double e, long double c, int bounces) {
    const long double limit = g / c;
    for (int i = 0; i < bounces; ++i) {
        long double t = 2 * u / g;
        const auto speed = [&] { return (u + limit) * std::exp(-c * t) - limit; };
        for (int k = 0; k < 100; ++k)
            t -= ((u + limit) / c * (1 - std::exp(-c * t)) - limit * t) / speed();
        u = -e * speed();
    }
    return u;
}
long double apex_with_drag(long double u, long double c) {
    const long double t = std::log(1 + u * c / g) / c;
    return (u + g / c) / c * (1 - std::exp(-c * t)) - g / c * t;
}

/// The apex after `bounces` bounces of a ball thrown up at 12 m/s, from the state after the last
/// step before it.
double apex_after(const char* method, int rate, int bounces, double drag) {
    World world = world_of(method, rate, 1, {-g}, {{.normal = {1}, .restitution = 0.9}});
    const Entity ball = world.spawn({.velocity = {12}, .contact = Contact{}}, LinearDrag{drag});
    for (int met = 0; world.time() < 60;) {
        const double x = world.position(ball)[0];
        const double v = world.velocity(ball)[0];
        world.step();
        for (const Impact& impact : world.impacts()) met += impact.kind == Meeting::bounce;
        if (met < bounces || v <= 0 || world.velocity(ball)[0] > 0) continue;
        return drag == 0 ? x + v * v / (2 * g) : x + static_cast<double>(apex_with_drag(v, drag));
    }
    return 0;
}

// Without drag, methods of order 2 and more step flights exactly. Each of ten flights adds a few
// units of round-off of 7 m; steps in between, up to 12000, a unit each.
TEST(Landing, KeepsApexesExactWithoutDrag) {
    const double exact = 144 / (2 * g) * std::pow(0.9, 20);
    for (const char* method :
         {"velocity_verlet", "rk2_midpoint", "rk4", "implicit_midpoint", "pefrl", "exact"})
        for (const int rate : {20, 30, 60, 160, 640})
            EXPECT_NEAR(apex_after(method, rate, 10, 0), exact, 2e-13) << method << rate;
}

// Half the step divides the error by 2^p: the impacts are located with the method itself. At these
// rates the next order changes the ratio by less than a tenth of an order.
TEST(Landing, KeepsTheOrderOfTheMethod) {
    const auto exact =
        static_cast<double>(apex_with_drag(speed_after_bounces(12, 0.9L, 0.3L, 10), 0.3L));
    for (const auto& [method, order] : {std::pair{"semi_implicit_euler", 1},
                                        {"velocity_verlet", 2},
                                        {"rk2_midpoint", 2},
                                        {"implicit_midpoint", 2},
                                        {"rk4", 4},
                                        {"pefrl", 4}}) {
        const int rate = order == 1 ? 640 : 40;
        const double coarse = std::abs(apex_after(method, rate, 10, 0.3) - exact);
        const double fine = std::abs(apex_after(method, 2 * rate, 10, 0.3) - exact);
        EXPECT_GT(fine, 1e-13) << method;
        EXPECT_NEAR(std::log2(coarse / fine), order, 0.1) << method;
    }
    EXPECT_NEAR(apex_after("exact", 20, 10, 0.3), exact, 1e-13);
}

// Falls for 1 s from g/2, so that the impact is exactly at a tick, one unit before it or after it.
TEST(Landing, MeetsAPlaneAtTheStartOrTheEndOfAStep) {
    for (const double height : {g / 2, std::nextafter(g / 2, 0.0), std::nextafter(g / 2, 9.0)}) {
        World world = world_of("velocity_verlet", 8, 1, {-g}, {{.normal = {1}, .restitution = 1}});
        const Entity ball = world.spawn({.position = {height}, .contact = Contact{}});
        const int met = count(world, 16);
        EXPECT_EQ(met, 1) << height;
        EXPECT_NEAR(world.position(ball)[0], g / 2, 16 * 2 * epsilon * g);
    }
}

TEST(Landing, FollowsManyImpactsInAStep) {
    // Without gravity: 50.5 flights of 1 m between a floor and a ceiling in 0.5 s.
    World world = world_of(
        "rk4", 2, 1, {},
        {{.normal = {1}, .restitution = 1}, {.normal = {-1}, .offset = -1, .restitution = 1}});
    const Entity ball = world.spawn({.velocity = {101}, .contact = Contact{}});
    world.step();
    ASSERT_EQ(world.impacts().size(), 50U);
    for (std::size_t i = 0; i < 50; ++i) {
        EXPECT_EQ(world.impacts()[i].obstacle.slot, (i + 1) % 2);
        EXPECT_NEAR(world.impacts()[i].time, static_cast<double>(i + 1) / 101, 100 * epsilon);
        EXPECT_EQ(std::abs(world.impacts()[i].after[0]), 101);
    }
    EXPECT_NEAR(world.position(ball)[0], 0.5, 101 * 100 * epsilon);
    EXPECT_EQ(world.velocity(ball)[0], 101);
}

TEST(Landing, FollowsBallsOfOneDiameterBetweenPlanes) {
    World world = world_of(
        "velocity_verlet", 60, 1, {-g},
        {{.normal = {1}, .restitution = 0.5}, {.normal = {-1}, .offset = -1, .restitution = 0.5}});
    const Entity ball = world.spawn({.position = {0.5}, .velocity = {3}, .contact = Contact{0.5}});
    world.step(120);
    EXPECT_EQ(world.position(ball)[0], 0.5);
    EXPECT_EQ(world.velocity(ball)[0], 0);
}

// The apex is above the ceiling between two ticks at which the ball is below it: at 20 Hz by up to
// g·dt²/8 = 3.1 mm.
TEST(Landing, FindsACeilingTouchedBetweenTwoSteps) {
    const double dt = 1.0 / 20;
    const double u = g * 2.5 * dt;
    const double apex = u * u / (2 * g);
    World world = world_of("velocity_verlet", 20, 1, {-g},
                           {{.normal = {-1}, .offset = -(apex - 0.001), .restitution = 1}});
    const Entity ball = world.spawn({.velocity = {u}, .contact = Contact{}});
    world.step(2);
    ASSERT_LT(world.position(ball)[0], apex - 0.001);
    world.step();
    ASSERT_EQ(world.impacts().size(), 1U);
    // Reached at speed √(2·g·1 mm).
    EXPECT_NEAR(world.impacts()[0].before[0], std::sqrt(2 * g * 0.001), 1e-12);
    EXPECT_NEAR(world.impacts()[0].time, (u - std::sqrt(2 * g * 0.001)) / g, 1e-13);
    EXPECT_LT(world.velocity(ball)[0], -std::sqrt(2 * g * 0.001));
}

// An apex on the plane is no impact; one unit of round-off lower it is none either, and from the
// other side it is met.
TEST(Landing, GrazesAPlane) {
    for (const double shift : {-1e-12, 1e-12}) {
        World world = world_of("velocity_verlet", 20, 1, {-g},
                               {{.normal = {-1}, .offset = -(0.5 / g + shift), .restitution = 1}});
        world.spawn({.velocity = {1}, .contact = Contact{}});
        const int met = count(world, 4);
        EXPECT_EQ(met, shift < 0 ? 1 : 0);
    }
}

TEST(Landing, DoesNotTunnel) {
    World world = world_of("semi_implicit_euler", 20, 3, {}, {{.normal = {1}, .restitution = 1}});
    const Entity ball =
        world.spawn({.position = {3}, .velocity = {-1e4, 5, 0}, .contact = Contact{0.25}});
    world.step();
    ASSERT_EQ(world.impacts().size(), 1U);
    EXPECT_NEAR(world.impacts()[0].time, 2.75e-4, 1e-18);
    EXPECT_NEAR(world.impacts()[0].point[0], 0, 1e-12);
    EXPECT_NEAR(world.impacts()[0].point[1], 5 * 2.75e-4, 1e-15);
    EXPECT_NEAR(world.position(ball)[0], 500 - 2.75 + 0.25, 1e-12 * 500);
    EXPECT_NEAR(world.position(ball)[1], 0.25, 1e-15);
}

// An elastic ball on a slope that holds it by friction hops without end, 7700 times in this step.
TEST(Landing, PassesOverHopsThatFrictionStops) {
    const double steep = 0.3;
    const Vec3 normal{-std::sin(steep), std::cos(steep)};
    World world = world_of("velocity_verlet", 30, 2, {0, -g},
                           {{.normal = normal, .restitution = 1, .friction = 0.6}});
    const double hop = 2e-5;
    const Entity body = world.spawn({.velocity = normal * hop, .contact = Contact{}});
    world.step();
    EXPECT_LE(length(world.velocity(body)), 1.5 * hop);
    EXPECT_LE(length(world.position(body)), 1e-6);
}

// Against a sum over fine steps of the same spring: one of 10⁴ N/m pulls a ball through the plane
// that its centre is under, at 60 Hz 1.7 radians per step. The exact flow gives both times.
TEST(Landing, FollowsASpringThatPullsThroughAPlane) {
    const double omega = 100;
    World world = world_of("exact", 60, 1, {}, {{.normal = {1}, .restitution = 0.8}});
    const Entity ball = world.spawn({.position = {0.1}, .contact = Contact{}},
                                    Spring{.anchor = {-0.05}, .stiffness = omega * omega});
    // x = −0.05 + 0.15·cos ωt reaches 0 at cos ωt = 1/3; it is thrown back at 0.8 of its speed,
    // and x = −0.05 + A·cos(φ − ωt') with A·cos φ = 0.05 and A·sin φ = u/ω until φ again.
    const double first = std::acos(1.0 / 3) / omega;
    const double u = 0.8 * 0.15 * std::sin(std::acos(1.0 / 3)) * omega;
    const double phase = std::atan2(u / omega, 0.05);
    const double second = first + 2 * phase / omega;
    const auto all = impacts(world, 3);
    ASSERT_GE(all.size(), 2U);
    EXPECT_NEAR(all[0].time, first, 1e-15);
    EXPECT_NEAR(all[0].after[0], u, 1e-12);
    EXPECT_NEAR(all[1].time, second, 1e-15);
    EXPECT_GE(world.position(ball)[0], 0);
}

// A thrust holds at all instants of the step, before and after an impact.
TEST(Landing, KeepsThePushOfTheStep) {
    World world = world_of("velocity_verlet", 1, 1, {}, {{.normal = {1}, .restitution = 1}});
    const Entity ball = world.spawn({.mass = 2, .position = {1}, .contact = Contact{}});
    world.apply_force(ball, {-16});
    world.step();
    // a = −8: reaches 0 after 1/2 s at −4 m/s, then x = 4·t − 4·t² = 1 and v = 4 − 8·t = 0.
    EXPECT_NEAR(world.position(ball)[0], 1, 8 * epsilon);
    EXPECT_NEAR(world.velocity(ball)[0], 0, 32 * epsilon);
}

// The first kick of the next step must not use the field of a position before the impact.
TEST(Landing, KeepsTheFieldOfAnAttractor) {
    const auto end = [](int rate) {
        World world =
            world_of("velocity_verlet", rate, 2, {}, {{.normal = {1, 0}, .restitution = 1}});
        const Entity ball = world.spawn(
            {.position = {1, 1}, .velocity = {-1, 0}, .contact = Contact{0.1}}, Attractor{.gm = 1});
        world.step(3 * rate);
        return world.position(ball);
    };
    const Vec3 coarse = end(50);
    const Vec3 middle = end(100);
    const Vec3 fine = end(200);
    EXPECT_NEAR(std::log2(length(coarse - middle) / length(middle - fine)), 2, 0.1);
}

// 10⁶ bounces of 0.9 s, of 7 steps each. An impact changes the energy by units of round-off that
// add up at random, and steps by as many.
TEST(Landing, MakesAnElasticBallKeepItsEnergy) {
    World world = world_of("velocity_verlet", 8, 1, {-g}, {{.normal = {1}, .restitution = 1}});
    const Entity ball = world.spawn({.position = {1}, .contact = Contact{}});
    std::size_t met = 0;
    while (met < 1000000) {
        world.step(6000);
        met += world.impacts().size();
    }
    const double v = world.velocity(ball)[0];
    EXPECT_NEAR(world.position(ball)[0] + v * v / (2 * g), 1, 1e6 * 2 * epsilon);
}

// Semi-implicit Euler steps a flight from u on as a parabola from u − g·dt/2, and lands at that
// speed, after a kick that is already made: each bounce loses g·dt. The last flights, shorter than
// a step, lose less.
TEST(Landing, CostsSemiImplicitEulerItsSpeed) {
    const double dt = 1.0 / 60;
    World world = world_of("semi_implicit_euler", 60, 1, {-g}, {{.normal = {1}, .restitution = 1}});
    world.spawn({.velocity = {10}, .contact = Contact{}});
    const auto bounces = impacts(world, 120 * 60, Meeting::bounce);
    ASSERT_NEAR(static_cast<double>(bounces.size()), 10 / (g * dt), 8);
    double before = 10;
    for (std::size_t i = 0; i < 49; ++i) {
        EXPECT_NEAR(before - bounces[i].after[0], g * dt, 0.5 * g * dt) << i;
        before = bounces[i].after[0];
    }
}

// A place between two floats is 1/16 m at 10⁶ m. The ball is never lower than that, and comes to
// rest.
TEST(Landing, HoldsFarFromTheOriginInFloat) {
    constexpr double far = 1e6;
    constexpr double place = 0.0625;
    World world = world_of("velocity_verlet", 60, 1, {-g},
                           {{.normal = {1}, .offset = far, .restitution = 0.8}}, Precision::single);
    const Entity ball = world.spawn({.position = {far + 8}, .contact = Contact{}});
    for (int i = 0; i < 3600; ++i) {
        world.step();
        ASSERT_GE(world.position(ball)[0], far - place) << i;
    }
    EXPECT_NEAR(world.position(ball)[0], far, place);
    EXPECT_EQ(world.velocity(ball)[0], 0);
}

TEST(Landing, IsTheSameForAnyStepsPerCallAndThreads) {
    const auto hash = [](int per_call, int threads, Precision precision, const char* method) {
        World world(2, Settings{.stepping = {.method = &find_method(method),
                                             .rate = {60},
                                             .precision = precision},
                                .threads = threads});
        world.set_gravity({0, -g});
        world.add_plane({.normal = {0.1, 1}, .restitution = 0.7, .friction = 0.2});
        world.add_plane({.normal = {-1, 0}, .offset = -20, .restitution = 0.5});
        std::mt19937 random(1);
        for (int i = 0; i < 700; ++i) {
            const auto at = [&] { return static_cast<double>(random() % 1000) / 100; };
            const std::optional<Contact> contact =
                i % 5 == 0 ? std::nullopt : std::optional(Contact{0.1 * (i % 4)});
            world.spawn({.position = {at(), at() + 1},
                         .velocity = {at() - 5, at() - 5},
                         .contact = contact},
                        LinearDrag{0.1 * (i % 3)});
        }
        for (int i = 0; i < 192; i += per_call) world.step(per_call);
        return world.state_hash();
    };
    for (const char* method :
         {"semi_implicit_euler", "velocity_verlet", "rk4", "implicit_midpoint", "exact"})
        for (const Precision precision : {Precision::single, Precision::double_}) {
            const auto expected = hash(1, 1, precision, method);
            for (const int per_call : {3, 64})
                for (const int threads : {1, 2, 3})
                    EXPECT_EQ(hash(per_call, threads, precision, method), expected)
                        << method << per_call << threads;
        }
}

TEST(Landing, ListsImpactsInTheOrderOfTime) {
    World world = world_of("velocity_verlet", 1, 1, {}, {{.normal = {1}, .restitution = 1}});
    const Entity late = world.spawn({.position = {2}, .velocity = {-3}, .contact = Contact{}});
    const Entity early = world.spawn({.position = {1}, .velocity = {-2}, .contact = Contact{}});
    world.spawn({.position = {1}, .velocity = {-2}});
    world.step(2);
    ASSERT_EQ(world.impacts().size(), 2U);
    EXPECT_EQ(world.impacts()[0].entity, early);
    EXPECT_EQ(world.impacts()[0].time, 0.5);
    EXPECT_EQ(world.impacts()[1].entity, late);
    EXPECT_NEAR(world.impacts()[1].time, 2.0 / 3, epsilon);
    world.step();
    EXPECT_TRUE(world.impacts().empty());
}

TEST(Landing, IsOnlyForBodiesWithAContact) {
    World world = world_of("velocity_verlet", 10, 1, {}, {{.normal = {1}}});
    const Entity ghost = world.spawn({.position = {1}, .velocity = {-10}});
    const Entity ball = world.spawn({.position = {1}, .velocity = {-10}, .contact = Contact{}});
    world.set_contact(ball, std::nullopt);
    world.step(2);
    EXPECT_EQ(world.position(ghost)[0], -1);
    EXPECT_EQ(world.position(ball)[0], -1);
    world.set_contact(ghost, Contact{0.5});
    world.step();
    ASSERT_EQ(world.impacts().size(), 2U);
    EXPECT_EQ(world.impacts()[0].kind, Meeting::lifted);
    EXPECT_EQ(world.impacts()[0].point[0], 0);
    EXPECT_GE(world.position(ghost)[0], 0.5);
    EXPECT_EQ(world.position(ball)[0], -2);
    world.clear_planes();
    world.set_velocity(ghost, {-20});
    world.step();
    EXPECT_LT(world.position(ghost)[0], 0);
}

TEST(Landing, MovesTheContactWithItsBody) {
    World world = world_of("velocity_verlet", 10, 1, {}, {{.normal = {1}, .restitution = 1}});
    const Entity gone = world.spawn({.position = {5}});
    world.spawn({.position = {5}});
    const Entity ball = world.spawn({.position = {1}, .velocity = {-10}, .contact = Contact{}});
    world.destroy(gone);
    World copy = world;
    for (World* each : {&world, &copy}) {
        each->step(2);
        EXPECT_EQ(each->position(ball)[0], 1);
    }
}

// Two balls on a spring fall as one, so that their bounces are exact. They part by round-off.
TEST(Landing, OfLinkedBodiesIsExactWhileTheirLinkIsSlack) {
    const auto error = [](int rate) {
        World world =
            world_of("velocity_verlet", rate, 1, {-g}, {{.normal = {1}, .restitution = 1}});
        const Entity a = world.spawn({.position = {1}, .contact = Contact{}});
        const Entity b = world.spawn({.position = {1}, .contact = Contact{}});
        world.link(a, b, {.stiffness = 1});
        world.step(rate);
        const double fall = std::sqrt(2 / g);
        const double rest = 1 - fall;
        return std::abs(world.position(b)[0] - (g * fall * rest - g / 2 * rest * rest));
    };
    EXPECT_LT(error(10), 1e-12);
    EXPECT_LT(error(1000), 1e-11);
}

TEST(Landing, RefusesWrongNumbers) {
    World world = world_of("rk4", 60, 2);
    const auto refused = [&](const Plane& plane) { EXPECT_THROW(world.add_plane(plane), Error); };
    refused({.normal = {0, 0}});
    refused({.normal = {0, 0, 1}});
    refused({.normal = {1e200, 0}, .offset = 1e200});
    refused({.normal = {1e-200, 0}});
    refused({.normal = {0, 1}, .restitution = -0.1});
    refused({.normal = {0, 1}, .restitution = 1.01});
    refused({.normal = {0, 1}, .restitution = std::nan("")});
    refused({.normal = {0, 1}, .friction = -1});
    refused({.normal = {0, 1}, .offset = std::nan("")});
    EXPECT_FALSE(world.bodies().has_obstacles());
    EXPECT_THROW(world.spawn({.contact = Contact{-1}}), Error);
    EXPECT_EQ(world.bodies().size(), 0U);
}

}  // namespace
}  // namespace oiler::test
