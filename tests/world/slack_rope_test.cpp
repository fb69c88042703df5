// SPDX-License-Identifier: MIT
// A slack rope exerts no force: a ball on it lands as one without it.
#include "world/contacts.hpp"

namespace oiler::test {
namespace {

struct Ball {
    Ball(int rate, const Body& body, bool on_rope)
        : world(2, Stepping{.method = &find_method("velocity_verlet"), .rate = {rate}}) {
        world.set_gravity({0, -20});
        entity = world.spawn(body);
        const Link rope{.stiffness = 300, .rest_length = 30, .pulls_only = true};
        if (on_rope) world.link_to_point(entity, {0, 5}, rope);
    }

    World world;
    Entity entity;
};

/// Steps a ball with a slack rope and one without for `seconds`, and compares them: both move on
/// parabolas between impacts, so that they differ by round-off.
template <class AddObstacles>
void expect_the_same(int rate, const Body& body, double seconds, AddObstacles add) {
    Ball free(rate, body, false);
    Ball linked(rate, body, true);
    add(free.world);
    add(linked.world);
    for (int i = 0; i < static_cast<int>(seconds * rate); ++i) {
        free.world.step();
        linked.world.step();
        const Vec3 x = linked.world.position(linked.entity);
        const Vec3 v = linked.world.velocity(linked.entity);
        for (const int axis : {0, 1}) {
            ASSERT_NEAR(x[axis], free.world.position(free.entity)[axis], 1e-9) << rate;
            ASSERT_NEAR(v[axis], free.world.velocity(free.entity)[axis], 1e-8) << rate;
        }
        ASSERT_EQ(linked.world.impacts().size(), free.world.impacts().size());
    }
}

TEST(SlackRope, ChangesNoLandingOnTiles) {
    Dice dice(11);
    for (int run = 0; run < 300; ++run) {
        const double radius = dice.uniform(0.1, 0.5);
        const Body ball{.position = {dice.uniform(-1, 1), radius + dice.uniform(0, 1)},
                        .velocity = {dice.uniform(-3, 3), -dice.uniform(0, 12)},
                        .contact = Contact{radius}};
        const double restitution = dice.chance(0.5) ? 0.5 : 0;
        const double friction = dice.chance(0.5) ? 0.3 : 0;
        expect_the_same(30 << dice.whole(0, 2), ball, 1, [&](World& world) {
            for (int i = -6; i <= 6; ++i)
                world.add_obstacle({.shape = BoxShape{{double(i), -0.5}, {1, 1}},
                                    .restitution = restitution,
                                    .friction = friction});
        });
    }
}

// A lift presses the ball against a ceiling, and passes.
TEST(SlackRope, ChangesNoCrush) {
    for (const double speed : {0.3, 1.0, 2.0})
        for (const double friction : {0.0, 0.3}) {
            const Body ball{
                .position = {0.1, 0.3}, .velocity = {0.2, speed}, .contact = Contact{0.3}};
            expect_the_same(60, ball, 0.1 / speed, [&](World& world) {
                world.add_obstacle({.shape = BoxShape{{0, -0.1}, {3, 0.2}},
                                    .friction = friction,
                                    .velocity = {0, speed}});
                world.add_obstacle({.shape = BoxShape{{0, 0.75}, {3, 0.2}}, .friction = friction});
            });
        }
}

}  // namespace
}  // namespace oiler::test
