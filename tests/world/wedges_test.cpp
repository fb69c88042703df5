// SPDX-License-Identifier: MIT
// Bodies between several planes: wedges, corners, valleys and edges.
#include "world/contacts.hpp"

namespace oiler::test {
namespace {

// Without gravity, a ball in a wedge of angle w bounces ⌈π/w⌉ or ⌈π/w⌉ − 1 times and leaves (unfold
// the wedge: its path is a straight line across half a turn).
TEST(Landing, LeavesAWedgeOfOneDegree) {
    const double angle = std::acos(-1.0) / 180;
    World world = world_of("velocity_verlet", 1, 2, {},
                           {{.normal = {0, 1}, .restitution = 1},
                            {.normal = {std::sin(angle), -std::cos(angle)}, .restitution = 1}});
    const Entity ball = world.spawn(
        {.position = {10, 10 * std::sin(angle / 2)}, .velocity = {-5, 0.01}, .contact = Contact{}});
    const int met = count(world, 20);
    EXPECT_GE(met, 179);
    EXPECT_LE(met, 180);
    EXPECT_GT(world.velocity(ball)[0], 4.9);
    EXPECT_NEAR(length(world.velocity(ball)), std::hypot(5, 0.01), 180 * 8 * epsilon * 5);
}

// A body on the left side of a narrow valley leaves the right one so slowly that its hop is lower
// than round-off shows. The forces press it into the left side only, yet along that they lead it
// back into the right one, where it stays.
TEST(Landing, EndsAHopThatRoundOffHides) {
    const double slope = 0.1;
    for (const double speed : {1e-9, 1e-8, 5e-8}) {
        World world = world_of("velocity_verlet", 1, 2, {-1.2, -10},
                               {{.normal = {1, slope}, .offset = 1 + slope},
                                {.normal = {-1, slope}, .offset = -1 + slope}});
        const Vec3 up = Vec3{-slope, 1} * (1 / std::hypot(slope, 1));
        const Entity ball =
            world.spawn({.position = {1, 1}, .velocity = up * speed, .contact = Contact{}});
        world.step();
        EXPECT_NEAR(length(world.position(ball) - Vec3{1, 1}), 0, 64 * epsilon / slope) << speed;
        EXPECT_LE(length(world.velocity(ball)), speed);
        for (const Impact& impact : world.impacts()) EXPECT_NE(impact.kind, Meeting::lifted);
    }
}

// In float, a body slides up over an edge that turns by 0.002: it loses 2·sin 0.002 into the second
// plane, and slides on with the rest.
TEST(Landing, SlidesOverAGentleEdge) {
    for (const double edge : {0.001, 0.002, 0.01}) {
        World world = world_of("velocity_verlet", 60, 2, {0, -g}, {}, Precision::single);
        const double slope = 0.06;
        for (const double angle : {slope, slope + edge}) {
            const Vec3 normal{-std::sin(angle), std::cos(angle)};
            world.add_plane({.normal = normal, .offset = 3 * normal[0]});
        }
        const Vec3 up{std::cos(slope), std::sin(slope)};
        const Entity body = world.spawn(
            {.position = Vec3{3, 0} - up * 0.5, .velocity = up * 2, .contact = Contact{}});
        world.step(30);
        // From the edge, at √(4 − 2·g·sin(slope)·0.5) times cos(edge), on the second slope.
        const double a = g * std::sin(slope);
        const double at_edge = std::sqrt(4 - a);
        const double left = 0.5 - (2 - at_edge) / a;
        const double v = at_edge * std::cos(edge) - g * std::sin(slope + edge) * left;
        EXPECT_NEAR(length(world.velocity(body)), v, 2e-5) << edge;
    }
}

// At the vertex of a corner with an elastic side, a slow body touches both planes. It does not
// slide through one of them for the rest of the step.
TEST(Landing, StaysInACornerThatItTouches) {
    World world = world_of("exact", 60, 2, {0, -25.609039316005063},
                           {{.normal = {0.40008476415060629, 0.91647814021642315},
                             .offset = 1.3038620108926484,
                             .restitution = 0.57638829485699161,
                             .friction = 0.17904735242018804},
                            {.normal = {-0.80182430466980359, 0.5975598584583689},
                             .offset = 5.0342552124278139,
                             .restitution = 1,
                             .friction = 0.65132953883984633}});
    const Entity body = world.spawn({.position = {-3.9372983946529017, 3.1414989448935708},
                                     .velocity = {3.2574883014119913e-07, 7.0054182787477254e-07},
                                     .contact = Contact{}});
    for (int step = 0; step < 10; ++step) {
        world.step();
        EXPECT_LE(length(world.velocity(body)), 1e-6);
        for (const Impact& impact : world.impacts()) EXPECT_NE(impact.kind, Meeting::lifted);
    }
}

// Flights under gravity are exact, and planes take energy away. A body that slid through the other
// plane of a wedge for the rest of a step would gain up to g·dt per second.
TEST(Landing, GivesABodyInAWedgeNoEnergy) {
    Dice dice(1);
    for (int i = 0; i < 400; ++i) {
        const int rate = i % 2 == 0 ? 5 : 20;
        World world = world_of("velocity_verlet", rate, 2, {0, -g});
        const double elastic = i % 4 < 2 ? 1 : dice.uniform(0.96, 0.999);
        for (const double side : {dice.uniform(0.2, 1), -dice.uniform(0.2, 1)})
            world.add_plane({.normal = {side, 1},
                             .restitution = side > 0 ? 1 : elastic,
                             .friction = dice.uniform(0.05, 0.5)});
        const Entity ball =
            world.spawn({.position = {dice.uniform(-0.3, 0.3), 1}, .contact = Contact{}});
        const auto energy = [&] {
            const Vec3 v = world.velocity(ball);
            return dot(v, v) / 2 + g * world.position(ball)[1];
        };
        const double start = energy();
        double before = start;
        for (int step = 0; step < 10 * rate; ++step) {
            world.step();
            ASSERT_LE(energy(), before + 1e-12 * start) << i << ", step " << step;
            before = energy();
        }
    }
}

/// Where a ball rests that friction without limit stops at each impact: it leaves a plane along
/// its normal and flies on a parabola to the next one.
Vec3 rest_of_sticking_ball(Vec3 x, Vec3 v, const std::vector<Plane>& planes) {
    for (int impact = 0; impact < 10000; ++impact) {
        double first = std::numeric_limits<double>::infinity();
        const Plane* met = nullptr;
        for (const Plane& plane : planes) {
            const double size = length(plane.normal);
            const double h = std::max(dot(plane.normal, x) / size, 0.0);
            const double u = dot(plane.normal, v) / size;
            const double pull = g * plane.normal[1] / size;
            const double t = (u + std::sqrt(u * u + 2 * pull * h)) / pull;
            if (t > 0 && t < first) {
                first = t;
                met = &plane;
            }
        }
        if (first < 1e-12) break;
        x = x + v * first + Vec3{0, -g / 2 * first * first};
        v[1] -= g * first;
        const Vec3 normal = met->normal / length(met->normal);
        v = normal * (-met->restitution * dot(normal, v));
    }
    return x;
}

// Friction never adds energy. From some size on it holds whatever touches a plane.
TEST(Landing, HugeFrictionHolds) {
    Dice dice(3);
    for (int i = 0; i < 60; ++i) {
        const double e = dice.uniform(0, 0.7);
        std::vector<Plane> planes;
        for (const double side : {dice.uniform(0.2, 1.5), -dice.uniform(0.2, 1.5)})
            planes.push_back({.normal = {side, 1}, .restitution = e});
        const Vec3 x{dice.uniform(-0.3, 0.3), 1};
        const Vec3 v{dice.uniform(-2, 2), dice.uniform(-2, 2)};
        const Vec3 rest = rest_of_sticking_ball(x, v, planes);
        for (const double friction : {1e16, 1e100, 1e150, 1e300}) {
            for (Plane& plane : planes) plane.friction = friction;
            for (const char* method : exact_flights)
                for (const int rate : {5, 60}) {
                    World world = world_of(method, rate, 2, {0, -g}, planes);
                    const Entity ball =
                        world.spawn({.position = x, .velocity = v, .contact = Contact{}});
                    world.step(10 * rate);
                    EXPECT_NEAR(length(world.position(ball) - rest), 0, 1e-9)
                        << i << method << rate << ", friction " << friction;
                    EXPECT_EQ(world.velocity(ball), Vec3{});
                }
        }
    }
}

// The kick of a step ends a slide on rough planes within 10⁻¹⁵⁰ s. The error of a flight's energy
// is up to g·dt·|v|/2.
TEST(Landing, HugeFrictionAddsNoEnergy) {
    Dice dice(4);
    for (int i = 0; i < 1000; ++i) {
        const int rate = i % 2 == 0 ? 20 : 60;
        const int axes = i % 4 == 0 ? 3 : 2;
        World world = world_of("semi_implicit_euler", rate, axes, {0, -g});
        const double friction = std::pow(10, dice.uniform(0, 300));
        for (int plane = 0; plane < 1 + i % 5; ++plane)
            world.add_plane(
                {.normal = {dice.uniform(-1.5, 1.5), 1, axes == 3 ? dice.uniform(-1.5, 1.5) : 0},
                 .restitution = dice.chance(0.5) ? 0 : dice.uniform(0, 1),
                 .friction = dice.chance(0.3) ? 0 : friction});
        const Entity ball = world.spawn({.position = {dice.uniform(-0.3, 0.3), 3},
                                         .velocity = {dice.uniform(-4, 4)},
                                         .contact = Contact{}});
        for (int step = 0; step < 5 * rate; ++step) {
            world.step();
            const Vec3 velocity = world.velocity(ball);
            const double energy = dot(velocity, velocity) / 2 + g * world.position(ball)[1];
            const double start = 3 * g + 8;
            ASSERT_LE(energy, start + g / rate * std::sqrt(2 * start))
                << i << ", friction " << friction << ", step " << step;
        }
    }
}

// The nearest place above both planes is where they meet, 1 m away: moves onto one after the other
// would go there in 10⁶ moves.
TEST(Landing, LiftsOutOfANarrowWedge) {
    for (const double angle : {1e-1, 1e-3}) {
        World world = world_of("rk4", 60, 2);
        const double c = std::cos(angle / 2);
        const double s = std::sin(angle / 2);
        world.add_plane({.normal = {s, c}});
        world.add_plane({.normal = {s, -c}});
        const Entity ball = world.spawn({.position = {-1, 0}, .contact = Contact{}});
        world.step();
        EXPECT_NEAR(world.position(ball)[0], 0, 16 * epsilon / angle);
        EXPECT_NEAR(world.position(ball)[1], 0, 4 * epsilon);
        EXPECT_EQ(world.impacts().size(), 2U);
        EXPECT_EQ(world.impacts()[0].kind, Meeting::lifted);
    }
}

// A move out of one side of a valley goes below the other, the more so the narrower the valley is.
TEST(Landing, LeavesNoLinkedBodyBelowANarrowValley) {
    constexpr double degree = 3.14159265358979323846 / 180;
    for (const double half : {60 * degree, 30 * degree, 15 * degree, 5 * degree}) {
        World world = world_of("velocity_verlet", 60, 2, {0, -g});
        const std::array sides{Vec3{std::cos(half), std::sin(half)},
                               Vec3{-std::cos(half), std::sin(half)}};
        for (const Vec3& side : sides) world.add_plane({.normal = side, .restitution = 0.3});
        const std::array balls{world.spawn({.position = {0.01, 2}, .contact = Contact{}}),
                               world.spawn({.position = {-0.02, 2.5}, .contact = Contact{}})};
        world.link(balls[0], balls[1], {.stiffness = 50, .damping = 1, .rest_length = 0.5});
        for (int step = 0; step < 300; ++step) {
            world.step();
            for (const Entity ball : balls)
                for (const Vec3& side : sides)
                    ASSERT_GE(dot(side, world.position(ball)), -4 * epsilon)
                        << half / degree << "° at step " << step;
        }
    }
}

TEST(Landing, NeverLeavesABodyBelowAPlane) {
    for (const Precision precision : {Precision::single, Precision::double_}) {
        const std::vector<Plane> planes{
            {.normal = {0, 1, 0}, .restitution = 0.8, .friction = 0.3},
            {.normal = {1, 1, 0}, .offset = -3, .restitution = 0.5},
            {.normal = {-2, 1, 1}, .offset = -8, .restitution = 1, .friction = 0.1},
            {.normal = {0, 0, -1}, .offset = -4, .restitution = 0}};
        World world = world_of("velocity_verlet", 60, 3, {0, -g, 0}, planes, precision);
        Dice dice(7);
        const auto uniform = [&](double from, double to) { return dice.uniform(from, to); };
        std::vector<std::pair<Entity, double>> balls;
        for (int i = 0; i < 2000; ++i) {
            const double radius = i % 3 == 0 ? 0 : uniform(0, 0.4);
            const double speed = std::pow(10, uniform(-3, 4));
            balls.emplace_back(
                world.spawn({.position = {uniform(0, 2), uniform(1, 4), uniform(0, 2)},
                             .velocity = {speed * uniform(-1, 1), speed * uniform(-1, 1),
                                          speed * uniform(-1, 1)},
                             .contact = Contact{radius}}),
                radius);
        }
        const double unit = precision == Precision::single ? 1.2e-7 : epsilon;
        for (int step = 0; step < 120; ++step) {
            world.step();
            for (const auto& [ball, radius] : balls) {
                const Vec3 x = world.position(ball);
                for (const Plane& plane : planes) {
                    const double gap =
                        (dot(plane.normal, x) - plane.offset) / length(plane.normal) - radius;
                    ASSERT_GE(gap, -8 * unit * (length(x) + 4.4)) << "step " << step;
                }
            }
        }
    }
}

}  // namespace
}  // namespace oiler::test
