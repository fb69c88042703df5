// SPDX-License-Identifier: MIT
// Targets hang on springs, and a ball that meets one destroys it.
#include "oiler/oiler.hpp"

using namespace oiler;

constexpr Axis aim{"aim", Key::down, Key::up, Stick::left_y};
constexpr Action fire{"fire", Key::space, Mouse::left, Pad::south};

constexpr Vec3 pivot{2, 1};   // m
constexpr double speed = 20;  // m/s

struct Ball {};
struct Target {
    Vec3 hook;  // m
    void hash(StateHash& hash) const { hash.add(hook); }
};
struct Expire {
    Entity ball;
};

struct Cannon {
    static constexpr Control controls[] = {aim, fire};
    static constexpr About about{.name = "step4",
                                 .title = "Cannon, step 4",
                                 .method = "velocity_verlet",
                                 .controls = controls};

    World world;
    Vec3 direction{0.8, 0.6};
    Collisions collisions;

    explicit Cannon(const Settings& settings) : world(2, settings) {
        world.set_gravity({0, -9.81});
        world.add_plane({.normal = {0, 1}, .restitution = 0.6, .friction = 0.2});
        world.add_plane({.normal = {-1, 0}, .offset = -32, .restitution = 0.7});
        hang_target({20, 12});
        hang_target({26, 8});
    }

    void hang_target(const Vec3& hook) {
        const Body body{.mass = 2, .position = hook - Vec3{0, 3}, .contact = Contact{0.8}};
        const Entity target = world.spawn(body);
        world.link_to_point(target, hook, Link{.stiffness = 30, .rest_length = 2});
        world.add(target, Look{.size = 0.8F, .colour = palette::vermilion});
        world.add(target, Target{hook});
    }

    void update(const Input& input) {
        find_hits();
        world.due<Expire>([&](Expire due) { world.destroy(due.ball); });
        // A turn by a small angle without a sine: the same bits on every machine.
        const Vec3 left{-direction[1], direction[0]};
        direction = normalised(direction + world.dt() * input.axis(aim) * left);
        if (input.pressed(fire)) {
            const Entity ball = world.spawn(Body{.position = pivot + 2 * direction,
                                                 .velocity = speed * direction,
                                                 .contact = Contact{0.3}});
            world.add(ball, Look{.size = 0.3F});
            world.add(ball, Ball{});
            world.schedule(6, Expire{ball});
        }
    }

    void find_hits() {
        collisions.update(world);
        collisions.each<Ball, Target>(
            world, [&](Entity, Ball&, Entity target, Target&) { world.destroy(target); });
    }

    Picture picture() const {
        Picture picture = draw_looks(world, {.centre = {16, 8}, .height = 20});
        const Point muzzle = to_point(pivot + 2 * direction);
        picture.polylines.push_back(
            {.points = {to_point(pivot), muzzle}, .width = 12, .colour = palette::ink});
        world.each<Target>([&](Entity entity, const Target& target) {
            const Point at = to_point(world.position(entity));
            picture.polylines.push_back({.key = key_of(world, entity),
                                         .points = coil(to_point(target.hook), at, 7, 0.3F),
                                         .width = 1.5F,
                                         .colour = palette::grey});
        });
        return picture;
    }
};

int main(int argc, char** argv) { return run<Cannon>(argc, argv); }
