// SPDX-License-Identifier: MIT
#include <oiler/oiler.hpp>
#include <string>
using namespace oiler;

static constexpr Axis roll{"roll", Key::left, Key::right, Stick::left_x};
static constexpr Action jump{"jump", Key::space, Mouse::left, Pad::south};
static constexpr Control controls[] = {roll, jump};

struct Game {  // a ball that bounces after a lantern on a spring
    static constexpr About about{.name = "game",
                                 .title = "game",
                                 .rate = 120,
                                 .method = "velocity_verlet",
                                 .controls = controls};
    World world;
    Collisions collisions;
    Entity ball, lantern;
    Vec3 hook;  // m, of the lantern
    int score = 0;

    explicit Game(const Settings& settings) : world(2, settings) {
        world.set_gravity({0, -15});                               // m/s²
        const Vec3 room[] = {{-8, 99}, {-8, 0}, {8, 0}, {8, 99}};  // m: a wall, the floor, a wall
        world.add_chain(room, false, {.restitution = 0.75, .friction = 0.1});
        world.add_obstacle({.shape = BoxShape{{0.6, 0.2}, {2, 0.4}}, .restitution = 0.75});  // step
        ball = world.spawn(Body{.position = {-5, 3}, .contact = Contact{0.4}}, LinearDrag{0.2});
        world.add(ball, Look{.size = 0.4F, .colour = palette::blue});
        hang_lantern();
    }

    void hang_lantern() {
        hook = {world.random().uniform(-6, 6), world.random().uniform(3, 5)};
        lantern = world.spawn(Body{.position = hook, .contact = Contact{0.3}},
                              Spring{.anchor = hook, .stiffness = 12, .damping = 0.5});
        world.add(lantern, Look{.size = 0.3F, .colour = palette::orange});
    }

    void update(const Input& input) {
        world.apply_force(ball, {12 * input.axis(roll), 0});  // N, over the next step
        if (input.pressed(jump) && world.position(ball)[1] < 1) world.apply_impulse(ball, {0, 9});
        collisions.update(world);
        if (collisions.pairs().empty()) return;
        ++score;
        world.destroy(lantern);
        hang_lantern();
    }

    Picture picture() const {
        Picture picture = draw_looks(world, {.centre = {0, 4}, .height = 9.5F});
        const Point light = to_point(world.position(lantern));
        picture.polylines.push_back(
            {key_of(world, lantern), coil(to_point(hook), light, 6, 0.15F), 2, palette::grey});
        const std::string text = std::to_string(score);
        picture.labels = {{{}, {12, 12}, "Left and Right roll, Space jumps", 12, palette::grey},
                          {.at = {16, 332}, .text = text, .size = 24, .space = Space::upper_left}};
        return picture;
    }
};

int main(int argc, char** argv) { return run<Game>(argc, argv); }
