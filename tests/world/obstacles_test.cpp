// SPDX-License-Identifier: MIT
// Bodies that meet standing circles, boxes and segments. The reference numbers of
// data/obstacles.json were computed from event to event in closed form, with 40 digits.
#include "oiler/sim/bodies.hpp"
#include "support/reference.hpp"
#include "world/campaigns.hpp"
#include "world/contacts.hpp"

namespace oiler::test {
namespace {

const nlohmann::json& references() {
    static const nlohmann::json all = ::reference("obstacles");
    return all;
}
double real(const nlohmann::json& given) {
    return given.is_string() ? std::stod(given.get<std::string>()) : given.get<double>();
}
Vec3 point(const nlohmann::json& given) { return {real(given[0]), real(given[1])}; }

Obstacle obstacle_of(const nlohmann::json& given) {
    Obstacle obstacle{.restitution = real(given["restitution"])};
    if (given["kind"] == "circle")
        obstacle.shape = CircleShape{point(given["centre"]), real(given["radius"])};
    else
        obstacle.shape =
            BoxShape{point(given["centre"]), point(given["half"]) * 2.0, real(given["angle"])};
    return obstacle;
}

struct Thrown {
    World world;
    Entity ball;
};
Thrown thrown(const nlohmann::json& scene, const char* method, int rate) {
    Thrown made{world_of(method, rate, 2, {0, -g}), {}};
    for (const auto& obstacle : scene["obstacles"]) made.world.add_obstacle(obstacle_of(obstacle));
    const Body body{.position = point(scene["start"]["position"]),
                    .velocity = point(scene["start"]["velocity"]),
                    .contact = Contact{real(scene["radius"])}};
    made.ball = real(scene["drag"]) > 0 ? made.world.spawn(body, LinearDrag{real(scene["drag"])})
                                        : made.world.spawn(body);
    return made;
}
/// The error of the position at a probe, m.
double error_at(const nlohmann::json& scene, const nlohmann::json& probe, const char* method,
                int rate) {
    Thrown made = thrown(scene, method, rate);
    made.world.step(std::llround(real(probe["t"]) * rate));
    return length(made.world.position(made.ball) - point(probe["position"]));
}

// Without drag, methods of order 2 step flights exactly. Round-off grows by 1 + 2·way/ρ at each
// bounce on a round obstacle: less than tenfold, so 10⁵-fold in five bounces.
TEST(Obstacles, AreMetExactlyWithoutDrag) {
    for (const auto& scene : references()["scenes"]) {
        if (real(scene["drag"]) > 0) continue;
        for (const auto& probe : scene["probes"])
            for (const char* method : {"velocity_verlet", "rk4"})
                for (const int rate : {20, 40, 80})
                    EXPECT_LT(error_at(scene, probe, method, rate), 2e-15 * 1e5)
                        << scene["name"] << method << rate;
    }
}

// Half the step divides the error by 2^p, also after bounces on round and turned obstacles.
TEST(Obstacles, KeepTheOrderOfTheMethod) {
    const auto order = [](const auto& scene, const auto& probe, const char* method, int rate) {
        return std::log2(error_at(scene, probe, method, rate) /
                         error_at(scene, probe, method, 2 * rate));
    };
    for (const auto& scene : references()["scenes"]) {
        if (real(scene["drag"]) == 0) continue;
        for (const auto& probe : scene["probes"]) {
            EXPECT_NEAR(order(scene, probe, "velocity_verlet", 160), 2, 0.2) << scene["name"];
            EXPECT_NEAR(order(scene, probe, "rk4", 40), 4, 0.3) << scene["name"];
        }
    }
}

World peg_world(double start_y, double restitution = 1) {
    World world = world_of("velocity_verlet", 60);
    world.add_obstacle({.shape = CircleShape{{}, 0.05}, .restitution = restitution});
    world.spawn({.position = {-0.4, start_y}, .velocity = {50}, .contact = Contact{0.05}});
    return world;
}

// Both ends of the step are outside of the peg. A graze turns the path by √(2·depth/ρ), so that
// round-off of 10⁻¹⁷ m changes it by less than 10⁻⁷ of the speed.
TEST(Obstacles, AreMetBetweenTheEndsOfAStep) {
    World world = peg_world(0.08);
    world.step();
    ASSERT_EQ(world.impacts().size(), 1U);
    EXPECT_NEAR(world.impacts()[0].time, 0.0068, 1e-15);
    EXPECT_NEAR(world.impacts()[0].after[0], 14, 1e-11);
    EXPECT_NEAR(world.impacts()[0].after[1], 48, 1e-11);
    World graze = peg_world(0.1 - 1e-6);
    graze.step();
    ASSERT_EQ(graze.impacts().size(), 1U);
    EXPECT_NEAR(graze.impacts()[0].after[0], 49.99800001, 1e-6);
    EXPECT_NEAR(graze.impacts()[0].after[1], 0.447208005339797, 1e-6);
    World beside = peg_world(0.1 + 1e-9);
    beside.step();
    EXPECT_TRUE(beside.impacts().empty());
}

// Two pegs at once: mirror symmetry is kept, and the ball comes to rest between them.
TEST(Obstacles, ThatAreMetAtOnceKeepMirrorSymmetry) {
    for (const int rate : {20, 60, 240}) {
        World world = world_of("velocity_verlet", rate, 2, {0, -g});
        for (const double x : {-0.4, 0.4})
            world.add_obstacle({.shape = CircleShape{{x, 0}, 0.2}, .restitution = 0.5});
        const Entity ball = world.spawn({.position = {0, 1.5}, .contact = Contact{0.3}});
        world.step(5 * rate);
        EXPECT_NEAR(world.position(ball)[0], 0, 1e-15);
        EXPECT_NEAR(world.position(ball)[1], 0.3, 1e-15);
        EXPECT_EQ(world.velocity(ball), Vec3{});
    }
}

/// The horizontal speed after a slide off a dome, whose error is that of the place of leaving.
double speed_off_dome(const char* method, int rate, double friction, double speed) {
    World world = world_of(method, rate, 2, {0, -g});
    world.add_obstacle({.shape = CircleShape{{}, 1}, .friction = friction});
    const Vec3 up{std::sin(0.1), std::cos(0.1)};
    const Entity ball = world.spawn(
        {.position = 1.25 * up, .velocity = speed * Vec3{up[1], -up[0]}, .contact = Contact{0.25}});
    while (world.time() < 0.9) {
        world.step();
        EXPECT_GE(length(world.position(ball)) - 1.25, -1e-15);
    }
    return world.velocity(ball)[0];
}

// A hop has order min(p, 2) on a curve, with and without friction.
TEST(Obstacles, AreLeftWhereTheCurveNoLongerPresses) {
    for (const auto& [name, speed] :
         {std::pair{"slide_off_circle", 0.5}, {"slide_off_circle_friction", 1.0}}) {
        const auto& all = references()["extras"];
        const auto slide = *std::ranges::find_if(
            all, [&wanted = name](const auto& e) { return e["name"] == wanted; });
        const double friction = real(slide["friction"]);
        const double exact =
            real(slide["leaves"]["speed"]) * std::cos(real(slide["leaves"]["theta"]));
        const auto error = [&, at_first = speed](const char* method, int rate) {
            return std::abs(speed_off_dome(method, rate, friction, at_first) - exact);
        };
        EXPECT_NEAR(std::log2(error("semi_implicit_euler", 80) / error("semi_implicit_euler", 160)),
                    1, 0.1);
        EXPECT_NEAR(std::log2(error("velocity_verlet", 80) / error("velocity_verlet", 160)), 2,
                    0.1);
        EXPECT_LT(error("velocity_verlet", 320), 1e-5);
    }
}

// Over the end of a box at a speed below √(g·r), a disc rolls round the corner; above it flies.
TEST(Obstacles, AreLeftAtACornerAboveTheSpeedThatFollowsIt) {
    for (const double part : {0.99, 1.01}) {
        World world = world_of("velocity_verlet", 240, 2, {0, -g});
        const auto box = world.add_obstacle({.shape = BoxShape{{-5, -0.5}, {10, 1}}});
        const Entity ball = world.spawn({.position = {-1, 0.5},
                                         .velocity = {part * std::sqrt(g * 0.5)},
                                         .contact = Contact{0.5}});
        while (world.position(ball)[0] < 0.02) world.step();
        EXPECT_EQ(!world.touches(ball).empty(), part < 1);
        EXPECT_EQ(world.alive(box), true);
    }
}

Obstacle random_obstacle(Dice& dice, double restitution, double friction) {
    const Vec3 at{dice.uniform(-3, 3), dice.uniform(-3, 1)};
    Obstacle obstacle{.restitution = restitution, .friction = friction};
    if (dice.chance(0.3))
        obstacle.shape = CircleShape{at, dice.uniform(0.05, 1)};
    else if (dice.chance(0.5))
        obstacle.shape = BoxShape{at,
                                  {dice.uniform(0.1, 2), dice.uniform(0.1, 2)},
                                  dice.chance(0.5) ? 0 : dice.uniform(-1.5, 1.5)};
    else
        obstacle.shape = SegmentShape{at, at + Vec3{dice.uniform(0.1, 2), dice.uniform(-2, 2)}};
    return obstacle;
}

// velocity_verlet and rk4 keep the energy of flights; standing obstacles add none, with any
// friction, and no step ends in an obstacle by more than round-off.
TEST(Obstacles, AddNoEnergyAndLetNothingIn) {
    for (unsigned seed = 0; seed < static_cast<unsigned>(whole(400, 40000)); ++seed) {
        Dice dice(seed);
        World world = world_of(dice.chance(0.5) ? "rk4" : "velocity_verlet",
                               dice.chance(0.5) ? 10 : 60, 2, {0, -g});
        const double friction = dice.chance(0.5) ? 0 : std::pow(10, dice.uniform(-2, 300));
        for (int i = 0; i < 5; ++i)
            world.add_obstacle(
                random_obstacle(dice, dice.chance(0.3) ? 1 : dice.uniform(0, 1), friction));
        Vec3 at{dice.uniform(-3, 3), dice.uniform(1, 3)};
        const double radius = dice.uniform(0.02, 0.4);
        while (!world.overlaps(at, {radius + 1e-6}).empty()) at[1] += 0.1;
        const Entity ball = world.spawn({.position = at,
                                         .velocity = {dice.uniform(-10, 10), dice.uniform(-10, 10)},
                                         .contact = Contact{radius}});
        const double energy = world.energy().total();
        for (int i = 0; i < 60; ++i) {
            world.step();
            ASSERT_TRUE(world.overlaps(world.position(ball), {radius - 1e-12}).empty()) << seed;
            ASSERT_LE(world.energy().total(), energy + 1e-9 * (1 + std::abs(energy))) << seed;
        }
    }
}

TEST(Obstacles, GiveTheSameBitsWithAnyThreadsAndStepsPerCall) {
    const auto hash_of = [](int threads, int steps_per_call) {
        World world = world_of("velocity_verlet", 60, 2, {0, -g});
        world.set_threads(threads);
        Dice dice(3);
        for (int i = 0; i < 12; ++i) world.add_obstacle(random_obstacle(dice, 0.7, 0.2));
        world.add_obstacle({.shape = BoxShape{{0, -4}, {20, 1}},
                            .restitution = 0.9,
                            .swing = Swing{{0, 0.3}, 1.5}});
        world.add_obstacle(
            {.shape = CircleShape{{-3, 2}, 0.4}, .restitution = 1, .velocity = {1, -1}});
        for (int i = 0; i < 3000; ++i)
            world.spawn({.position = {dice.uniform(-4, 4), dice.uniform(2, 9)},
                         .velocity = {dice.uniform(-3, 3), 0},
                         .contact = Contact{dice.uniform(0.01, 0.1)}});
        for (int i = 0; i < 64; i += steps_per_call) world.step(steps_per_call);
        StateHash hash;
        world.bodies().hash_into(hash);
        return hash.value();
    };
    const auto first = hash_of(1, 1);
    EXPECT_EQ(hash_of(1, 64), first);
    EXPECT_EQ(hash_of(3, 1), first);
    EXPECT_EQ(hash_of(8, 8), first);
}

// A point slides down a turned face with g·sin(angle), and leaves it at the edge.
TEST(Obstacles, BearPoints) {
    for (const double angle : {0.1, -0.5, 1.0}) {
        World world = world_of("velocity_verlet", 60, 2, {0, -g});
        world.add_obstacle({.shape = BoxShape{{}, {1, 1}, angle}, .restitution = 0});
        const Vec3 top{-0.5 * std::sin(angle), 0.5 * std::cos(angle)};
        const Vec3 down = Vec3{std::cos(angle), std::sin(angle)} * (angle > 0 ? -1.0 : 1.0);
        const Entity point = world.spawn({.position = top, .contact = Contact{}});
        const double a = g * std::abs(std::sin(angle));
        const double until = std::sqrt(2 * 0.5 / a);
        const auto steps = static_cast<int>(until * 60);
        world.step(steps);
        const double t = steps / 60.0;
        EXPECT_NEAR(length(world.position(point) - top - down * (a * t * t / 2)), 0, 1e-13);
        ASSERT_NO_THROW(world.step(60)) << angle;
        const double speed = a * until;
        const double after = steps / 60.0 + 1 - until;
        const Vec3 free = top + down * (0.5 + speed * after) + Vec3{0, -g * after * after / 2};
        EXPECT_NEAR(length(world.position(point) - free), 0, 1e-11) << angle;
    }
}

// Drops of points on turned boxes, and of discs on the joint of two boxes in a turned world, end in
// flight or at rest.
TEST(Obstacles, EndNoRunAtFacesAndJoints) {
    Dice dice(40);
    for (int i = 0; i < 500; ++i) {
        World world = world_of("velocity_verlet", dice.whole(20, 240), 2, {0, -g});
        world.add_obstacle({.shape = BoxShape{{}, {1, 1}, dice.uniform(-1, 1)}, .restitution = 0});
        world.spawn({.position = {dice.uniform(-0.6, 0.6), dice.uniform(1, 3)},
                     .velocity = {dice.uniform(-1, 1), 0},
                     .contact = Contact{}});
        ASSERT_NO_THROW(world.step(400)) << i;
    }
    for (int i = 0; i < 500; ++i) {
        const double angle = dice.uniform(-1, 1);
        const Vec3 up{-std::sin(angle), std::cos(angle)};
        const Vec3 along{std::cos(angle), std::sin(angle)};
        World world = world_of("velocity_verlet", dice.whole(20, 240), 2, up * -g);
        for (const double x : {-0.5, 0.5})
            world.add_obstacle({.shape = BoxShape{along * x - up * 0.5, {1, 1}, angle},
                                .restitution = dice.uniform(0, 0.4)});
        const double radius = dice.uniform(0.05, 0.4);
        const Entity ball = world.spawn({.position = up * 1.3, .contact = Contact{radius}});
        ASSERT_NO_THROW(world.step(480)) << i;
        EXPECT_NEAR(length(world.position(ball) - up * radius), 0, 1e-9) << i;
    }
}

// A point in the corner of two obstacles ends where a disc of 1 nm does.
TEST(Obstacles, BearPointsInCorners) {
    const auto end = [](double radius) {
        World world(2, {.method = &find_method("velocity_verlet"), .rate = {100, 7}});
        world.set_gravity({0, -10});
        world.add_obstacle({.shape = HalfSpaceShape{{1, 1}, -7}});
        world.add_obstacle({.shape = BoxShape{{-2, -5}, {4, 1}}});
        const Entity body =
            world.spawn({.position = {-5, -1}, .velocity = {-1, -3}, .contact = Contact{radius}});
        world.step(40);
        return world.position(body);
    };
    EXPECT_LT(length(end(0) - end(1e-9)), 1e-7);
}

// A predicted rest is where the body touches the obstacle.
TEST(Obstacles, AreTouchedWhereRestsAreListed) {
    World world = world_of("velocity_verlet", 5, 2, {0, -10});
    world.add_obstacle({.shape = CircleShape{{4, 0}, 1.4}, .restitution = 0.5});
    world.spawn({.position = {4, 1.7}, .velocity = {1, 1}, .contact = Contact{0.2}});
    for (const Impact& rest : impacts(world, 10, Meeting::rest)) {
        EXPECT_NEAR(length(rest.point - Vec3{4, 0}), 1.4, 1e-12);
        EXPECT_NEAR(length(rest.normal - (rest.point - Vec3{4, 0}) / 1.4), 0, 1e-12);
    }
}

TEST(Obstacles, AreRefusedWithNumbersThatHaveNoMeaning) {
    World world(2, Settings{});
    const auto refused = [&](const Obstacle& obstacle) {
        EXPECT_THROW(world.add_obstacle(obstacle), Error);
    };
    refused({.shape = CircleShape{{}, 0}});
    refused({.shape = CircleShape{{}, std::nan("")}});
    refused({.shape = BoxShape{{}, {1, 0}}});
    refused({.shape = SegmentShape{{1, 1}, {1, 1}}});
    refused({.shape = CircleShape{}, .restitution = 1.1});
    refused({.shape = CircleShape{}, .friction = -1});
    refused({.shape = CircleShape{}, .one_way = Vec3{}});
    refused({.shape = CircleShape{}, .swing = Swing{{1}, 0}});
    refused({.shape = CircleShape{{0, 0, 1}, 1}});
    EXPECT_FALSE(world.bodies().has_obstacles());
    World line(1, Settings{});
    EXPECT_THROW(line.add_obstacle({.shape = SegmentShape{{0}, {1}}}), Error);
}

}  // namespace
}  // namespace oiler::test
