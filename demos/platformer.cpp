// SPDX-License-Identifier: MIT
// A platform character: he runs, jumps, climbs ledges from below, rides a lift and a platform, and
// jumps off walls. The level is a chain and some boxes, and has no friction: his
// legs drive and hold him.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "oiler/oiler.hpp"

using namespace oiler;

namespace {

constexpr Axis walk{
    "walk", {Key::left, Key::a, Pad::left}, {Key::right, Key::d, Pad::right}, Stick::left_x};
constexpr Action jump{"jump", Key::space, Key::up, Key::w, Pad::south};
constexpr Action drop{"drop", Key::down, Key::s, Pad::down};
constexpr Action restart{"restart", Key::r, Pad::back};

constexpr double gravity = 30, take_off = 12.6, speed = 7;  // m/s², m/s, m/s
constexpr double drive = 70, air_drive = 35;                // m/s², of his legs
constexpr double patience = 0.1;  // s: a jump may come that late after a ledge, or early before one
constexpr double long_ago = -1;   // s
constexpr double radius = 0.4;    // m
constexpr Vec3 start{-12.5, radius};
constexpr std::array ground{Vec3{-14, 20},   Vec3{-14, 0},   Vec3{-8, 0},   Vec3{-4.5, 1.6},
                            Vec3{-1.5, 1.6}, Vec3{-1.5, -9}, Vec3{6.5, -9}, Vec3{6.5, 0.8},
                            Vec3{14, 0.8},   Vec3{14, 20}};
constexpr std::array coins{Vec3{-6.3, 1.5}, Vec3{-10.5, 8.3}, Vec3{2.5, 4.4},
                           Vec3{10, 5.9},   Vec3{13.2, 1.3},  Vec3{1, 9.1}};

}  // namespace

struct Platformer {
    static constexpr Control controls[] = {walk, jump, drop, restart};
    static constexpr About about{.name = "platformer",
                                 .title = "A platform character",
                                 .rate = 120,
                                 .method = "velocity_verlet",
                                 .duration = 14,
                                 .controls = controls};

    World world;
    Entity hero;
    double stood_at = long_ago, pressed_at = long_ago;  // s
    double facing = 1;
    std::array<bool, coins.size()> has{};
    int falls = 0;

    explicit Platformer(const Settings& settings) : world(2, settings) {
        world.set_gravity({0, -gravity});
        world.add_chain(ground, false, {});
        for (const Vec3& ledge :
             {Vec3{-10.5, 2.4}, {-7.2, 4.9}, {-10.5, 7.4}, {5.5, 6.6}, {1, 8.2}})
            world.add_obstacle({.shape = BoxShape{ledge, {3, 0.25}}, .one_way = Vec3{0, 1}});
        world.add_obstacle({.shape = BoxShape{{10, 2.9}, {1, 4.2}}});
        world.add_obstacle({.shape = BoxShape{{2.5, 1.4}, {2.4, 0.3}},
                            .friction = 0.2,
                            .swing = Swing{{2.6, 0}, 5}});
        world.add_obstacle({.shape = BoxShape{{7.9, 3}, {1.6, 0.25}},
                            .swing = Swing{{0, 1.8}, 4},
                            .one_way = Vec3{0, 1}});
        hero = world.spawn(Body{.position = start, .contact = Contact{radius}});
        world.add(hero, Look{.size = float(radius), .colour = palette::orange});
    }
    void hash(StateHash& hash) const { hash.add(stood_at, pressed_at, facing, has, falls); }
    std::vector<Reading> readings() const {
        return {{"coins", double(coins_found())}, {"falls", double(falls)}};
    }

    std::ptrdiff_t coins_found() const { return std::ranges::count(has, true); }

    void update(const Input& input, Loop& loop) {
        if (input.pressed(restart)) return loop.restart();
        const double wish = input.axis(walk);
        if (wish != 0) facing = wish > 0 ? 1 : -1;
        if (input.pressed(drop)) world.drop_through(hero);
        const auto floor = world.ground(hero);
        run(wish, floor);
        leap(input, floor);
        for (std::size_t i = 0; i < coins.size(); ++i)
            has[i] = has[i] || length(coins[i] - world.position(hero)) < 2 * radius;
        if (world.position(hero)[1] > -4) return;
        ++falls;
        world.teleport(hero, start);
        world.set_velocity(hero, {});
    }

    /// Drives him along the floor to a speed relative to it, and holds him on a slope.
    void run(double wish, const std::optional<Touch>& floor) {
        const Vec3 along = floor ? Vec3{floor->normal[1], -floor->normal[0]} : Vec3{1};
        const Vec3 slip = world.velocity(hero) - (floor ? floor->velocity : Vec3{});
        const double most = floor ? drive : air_drive;
        const double wanted = (speed * wish - dot(slip, along)) / world.dt();
        const double weight = floor ? gravity * along[1] : 0;
        world.apply_force(hero, (std::clamp(wanted, -most, most) + weight) * along);
    }

    /// Jumps off the floor, or off a wall. A jump ends early if its button is released.
    void leap(const Input& input, const std::optional<Touch>& floor) {
        const Vec3 v = world.velocity(hero);
        if (floor) stood_at = world.time();
        if (input.pressed(jump)) pressed_at = world.time();
        if (!input.held(jump) && v[1] > take_off / 2)
            world.set_velocity(hero, {v[0], take_off / 2});
        if (world.time() - pressed_at > patience) return;
        if (world.time() - stood_at <= patience)
            return take({v[0], take_off + (floor ? std::max(0.0, floor->velocity[1]) : 0)});
        for (const Touch& touch : world.touches(hero))
            if (std::abs(touch.normal[1]) < 0.5) return take({speed * touch.normal[0], take_off});
    }
    void take(const Vec3& velocity) {
        world.set_velocity(hero, velocity);
        stood_at = pressed_at = long_ago;
    }

    Picture picture() const {
        Picture picture = draw_looks(world, {.centre = {0, 5.5F}, .height = 15.75F});
        std::vector<Point> outline;
        for (const Vec3& point : ground) outline.push_back(to_point(point));
        outline.insert(outline.end(), {{16, 20}, {16, -12}, {-16, -12}, {-16, 20}});
        picture.polygons.push_back(
            {.points = std::move(outline), .colour = palette::pale, .layer = -1});
        for (std::size_t i = 0; i < coins.size(); ++i)
            if (!has[i])
                picture.discs.push_back({{}, to_point(coins[i]), 0.25F, palette::vermilion});
        const Point at = to_point(world.position(hero) + Vec3{0.18 * facing, 0.1});
        picture.discs.push_back({key_of(world, hero, 1), at, 0.08F, palette::ink});
        picture.labels = {
            {{}, {12, 340}, fmt::format("coins {} of 6   falls {}", coins_found(), falls), 14},
            {{}, {370, 340}, "← → run, Space jumps, off walls too, ↓ drops", 10, palette::grey}};
        return picture;
    }
};

int main(int argc, char** argv) { return run<Platformer>(argc, argv); }
