// SPDX-License-Identifier: MIT
// A cannon aims and fires.
#include "oiler/oiler.hpp"

using namespace oiler;

constexpr Axis aim{"aim", Key::down, Key::up, Stick::left_y};
constexpr Action fire{"fire", Key::space, Mouse::left, Pad::south};
constexpr Vec3 pivot{2, 1};   // m
constexpr double speed = 20;  // m/s

struct Cannon {
    static constexpr Control controls[] = {aim, fire};
    static constexpr About about{.name = "step2",
                                 .title = "Cannon, step 2",
                                 .method = "velocity_verlet",
                                 .controls = controls};

    World world;
    Vec3 direction{0.8, 0.6};

    explicit Cannon(const Settings& settings) : world(2, settings) {
        world.set_gravity({0, -9.81});
    }

    void update(const Input& input) {
        // A turn by a small angle without a sine: the same bits on every machine.
        const Vec3 left{-direction[1], direction[0]};
        direction = normalised(direction + world.dt() * input.axis(aim) * left);
        if (input.pressed(fire)) {
            const Entity ball =
                world.spawn(Body{.position = pivot + 2 * direction, .velocity = speed * direction});
            world.add(ball, Look{.size = 0.3F});
        }
    }

    Picture picture() const {
        Picture picture = draw_looks(world, {.centre = {16, 8}, .height = 20});
        const Point muzzle = to_point(pivot + 2 * direction);
        picture.polylines.push_back(
            {.points = {to_point(pivot), muzzle}, .width = 12, .colour = palette::ink});
        return picture;
    }
};

int main(int argc, char** argv) { return run<Cannon>(argc, argv); }
