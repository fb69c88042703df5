// SPDX-License-Identifier: MIT
// A complete small game: a cannon shoots at targets on springs.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "oiler/oiler.hpp"

using namespace oiler;

namespace {

constexpr Axis aim{
    "aim", {Key::down, Key::s, Pad::down}, {Key::up, Key::w, Pad::up}, Stick::left_y, ByMouse::yes};
constexpr Action fire{"fire", Key::space, Mouse::left, Pad::south};
constexpr Action menu{"menu", Key::escape, Pad::start};
constexpr Action restart{"restart", Key::r, Pad::back};
constexpr Action quit{"quit", Key::q, Pad::north};  // from the menu

constexpr Vec3 gravity{0, -9.81};                                // m/s²
constexpr Vec3 pivot{3, 1.2};                                    // m
constexpr double barrel = 2.2, wall = 39;                        // m
constexpr double turning = 0.8;                                  // rad/s
constexpr double least_speed = 6, most_speed = 26, charge = 16;  // m/s, m/s, m/s²
constexpr double drag = 0.004;                                   // N·s²/m²
constexpr Link spring{.stiffness = 30, .damping = 0.1, .rest_length = 2};

struct Level {
    double wind;                  // m/s
    double swing;                 // m, from the place of a target to its start
    std::array<Vec3, 3> targets;  // m
};
constexpr std::array levels{Level{0, 0, {Vec3{17, 5}, Vec3{25, 9.5}, Vec3{33, 4}}},
                            Level{-9, 0, {Vec3{15, 9}, Vec3{22, 3}, Vec3{34, 8}}},
                            Level{7, 1.5, {Vec3{18, 4}, Vec3{26, 11}, Vec3{35, 6}}},
                            Level{-14, 2, {Vec3{20, 10}, Vec3{27, 4}, Vec3{34, 12}}}};

struct Ball {
    int bounces = 0;
};
struct Target {
    Vec3 hook;  // m
    bool is_hit = false;
    void hash(StateHash& hash) const { hash.add(hook, is_hit); }
};
struct Expire {
    Entity entity;
};

}  // namespace

struct Cannon {
    static constexpr Control controls[] = {aim, fire, menu, restart, quit};
    static constexpr About about{.name = "cannon",
                                 .title = "Cannon",
                                 .rate = 60,
                                 .method = "velocity_verlet",
                                 .controls = controls};

    World world;
    Entity cannon = world.create();
    Collisions collisions;
    std::uint32_t shots = 0, score = 0;
    std::size_t level = 0;
    double speed = 16;  // m/s
    Vec3 direction{0.8, 0.6};
    bool is_paused = false;

    explicit Cannon(const Settings& settings) : world(2, settings) {
        world.set_gravity(gravity);
        world.add_plane({.normal = {0, 1}, .restitution = 0.6, .friction = 0.2});
        world.add_plane({.normal = {-1, 0}, .offset = -wall, .restitution = 0.7});
        hang_targets();
    }
    /// Adds what the world does not hold to the hash of a state.
    void hash(StateHash& hash) const { hash.add(shots, score, level, speed, direction, is_paused); }
    bool has_targets() const { return world.count<Target>() > 0; }

    void hang_targets() {
        for (const Vec3& place : levels[level].targets) {
            const Entity target = world.spawn(Body{.mass = 2,
                                                   .position = place - Vec3{0, levels[level].swing},
                                                   .contact = Contact{0.8}});
            const Vec3 force = world.mass(target) * gravity;
            const Vec3 hook = place - force / spring.stiffness + Vec3{0, spring.rest_length};
            world.link_to_point(target, hook, spring);
            world.add(target, Target{hook});
            world.add(target, Name{"target"});
            world.add(target, Look{.size = 0.8F, .colour = palette::vermilion});
        }
    }

    void update(const Input& input, Loop& loop) {
        if (input.pressed(restart)) loop.restart();
        if (input.pressed(menu)) is_paused = !is_paused;
        if (is_paused && input.pressed(quit)) loop.quit();
        if (is_paused) return loop.hold();
        score_hits();
        world.due<Expire>([&](Expire due) { world.destroy(due.entity); });
        if (!has_targets() && level + 1 < levels.size()) {
            ++level;
            hang_targets();
        }
        turn(input);
        if (has_targets()) shoot(input);
    }

    /// Turns to the mouse when it moves.
    void turn(const Input& input) {
        const double angle = turning * world.dt() * input.axis(aim);
        Vec3 to = direction + angle * Vec3{-direction[1], direction[0]};
        if (input.pointer_moved()) to = Vec3{input.pointer()->x, input.pointer()->y} - pivot;
        to = {std::max(to[0], 0.0), std::max(to[1], 0.0)};
        if (length(to) > 0.1) direction = normalised(to);
    }

    void shoot(const Input& input) {
        if (input.pressed(fire)) speed = least_speed;
        if (input.held(fire)) speed = std::min(speed + charge * world.dt(), most_speed);
        if (!input.released(fire)) return;
        ++shots;
        const Entity ball = launch(world);
        world.add(ball, Ball{});
        world.add(ball, Name{"ball"});
        world.add(ball, Look{.size = 0.3F, .colour = palette::ink});
        world.schedule(8, Expire{ball});
    }

    /// Adds a ball that leaves the cannon, to this world or to that of the preview.
    Entity launch(World& place) const {
        const Body ball{.position = pivot + barrel * direction,
                        .velocity = speed * direction,
                        .contact = Contact{0.3}};
        if (levels[level].wind == 0) return place.spawn(ball);
        return place.spawn(ball, Wind{.velocity = {levels[level].wind}, .coefficient = drag});
    }

    void score_hits() {
        for (const Impact& impact : world.impacts())
            if (Ball* const ball = world.find<Ball>(impact.entity)) ++ball->bounces;
        collisions.update(world);
        collisions.each<Ball, Target>(world, [&](Entity by, Ball& ball, Entity on, Target& target) {
            if (!std::exchange(target.is_hit, true)) hit(by, ball, on);
        });
    }

    void hit(Entity by, const Ball& ball, Entity entity) {
        const Vec3 relative = world.velocity(by) - world.velocity(entity);
        const Vec3 impulse = 1.5 * relative / (1 / world.mass(by) + 1 / world.mass(entity));
        world.apply_impulse(entity, impulse);
        world.apply_impulse(by, -impulse);
        world.get<Look>(entity).colour = palette::grey;
        world.schedule(2, Expire{entity});
        score += ball.bounces > 0 ? 200 : 100;
    }

    std::vector<Reading> readings() const { return {{"score", double(score)}}; }

    Picture picture() const {
        Picture picture = draw_looks(world, {.centre = {20, 9.25F}, .height = 22.5F});
        picture.background = {214, 236, 250};
        picture.polygons.push_back(
            {.points = {{-30, 0}, {3, 6}, {11, 3}, {21, 8}, {31, 3}, {45, 7}, {70, 0}},
             .colour = palette::faded(palette::green, 70),
             .layer = -1});
        draw_cannon(picture);
        world.each<Target>([&](Entity entity, const Target& target) {
            draw_spring(picture, entity, to_point(target.hook));
        });
        draw_texts(picture);
        return picture;
    }

    void draw_cannon(Picture& picture) const {
        World air(2, world.settings());
        air.set_gravity(gravity);
        const Entity preview = launch(air);
        for (std::uint32_t i = 1; i <= 12; ++i) {
            air.step(world.settings().stepping.rate.steps / 12);
            picture.discs.push_back({key_of(world, cannon, i), to_point(air.position(preview)),
                                     0.12F, palette::faded(palette::ink, 140)});
        }
        const auto along = [&](double length, float width, Colour colour, std::uint32_t part) {
            const Point end = to_point(pivot + length * direction);
            picture.polygons.push_back(
                {key_of(world, cannon, part), bar(to_point(pivot), end, width), colour});
        };
        along(barrel, 0.8F, palette::ink, 0);
        along(barrel * speed / most_speed, 0.3F, palette::orange, 1);
        picture.discs.push_back({{}, {2.7F, 0.85F}, 0.85F, palette::ink});
        picture.discs.push_back({{}, {2.7F, 0.85F}, 0.4F, palette::grey});
    }

    void draw_spring(Picture& picture, Entity target, Point hook) const {
        const ElementKey key = key_of(world, target, 1);
        const Point at = to_point(world.position(target));
        picture.polylines.push_back({key, coil(hook, at, 7, 0.3F), 1.5F, palette::grey});
        picture.polygons.push_back({{}, rectangle(hook, {1.6F, 0.2F}), palette::ink});
        picture.discs.push_back({key, at, 0.5F, palette::paper});
        picture.discs.push_back({key_of(world, target, 2), at, 0.2F, palette::ink});
    }

    void draw_texts(Picture& picture) const {
        const auto text = [&](Space space, Point at, float size, const std::string& words) {
            picture.labels.push_back(
                {.at = at,
                 .text = words,
                 .size = size,
                 .align = space == Space::upper_left ? Align::left : Align::centre,
                 .space = space,
                 .layer = 1});
        };
        const auto sheet = [&](const std::string& title, const std::string& keys) {
            picture.polygons.push_back({.points = rectangle({320, 211}, {640, 72}),
                                        .colour = palette::faded(palette::paper, 216),
                                        .space = Space::canvas,
                                        .layer = 1});
            text(Space::canvas, {320, 220}, 26, title);
            text(Space::canvas, {320, 196}, 14, keys);
        };
        text(Space::upper_left, {16, 334}, 16,
             fmt::format("Level {} of {}", level + 1, levels.size()));
        text(Space::upper_left, {16, 314}, 14, fmt::format("Score {}   Shots {}", score, shots));
        text(Space::bottom, {320, 12}, 11,
             "Aim with mouse or arrows. Hold Space or the button, and release. Escape: menu");
        const auto wind = static_cast<float>(levels[level].wind);
        text(Space::top, {320, 338}, 12, fmt::format("Wind {} m/s", std::abs(wind)));
        const Point tail{320 - 3 * wind, 324}, head{320 + 3 * wind, 324};
        picture.polygons.push_back(
            {.points = arrow(tail, head, 4), .colour = palette::blue, .space = Space::top});
        if (is_paused)
            sheet("Pause", "Escape: resume   R: restart   Q: quit");
        else if (!has_targets())
            sheet(fmt::format("You win: {} points with {} shots", score, shots), "R: restart");
    }
};

int main(int argc, char** argv) { return run<Cannon>(argc, argv); }
