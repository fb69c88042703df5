// SPDX-License-Identifier: MIT
// A rain of balls on slopes. It has no picture(): each ball has a Look.
#include <array>

#include "oiler/oiler.hpp"

using namespace oiler;

namespace {

constexpr Action burst{"burst", Key::space, Mouse::left, Pad::south};
constexpr std::array colours{palette::orange, palette::sky_blue,  palette::green,
                             palette::blue,   palette::vermilion, palette::purple};

struct Drop {
    int balls;
};
struct Leave {
    Entity ball;
};

}  // namespace

struct Bounce {
    static constexpr Control controls[] = {burst};
    static constexpr About about{.name = "bounce",
                                 .title = "A rain of balls: Space for a burst",
                                 .rate = 60,
                                 .method = "velocity_verlet",
                                 .controls = controls};

    World world;
    Camera camera{.centre = {0, 5}, .height = 13};

    explicit Bounce(const Settings& settings) : world(2, settings) {
        world.set_gravity({0, -9.81});
        world.add_plane({.normal = {3, 4}, .offset = -12, .restitution = 0.8, .friction = 0.1});
        world.add_plane({.normal = {-1, 4}, .restitution = 0.6, .friction = 0.02});
        world.schedule(0, Drop{1});
    }

    void update(const Input& input) {
        world.due<Leave>([&](Leave leave) { world.destroy(leave.ball); });
        world.due<Drop>([&](Drop drop) {
            for (int i = 0; i < drop.balls; ++i) drop_ball();
            world.schedule(0.08, drop);
        });
        for (int i = 0; i < 40 * input.presses(burst); ++i) drop_ball();
    }

    void drop_ball() {
        Random& random = world.random();
        const double radius = random.uniform(0.12, 0.4);
        const Entity ball = world.spawn(Body{.mass = radius * radius,
                                             .position = {random.uniform(-8, 9), 13},
                                             .velocity = {random.uniform(-2, 2), 0},
                                             .contact = Contact{radius}});
        world.add(ball, Look{.size = static_cast<float>(radius),
                             .colour = colours[random.below(colours.size())]});
        world.schedule(7, Leave{ball});
    }
};

int main(int argc, char** argv) { return run<Bounce>(argc, argv); }
