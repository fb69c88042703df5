// SPDX-License-Identifier: MIT
// A platform character: he runs, jumps, climbs ledges from below, rides a lift and a platform,
// jumps off walls, and swings on a rope. The level is a chain and some boxes, and has no friction:
// his legs drive and hold him.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "oiler/oiler.hpp"

using namespace oiler;

constexpr Axis walk{
    "walk", {Key::left, Key::a, Pad::left}, {Key::right, Key::d, Pad::right}, Stick::left_x};
constexpr Action jump{"jump", Key::space, Key::up, Key::w, Pad::south};
constexpr Action drop{"drop", Key::down, Key::s, Pad::down};
constexpr Action grab{"grab", Key::e, Mouse::left, Pad::west};

constexpr double gravity = 30, take_off = 12.6, speed = 7;     // m/s², m/s, m/s
constexpr double drive = 70, air_drive = 35, rope_drive = 10;  // m/s², of his legs
constexpr double patience = 0.1;  // s: a jump may come that late after a ledge, or early before one
constexpr double radius = 0.4, reach = 5;  // m, of the hero and of his rope
constexpr Vec3 start{-12.5, radius}, hook{-5, 11};
constexpr std::array ground{Vec3{-14, 20},   Vec3{-14, 0},   Vec3{-8, 0},   Vec3{-4.5, 1.6},
                            Vec3{-1.5, 1.6}, Vec3{-1.5, -9}, Vec3{6.5, -9}, Vec3{6.5, 0.8},
                            Vec3{14, 0.8},   Vec3{14, 20}};
constexpr std::array coins{Vec3{-6.3, 1.5}, Vec3{-10.5, 8.3}, Vec3{2.5, 4.4}, Vec3{10, 5.9},
                           Vec3{13.2, 1.3}, Vec3{1, 9.1},     Vec3{-3.8, 6.2}};

struct Platformer {
    static constexpr Control controls[] = {walk, jump, drop, grab};
    static constexpr About about{.name = "platformer",
                                 .title = "Platformer: seven coins, a lift and a rope",
                                 .rate = 120,
                                 .method = "velocity_verlet",
                                 .duration = 15,
                                 .controls = controls};

    World world;
    Entity hero;
    double stood_at = -1, pressed_at = -1;  // s
    std::array<bool, coins.size()> has{};
    LinkHandle rope;

    explicit Platformer(const Settings& settings) : world(2, settings) {
        world.set_gravity({0, -gravity});
        world.add_chain(ground, false, {});
        for (const Vec3& ledge :
             {Vec3{-10.5, 2.4}, {-7.2, 4.9}, {-10.5, 7.4}, {5.5, 6.6}, {1, 8.2}})
            world.add_obstacle({.shape = BoxShape{ledge, {3, 0.25}}, .one_way = Vec3{0, 1}});
        world.add_obstacle({.shape = BoxShape{{10, 2.9}, {1, 4.2}}});
        world.add_obstacle({.shape = CircleShape{hook, 0.15}});
        world.add_obstacle({.shape = BoxShape{{2.5, 1.4}, {2.4, 0.3}},
                            .friction = 0.2,
                            .swing = Swing{{2.6, 0}, 5}});
        world.add_obstacle({.shape = BoxShape{{7.9, 3}, {1.6, 0.25}},
                            .swing = Swing{{0, 1.8}, 4},
                            .one_way = Vec3{0, 1}});
        hero = world.spawn(Body{.position = start, .contact = Contact{radius}});
        world.add(hero, Name{"hero"});
        world.add(hero, Look{.size = float(radius), .colour = palette::orange});
    }
    void hash(StateHash& hash) const { hash.add(stood_at, pressed_at, has); }
    std::vector<Reading> readings() const { return {{"coins", double(coins_found())}}; }

    std::ptrdiff_t coins_found() const { return std::ranges::count(has, true); }

    void update(const Input& input) {
        if (input.pressed(drop)) world.drop_through(hero);
        const auto floor = world.ground(hero);
        run(input.axis(walk), floor);
        leap(input, floor);
        swing(input);
        for (std::size_t i = 0; i < coins.size(); ++i)
            has[i] = has[i] || length(coins[i] - world.position(hero)) < 2 * radius;
        if (world.position(hero)[1] > -4) return;
        world.teleport(hero, start);
        world.set_velocity(hero, {});
    }

    /// Drives him along the floor to a speed relative to it, and holds him on a slope.
    void run(double wish, const std::optional<Touch>& floor) {
        const Vec3 along = floor ? Vec3{floor->normal[1], -floor->normal[0]} : Vec3{1};
        const Vec3 slip = world.velocity(hero) - (floor ? floor->velocity : Vec3{});
        const double most = floor ? drive : air_drive;
        if (!floor && world.alive(rope)) return world.apply_force(hero, {rope_drive * wish});
        const double wanted = (speed * wish - dot(slip, along)) / world.dt();
        world.apply_force(hero, (std::clamp(wanted, -most, most) + gravity * along[1]) * along);
    }

    /// Jumps off the floor, or off a wall. A jump ends early if its button is released.
    void leap(const Input& input, const std::optional<Touch>& floor) {
        const Vec3 v = world.velocity(hero);
        if (floor) stood_at = world.time();
        if (input.pressed(jump)) pressed_at = world.time();
        if (input.released(jump) && v[1] > take_off / 2)
            world.set_velocity(hero, {v[0], take_off / 2});
        if (world.time() - pressed_at > patience) return;
        const double rise = input.held(jump) ? take_off : take_off / 2;
        if (world.time() - stood_at <= patience)
            return take({v[0], rise + (floor ? std::max(0.0, floor->velocity[1]) : 0)});
        for (const Touch& touch : world.touches(hero))
            if (std::abs(touch.normal[1]) < 0.5) return take({speed * touch.normal[0], rise});
    }
    void take(const Vec3& velocity) {
        world.set_velocity(hero, velocity);
        stood_at = pressed_at = -1;
    }

    /// Hangs him on a rope, of the length that is between, while the button is held near the hook.
    void swing(const Input& input) {
        if (input.held(grab) == world.alive(rope)) return;
        if (world.alive(rope)) return world.unlink(rope);
        const double away = length(hook - world.position(hero));
        if (away < reach)
            rope = world.link_to_point(
                hero, hook,
                {.stiffness = 1000, .damping = 20, .rest_length = away, .pulls_only = true});
    }

    Picture picture() const {
        Picture picture = draw_looks(world, {.centre = {0, 5.5F}, .height = 15.75F});
        picture.background = palette::pale;
        std::vector<Point> air;
        for (const Vec3& point : ground) air.push_back(to_point(point));
        const Colour sky = palette::mix(palette::paper, palette::sky_blue, 0.2F);
        picture.polygons.push_back({.points = air, .colour = sky, .layer = -1});
        for (std::size_t i = 0; i < coins.size(); ++i)
            if (!has[i])
                picture.discs.push_back({{}, to_point(coins[i]), 0.25F, palette::vermilion});
        const Vec3 at = world.position(hero);
        if (world.alive(rope))
            picture.polylines.push_back(
                {key_of(world, hero),
                 oiler::rope(to_point(at), to_point(hook), float(world.link(rope).rest_length)),
                 2});
        const Vec3 eye = at + Vec3{std::clamp(world.velocity(hero)[0] / 10, -0.18, 0.18), 0.1};
        picture.discs.push_back({key_of(world, hero, 1), to_point(eye), 0.08F, palette::ink});
        const char* const keys = "← → run, Space jumps, ↓ drops, E swings";
        picture.labels = {{.at = {12, 340},
                           .text = fmt::format("coins {} of 7   {}", coins_found(), keys),
                           .space = Space::upper_left}};
        return picture;
    }
};

int main(int argc, char** argv) { return run<Platformer>(argc, argv); }
