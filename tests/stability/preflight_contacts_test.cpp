// SPDX-License-Identifier: MIT
// The pre-flight's warnings of planes, of bounces, and of springs without a direction.
#include "oiler/sim/bodies.hpp"
#include "support/dice.hpp"
#include "support/explained_step.hpp"
#include "support/springs.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Rate rate{60};

// ---- room between planes

Bodies ball(int axes, double radius, const std::vector<Plane>& planes) {
    Bodies bodies(axes, Precision::double_);
    for (const Plane& plane : planes) bodies.add_plane(plane);
    bodies.add({.contact = Contact{radius}});
    return bodies;
}

std::vector<std::string> lines_of(const Bodies& bodies) {
    return warnings(bodies, find_method("velocity_verlet"), rate);
}

/// The lines about the room between planes, wherever the ball starts.
std::vector<std::string> room_lines(const Bodies& bodies) {
    std::vector<std::string> lines = lines_of(bodies);
    std::erase_if(lines, [](const std::string& line) { return holds(line, " starts "); });
    return lines;
}

TEST(RoomWarning, NamesPlanesAndRadius) {
    const std::vector<Plane> slab{
        {.normal = {1, 0}, .offset = -9}, {.normal = {0, 1}}, {.normal = {0, -2}, .offset = -1.6}};
    const auto lines = room_lines(ball(2, 0.5, slab));
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0],
              "body 0: planes 1 and 2 leave room for a radius of 0.4 m, and its contact of 0.5 m "
              "does not fit: move them apart, or give it a smaller contact");
    EXPECT_TRUE(room_lines(ball(2, 0.4, slab)).empty());
}

TEST(RoomWarning, SaysThatPlanesContradict) {
    const auto lines =
        room_lines(ball(1, 0, {{.normal = {1}, .offset = 3}, {.normal = {-1}, .offset = 3}}));
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(
        lines[0].starts_with("body 0: planes 0 and 1 contradict each other: every point is "
                             "3 m or more below one of them"))
        << lines[0];
}

// A triangle with sides 3, 4 and 5 has the inradius 1. A regular tetrahedron around the unit
// sphere has the inradius 1, and a cube of side 2, too.
TEST(RoomWarning, KnowsTheInradius) {
    const std::vector<Plane> triangle{
        {.normal = {1, 0}}, {.normal = {0, 1}}, {.normal = {-4, -3}, .offset = -12}};
    const std::vector<Plane> tetrahedron{{.normal = {1, 1, 1}, .offset = -std::sqrt(3.0)},
                                         {.normal = {1, -1, -1}, .offset = -std::sqrt(3.0)},
                                         {.normal = {-1, 1, -1}, .offset = -std::sqrt(3.0)},
                                         {.normal = {-1, -1, 1}, .offset = -std::sqrt(3.0)}};
    std::vector<Plane> cube;
    for (const double sign : {1, -1})
        for (const Vec3& side : {Vec3{sign, 0, 0}, Vec3{0, sign, 0}, Vec3{0, 0, sign}})
            cube.push_back({.normal = side, .offset = -1});
    const std::pair<int, std::vector<Plane>> rooms[]{{2, triangle}, {3, tetrahedron}, {3, cube}};
    for (const auto& [axes, planes] : rooms) {
        EXPECT_TRUE(room_lines(ball(axes, 0.999999, planes)).empty()) << planes.size();
        EXPECT_EQ(room_lines(ball(axes, 1.000001, planes)).size(), 1U) << planes.size();
    }
}

TEST(RoomWarning, IsNotGivenForOpenPlanes) {
    EXPECT_TRUE(
        room_lines(ball(2, 100, {{.normal = {0, 1}}, {.normal = {1, -1}, .offset = 50}})).empty());
    EXPECT_TRUE(
        room_lines(ball(3, 100, {{.normal = {0, 1}}, {.normal = {1, 0}}, {.normal = {0, 1}}}))
            .empty());
    Bodies ghost(1, Precision::double_);
    ghost.add_plane({.normal = {1}, .offset = 3});
    ghost.add_plane({.normal = {-1}, .offset = 3});
    ghost.add({});
    EXPECT_TRUE(lines_of(ghost).empty());
}

// Tangents to a circle of radius R leave room for R if they surround it: if no two neighbours are
// 180° or more apart.
TEST(RandomRooms, HaveTheRadiusOfTheirCircle) {
    int closed = 0;
    for (int seed = 0; seed < 10 * campaign_length(); ++seed) {
        Dice random(static_cast<std::uint64_t>(seed));
        const double radius = random.log_uniform(0.1, 10);
        const Vec3 centre{random.uniform(-5, 5), random.uniform(-5, 5)};
        std::vector<double> angles;
        std::vector<Plane> planes;
        for (int i = random.whole(2, 8); i > 0; --i) {
            angles.push_back(random.uniform(0, 2 * std::acos(-1.0)));
            const Vec3 normal{std::cos(angles.back()), std::sin(angles.back())};
            planes.push_back({.normal = normal, .offset = dot(normal, centre) - radius});
        }
        std::sort(angles.begin(), angles.end());
        double widest = angles.front() + 2 * std::acos(-1.0) - angles.back();
        for (std::size_t i = 1; i < angles.size(); ++i)
            widest = std::max(widest, angles[i] - angles[i - 1]);
        const bool is_closed = widest < std::acos(-1.0);
        closed += is_closed;
        EXPECT_TRUE(room_lines(ball(2, radius * (1 - 1e-6), planes)).empty()) << seed;
        EXPECT_EQ(!room_lines(ball(2, radius * (1 + 1e-6), planes)).empty(), is_closed) << seed;
    }
    EXPECT_GT(closed, campaign_length());
}

// Of 32 planes and more, sets of three are 4960 and more.
TEST(RoomWarning, IsGivenForTheFirstOfVeryManyPlanes) {
    std::vector<Plane> planes(3000, Plane{.normal = {1, 0}, .offset = -9});
    planes[1] = {.normal = {-1, 0}, .offset = -9};
    EXPECT_EQ(room_lines(ball(2, 9.5, planes)).size(), 1U);
    EXPECT_TRUE(room_lines(ball(2, 8.5, planes)).empty());
}

// ---- starts in obstacles

Bodies ball_at(const Vec3& x, double radius, const Obstacle& obstacle, int axes = 2) {
    Bodies bodies(axes, Precision::double_);
    bodies.add_obstacle(obstacle);
    bodies.add({.position = x, .contact = Contact{radius}});
    return bodies;
}

TEST(StartWarning, NamesTheObstacleAndTheDepth) {
    const Obstacle box{.shape = BoxShape{.centre = {1, 2.5}, .size = {2, 1}}};
    const auto lines = lines_of(ball_at({1.5, 3.25}, 0.5, box));
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0],
              "body 0 starts 0.25 m inside the box at (1, 2.5), and is lifted out at once, by 0.25 "
              "m to (1.5, 3.5): move it");
    EXPECT_TRUE(lines_of(ball_at({1.5, 3.5}, 0.5, box)).empty()) << "it lies on the box";
    Bodies ghost = ball_at({1.5, 3.25}, 0.5, box);
    ghost.set_contact(0, {});
    EXPECT_TRUE(lines_of(ghost).empty());
}

// A ball in a block of six tiles is lifted past all of them, to where a step of the scene has it.
TEST(StartWarning, NamesThePlaceOutsideAllObstacles) {
    Bodies bodies(2, Precision::double_);
    for (int i = 0; i < 6; ++i)
        bodies.add_obstacle({.shape = BoxShape{{i % 3 - 0.5, i / 3 + 0.5}, {1, 1}}});
    bodies.add({.position = {0, 0.5}, .contact = Contact{0.5}});
    const auto lines = lines_of(bodies);
    ASSERT_EQ(lines.size(), 1U);
    const double way = number_after(lines[0], "at once, by ");
    const double x = number_after(lines[0], " m to (");
    ASSERT_FALSE(bodies.try_step(find_method("velocity_verlet"), {{60}}));
    EXPECT_GE(way, 1.0) << "the nearest place outside, below the block";
    EXPECT_NEAR(length(bodies.position(0) - Vec3{0, 0.5}), way, 1e-2);
    EXPECT_NEAR(bodies.position(0)[0], x, 1e-3);
}

// Depths: beside a face, at a corner (3-4-5), in the middle, on a diagonal of a turned square.
TEST(StartWarning, KnowsTheDepthInEveryShape) {
    const double quarter_turn = std::acos(-1.0) / 4;
    struct Case {
        Shape shape;
        Vec3 x;
        double touching;  ///< radius
        int axes = 2;
    };
    const std::vector<Case> cases{
        {CircleShape{{1, 1}, 0.5}, {4, 5}, 4.5},
        {CircleShape{{1, 1, 1}, 0.5}, {2, 3, 3}, 2.5, 3},
        {SegmentShape{{0, 0}, {4, 0}}, {2, 3}, 3},
        {SegmentShape{{0, 0}, {4, 0}}, {7, 4}, 5},
        {SegmentShape{{0, 0}, {4, 0}}, {-3, -4}, 5},
        {BoxShape{{0, 0}, {4, 2}}, {1, 3}, 2},
        {BoxShape{{0, 0}, {4, 2}}, {5, -5}, 5},
        {BoxShape{{0, 0, 0}, {2, 2, 2}}, {3, 3, 2}, 3, 3},
        {BoxShape{{1}, {2}}, {5}, 3, 1},
        {BoxShape{{0, 0}, {2, 2}, quarter_turn}, {0, 3}, 3 - std::sqrt(2.0)},
    };
    for (const Case& one : cases) {
        const auto lines = [&](double radius) {
            return lines_of(ball_at(one.x, radius, {.shape = one.shape}, one.axes)).size();
        };
        EXPECT_EQ(lines(one.touching * (1 - 1e-6)), 0U) << one.touching;
        EXPECT_EQ(lines(one.touching * (1 + 1e-6)), 1U) << one.touching;
    }
    EXPECT_EQ(
        lines_of(ball_at({0.1, 0}, 0.5, {.shape = BoxShape{{0, 0}, {4, 2}}})).at(0).substr(0, 27),
        "body 0 starts 1.5 m inside ");
}

// A body that meets the layer of the floor alone starts in a box and below a plane of another
// layer, which it passes: the room between both planes is no room of its own.
TEST(StartWarning, IsNotGivenOfLayersThatTheBodyDoesNotMeet) {
    const auto lines = [](std::uint32_t meets) {
        Bodies bodies(2, Precision::double_);
        bodies.set_gravity({0, -9.81});
        bodies.add_obstacle({.shape = BoxShape{{0, 3}, {2, 2}}, .layers = 2});
        bodies.add_obstacle({.shape = HalfSpaceShape{{0, -1}, -1}, .layers = 2});
        bodies.add_obstacle({.shape = HalfSpaceShape{{0, 1}, 0}, .layers = 1});
        bodies.add({.position = {0, 3}, .contact = Contact{0.6, meets}});
        return lines_of(bodies).size();
    };
    EXPECT_EQ(lines(1), 0U);
    EXPECT_EQ(lines(3), 2U) << "the planes leave no room, and it starts in the box";
}

// Two bodies that start inside are lifted each to its own place.
TEST(StartWarning, NamesThePlaceOfEachBody) {
    Bodies bodies = ball_at({0, 0.9}, 0.5, {.shape = BoxShape{{}, {4, 2}}});
    bodies.add({.position = {1.5, -0.9}, .contact = Contact{0.25}});
    const auto lines = lines_of(bodies);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_NE(lines[0].find("by 0.6 m to (0, 1.5)"), std::string::npos) << lines[0];
    EXPECT_NE(lines[1].find("by 0.35 m to (1.5, -1.25)"), std::string::npos) << lines[1];
}

// 0.3 m above the second plane of offset 0.4/2 the ball of 0.5 m is 0.4 m too low.
TEST(StartWarning, IsGivenBelowAPlane) {
    Bodies bodies = ball_at({-5, 0.3}, 0.5, {.shape = HalfSpaceShape{{1, 0}, -10}});
    EXPECT_TRUE(lines_of(bodies).empty());
    bodies.add_plane({.normal = {0, 2}, .offset = 0.4});
    EXPECT_EQ(lines_of(bodies),
              std::vector<std::string>{
                  "body 0 starts 0.4 m inside plane 1, and is lifted out of it at once: move it"});
    EXPECT_FALSE(bodies.try_step(find_method("velocity_verlet"), {{60}}));
    EXPECT_NEAR(bodies.position(0)[1], 0.7, 1e-12);
    EXPECT_TRUE(lines_of(bodies).empty()) << "it lies on the plane";
}

// The nearest float to 0.1 is below 0.1.
TEST(StartWarning, IsNotGivenForTheRoundingOfFloat) {
    for (const double x : {0.1, 0.3, 7.7, 1000.1}) {
        Bodies bodies(2, Precision::single);
        bodies.add_plane({.normal = {0, 1}, .offset = x});
        bodies.add({.position = {0, x + 0.1}, .contact = Contact{0.1}});
        EXPECT_TRUE(lines_of(bodies).empty()) << x;
    }
}

TEST(StartWarning, IsNotGivenForOneWayObstacles) {
    const Obstacle ledge{.shape = BoxShape{.centre = {0, 0}, .size = {2, 1}},
                         .one_way = Vec3{0, 1}};
    EXPECT_TRUE(lines_of(ball_at({0, 0}, 0.5, ledge)).empty());
}

TEST(StartWarning, TellsThatPointsPassSegments) {
    const Obstacle segment{.shape = SegmentShape{{0, 0}, {4, 0}}};
    const auto lines = lines_of(ball_at({2, 3}, 0, segment));
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0],
              "body 0 is a point, which passes segments: give its contact a radius above 0");
    EXPECT_TRUE(lines_of(ball_at({2, 3}, 0.1, segment)).empty());
    EXPECT_TRUE(lines_of(ball_at({2, 3}, 0, {.shape = CircleShape{{0, 0}, 1}})).empty());
}

// ---- bounces

constexpr double g = 9.81;

Bodies thrown_up(double restitution, double speed, double height = 0) {
    Bodies bodies(2, Precision::double_);
    bodies.set_gravity({0, -g});
    bodies.add_plane({.normal = {0, 1}, .restitution = restitution});
    bodies.add({.position = {0, height}, .velocity = {1, speed}, .contact = Contact{}});
    return bodies;
}

// Semi-implicit Euler falls g·dt²/2 too far per step, and returns with g·dt = 0.16 m/s less.
TEST(BounceWarning, NamesTheLossAndTheRemedy) {
    const auto lines = warnings(thrown_up(1, 3), find_method("semi_implicit_euler"), rate);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with("body 0 on plane 0: semi_implicit_euler takes 0.16"))
        << lines[0];
    EXPECT_TRUE(holds(lines[0], " m/s from each bounce of up to 3 m/s")) << lines[0];
    EXPECT_TRUE(lines[0].ends_with(": take velocity_verlet")) << lines[0];
}

/// The mechanical energy after `seconds`, J.
double energy_after(Bodies bodies, const Method& method, int seconds) {
    EXPECT_FALSE(bodies.try_step(method, {rate, 0, seconds * rate.steps}));
    return bodies.energy().total() - 0.5;
}

// Elastic bounces keep 4.5 J. With methods of order 1 the ball rests or rises without end.
TEST(BounceWarning, IsGivenIfElasticBouncesEndOrGrow) {
    for (const Method& method : methods()) {
        const double energy = energy_after(thrown_up(1, 3), method, 10);
        const bool is_spoiled = std::abs(energy / 4.5 - 1) > 0.5;
        EXPECT_EQ(!warnings(thrown_up(1, 3), method, rate).empty(), is_spoiled)
            << method.name << " " << energy;
        EXPECT_EQ(is_spoiled, method.order == 1) << method.name;
    }
}

// Restitution takes more than the method, or there is nothing to be seen.
TEST(BounceWarning, IsNotGivenIfTheMethodTakesLittle) {
    const Method& euler = find_method("semi_implicit_euler");
    for (const double restitution : {0.0, 0.3, 0.6})
        EXPECT_TRUE(warnings(thrown_up(restitution, 3), euler, rate).empty()) << restitution;
    EXPECT_FALSE(warnings(thrown_up(0.95, 3), euler, rate).empty());
    EXPECT_TRUE(warnings(thrown_up(1, 3), euler, {10'000}).empty());
    EXPECT_TRUE(warnings(thrown_up(1, 0), euler, rate).empty());
    EXPECT_FALSE(warnings(thrown_up(1, 0, 0.5), euler, rate).empty());
    Bodies beside = thrown_up(1, 3);
    beside.set_contact(0, std::nullopt);
    EXPECT_TRUE(warnings(beside, euler, rate).empty());
    Bodies between_walls(1, Precision::double_);
    between_walls.add_plane({.normal = {1}, .restitution = 1});
    between_walls.add_plane({.normal = {-1}, .offset = -1, .restitution = 1});
    between_walls.add({.position = {0.5}, .velocity = {1}, .contact = Contact{}});
    EXPECT_TRUE(warnings(between_walls, euler, rate).empty());
}

/// The energy of true bounces after a time: each flight of the speed v takes 2v/g.
double true_energy(double restitution, double speed, double time) {
    double v = speed;
    for (double t = 2 * v / g; t <= time && v > 1e-3 * speed; t += 2 * v / g) v *= restitution;
    return v > 1e-3 * speed ? v * v / 2 : 0;
}

/// Whether a ball has less than a quarter of the energy of bounces that have a quarter of the
/// first one's, or bounces of eight steps when the true ones have ended for long.
bool is_spoiled(double restitution, double speed, const Method& method) {
    Bodies ball = thrown_up(restitution, speed);
    const double end = 4 * speed / (g * (1 - restitution));
    for (std::int64_t tick = 1; static_cast<double>(tick) < end * 60; ++tick) {
        EXPECT_FALSE(ball.try_step(method, {rate, tick - 1}));
        const double truth = true_energy(restitution, speed, static_cast<double>(tick) / 60);
        const double energy = ball.energy().total() - 0.5;
        if (truth > speed * speed / 8 && energy < truth / 4) return true;
    }
    return ball.energy().total() - 0.5 > std::pow(4 * g / 60, 2) / 2;
}

// c = g·dt = 0.16 m/s per bounce ends bounces early if c/(1 − e) > 0.286 of the first speed. A gain
// keeps up bounces of c/(1 − e), however fast the first one is.
TEST(BounceWarning, IsGivenIfBouncesEndEarlyOrNeverEnd) {
    for (const char* name : {"semi_implicit_euler", "semi_implicit_euler_drift_kick",
                             "implicit_euler", "velocity_verlet"})
        for (const double restitution : {0.7, 0.9, 0.95})
            for (const double speed : {3.0, 5.0, 8.0, 10.0, 15.0}) {
                const Method& method = find_method(name);
                EXPECT_EQ(!warnings(thrown_up(restitution, speed), method, rate).empty(),
                          is_spoiled(restitution, speed, method))
                    << name << restitution << " " << speed;
            }
}

// ---- springs without a direction

TEST(PointWarning, IsGivenIfTheSpringStaysWithoutDirection) {
    const Method& verlet = find_method("velocity_verlet");
    const CoilSpring coil{{1, 2}, 100, 0, 1};
    Bodies bodies(2, Precision::double_);
    bodies.add({.position = {1, 2}}, coil);
    const auto lines = warnings(bodies, verlet, rate);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0],
              "spring of body 0: both ends are in one point and stay there, because it has no "
              "direction: move the body");
    Bodies run = bodies;
    EXPECT_FALSE(run.try_step(verlet, {rate, 0, 10'000}));
    EXPECT_EQ(run.position(0), (Vec3{1, 2}));
    const auto is_point = [&] {
        const auto now = warnings(bodies, verlet, rate);
        return std::ranges::any_of(now, [](const auto& line) { return holds(line, "one point"); });
    };
    for (const Vec3& velocity : {Vec3{1e-3, 0}, Vec3{0, -5}}) {
        bodies.set_velocity(0, velocity);
        EXPECT_FALSE(is_point());
    }
    bodies.set_velocity(0, {});
    EXPECT_TRUE(is_point());
    bodies.set_gravity({0, -1});
    EXPECT_FALSE(is_point());
}

// While it is slack it needs no direction.
TEST(PointWarning, IsNotGivenForRopes) {
    Bodies bodies(2, Precision::double_);
    bodies.add({});
    bodies.link_to_point(0, {}, {.stiffness = 10, .rest_length = 0.5, .pulls_only = true});
    EXPECT_TRUE(warnings(bodies, find_method("velocity_verlet"), rate).empty());
}

TEST(PointWarning, IsGivenForLinks) {
    const Method& verlet = find_method("velocity_verlet");
    Bodies bodies(2, Precision::double_);
    bodies.set_gravity({0, -9.81});
    for (int i = 0; i < 2; ++i) bodies.add({.position = {1, 2}, .velocity = {1, 0}});
    bodies.link(0, 1, {.stiffness = 10, .rest_length = 0.5});
    const auto lines = warnings(bodies, verlet, rate);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with("link of bodies 0 and 1: both are in one point")) << lines[0];
    bodies.set_velocity(1, {2, 0});
    EXPECT_TRUE(warnings(bodies, verlet, rate).empty());
    Bodies hung(2, Precision::double_);
    hung.add({});
    hung.link_to_point(0, {}, {.stiffness = 10, .rest_length = 0.5});
    ASSERT_EQ(warnings(hung, verlet, rate).size(), 1U);
    EXPECT_TRUE(warnings(hung, verlet, rate)[0].starts_with("link of body 0 to a point"));
    Bodies without_length(2, Precision::double_);
    without_length.add({}, Spring{.stiffness = 10}, CoilSpring{{}, 0, 0, 1});
    EXPECT_TRUE(warnings(without_length, verlet, rate).empty());
}

// ---- swings

Bodies on_a_lift(double period, bool solid, std::optional<Contact> contact) {
    Bodies bodies(2, Precision::double_);
    bodies.set_gravity({0, -10});
    bodies.add_obstacle({.shape = BoxShape{.size = {4, 1}},
                         .swing = Swing{.way = {0, 0.2}, .period = period},
                         .solid = solid});
    bodies.add({.position = {0, 0.5}, .contact = contact});
    return bodies;
}

// A sine that is sampled twice per period may be 0 at all samples.
TEST(SwingWarning, IsGivenUpToTwoStepsPerPeriod) {
    for (const double steps : {0.5, 1.0, 1.5, 2.0, 2.1, 3.0, 48.0}) {
        const Bodies bodies = on_a_lift(steps / 60, true, Contact{});
        const auto lines = lines_of(bodies);
        ASSERT_EQ(lines.size(), steps <= 2 ? 1U : 0U) << steps;
        if (lines.empty()) continue;
        EXPECT_TRUE(holds(lines[0], fmt::format("the box at (0, 0) swings with {:.3g} steps per "
                                                "period",
                                                steps)));
        EXPECT_EQ(rate_in(lines[0]), std::llround(std::ceil(4 * 60 / steps)));
        EXPECT_TRUE(warnings(bodies, find_method("velocity_verlet"), {rate_in(lines[0])}).empty());
    }
    EXPECT_TRUE(lines_of(on_a_lift(1.0 / 60, false, Contact{})).empty());
    EXPECT_TRUE(lines_of(on_a_lift(1.0 / 60, true, std::nullopt)).empty());
}

}  // namespace
}  // namespace oiler::test
