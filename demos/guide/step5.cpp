// SPDX-License-Identifier: MIT
// There are a score, levels, a restart and a menu.
#include <fmt/core.h>

#include "oiler/oiler.hpp"

using namespace oiler;

constexpr Axis aim{"aim", Key::down, Key::up, Stick::left_y};
constexpr Action fire{"fire", Key::space, Mouse::left, Pad::south};
constexpr Action menu{"menu", Key::escape, Pad::start};
constexpr Action restart{"restart", Key::r, Pad::back};
constexpr Action quit{"quit", Key::q, Pad::north};

constexpr Vec3 pivot{2, 1};   // m
constexpr double speed = 20;  // m/s

/// The hooks of the targets, m.
constexpr std::array levels{std::array{Vec3{20, 12}, Vec3{26, 8}},
                            std::array{Vec3{12, 12}, Vec3{29, 13}},
                            std::array{Vec3{18, 17}, Vec3{24, 8}}};
struct Ball {};
struct Target {
    Vec3 hook;  // m
    void hash(StateHash& hash) const { hash.add(hook); }
};
struct Expire {
    Entity ball;
};

struct Cannon {
    static constexpr Control controls[] = {aim, fire, menu, restart, quit};
    static constexpr About about{.name = "step5",
                                 .title = "Cannon, step 5",
                                 .method = "velocity_verlet",
                                 .controls = controls};

    World world;
    Collisions collisions;
    bool is_paused = false;
    Vec3 direction{0.8, 0.6};
    std::size_t level = 0;
    int score = 0;

    explicit Cannon(const Settings& settings) : world(2, settings) {
        world.set_gravity({0, -9.81});
        world.add_plane({.normal = {0, 1}, .restitution = 0.6, .friction = 0.2});
        world.add_plane({.normal = {-1, 0}, .offset = -32, .restitution = 0.7});
        for (const Vec3& hook : levels[0]) hang_target(hook);
    }

    void hang_target(const Vec3& hook) {
        const Body body{.mass = 2, .position = hook - Vec3{0, 3}, .contact = Contact{0.8}};
        const Entity target = world.spawn(body);
        world.link_to_point(target, hook, Link{.stiffness = 30, .rest_length = 2});
        world.add(target, Look{.size = 0.8F, .colour = palette::vermilion});
        world.add(target, Target{hook});
    }
    bool has_targets() const { return world.count<Target>() > 0; }

    void update(const Input& input, Loop& loop) {
        if (input.pressed(restart)) loop.restart();
        if (input.pressed(menu)) is_paused = !is_paused;
        if (is_paused && input.pressed(quit)) loop.quit();
        if (is_paused) return loop.hold();
        find_hits();
        world.due<Expire>([&](Expire due) { world.destroy(due.ball); });
        if (!has_targets() && level + 1 < levels.size())
            for (const Vec3& hook : levels[++level]) hang_target(hook);
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
        collisions.each<Ball, Target>(world, [&](Entity, Ball&, Entity target, Target&) {
            score += 100;
            world.destroy(target);
        });
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
        std::string text = fmt::format("Level {}   Score {}", level + 1, score);
        if (!has_targets()) text += "   You win. R: restart";
        if (is_paused) text = "Escape: resume   R: restart   Q: quit";
        picture.labels.push_back(
            {.at = {16, 336}, .text = text, .size = 16, .space = Space::upper_left});
        return picture;
    }
};

int main(int argc, char** argv) { return run<Cannon>(argc, argv); }
