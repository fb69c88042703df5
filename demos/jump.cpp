// SPDX-License-Identifier: MIT
// Shows one jump at two rates: at 60 Hz it misses a ledge at 2.00 m, at 240 Hz it lands on it.
// --rate changes the second rate, --method changes the method of both.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "oiler/app/run.hpp"
#include "oiler/picture/palette.hpp"

using namespace oiler;

namespace {

constexpr double gravity = 20;        // m/s²
constexpr Vec3 take_off{1.8, 9};      // m/s
constexpr float ledge = 2;            // m
constexpr std::int64_t slow = 60;     // Hz
constexpr std::int64_t interval = 2;  // s from one take-off to the next

/// A jumping body and the path of its feet, in m from the take-off.
struct Jumper {
    Entity body{};
    std::vector<Point> path{};  // one point per step

    void jump(World& world) {
        if (world.alive(body)) world.destroy(body);
        *this = {world.spawn(Body{.velocity = take_off}), {{0, 0}}};
    }

    /// Adds the position after a step. A body that falls onto the ledge or the ground stays there.
    void follow(World& world) {
        const Point before = path.back();
        path.push_back(world.has_body(body) ? to_point(world.position(body)) : before);
        Point& at = path.back();
        const float floor = before.y >= ledge ? ledge : 0;
        if (at.y >= floor) return;
        at = {std::lerp(before.x, at.x, (before.y - floor) / (before.y - at.y)), floor};
        world.remove_body(body);
    }
};

/// Draws a jump along `path`, with the take-off at x = `left`.
void draw(Picture& picture, const World& world, Entity body, std::vector<Point> path, float left,
          Colour colour) {
    const auto line = [&](std::vector<Point> points, float width, Colour ink, ElementKey key = {}) {
        for (Point& point : points) point.x += left;
        picture.polylines.push_back(
            {.key = key, .points = std::move(points), .width = width, .colour = ink});
    };
    const auto text = [&](Point at, const std::string& words, float size, Colour ink) {
        picture.labels.push_back({.at = {at.x + left, at.y},
                                  .text = words,
                                  .size = size,
                                  .colour = ink,
                                  .align = Align::centre,
                                  .space = Space::world});
    };
    std::vector<Point> arc;
    for (double t = 0; t < 2.001 * take_off[1] / gravity; t += 0.01)
        arc.push_back(to_point({take_off[0] * t, take_off[1] * t - gravity / 2 * t * t}));
    line(arc, 8, palette::pale);
    text({1.5F, 1.5F}, "exact", 17, palette::grey);
    for (float x = -0.2F; x < 1.8F; x += 0.1F)
        line({{x, ledge}, {x + 0.06F, ledge}}, 2.5F, palette::ink);
    text({0.07F, ledge + 0.05F}, "2.00 m", 17, palette::ink);
    line({{-0.2F, 0}, {1.86F, 0}}, 2.5F, palette::ink);

    constexpr float radius = 0.09F;
    const Point feet = path.back();
    const float apex = std::ranges::max(path, {}, &Point::y).y;
    const ElementKey key = key_of(world, body, left < 0 ? 1 : 0);
    line(std::move(path), 2.5F, colour, key);
    picture.discs.push_back({.key = key,
                             .centre = {feet.x + left, feet.y + radius},
                             .radius = radius,
                             .colour = colour});
    text({0.81F, 1.0F}, fmt::format("{} Hz", world.settings().stepping.rate.steps), 33, colour);
    text({0.81F, 0.72F}, fmt::format("apex {:.3f} m", apex), 19, palette::ink);
    if (!world.has_body(body))
        text({0.81F, 0.47F}, feet.y < ledge ? "misses" : "lands", 19, colour);
}

Settings with_rate(Settings settings, std::int64_t rate) {
    settings.stepping.rate = {rate};
    return settings;
}

}  // namespace

struct Jump {
    static constexpr About about{.name = "jump",
                                 .title = "A jump at two rates",
                                 .rate = 240,
                                 .duration = interval,
                                 .changes_in_play = false};

    World world;
    World slow_world;  // at most one step ahead of `world`
    Jumper jumper, slow_jumper;

    explicit Jump(const Settings& settings)
        : world(2, settings), slow_world(2, with_rate(settings, slow)) {
        world.set_gravity({0, -gravity});
        slow_world.set_gravity({0, -gravity});
        jump();
    }
    void jump() {
        jumper.jump(world);
        slow_jumper.jump(slow_world);
    }

    void update(const Input&) {
        const std::int64_t rate = world.settings().stepping.rate.steps;
        const bool again = world.tick() % (interval * rate) == 0;
        again ? jump() : jumper.follow(world);
        while (slow_world.tick() * rate < (world.tick() + 1) * slow) {
            slow_world.step();
            slow_jumper.follow(slow_world);
        }
    }

    std::vector<Reading> readings() const {
        return {{"apex", double{std::ranges::max(jumper.path, {}, &Point::y).y}, "m"}};
    }

    Picture picture() const {
        Picture picture{.camera = {.centre = {0, 1.14F}, .height = 2.46F}};
        std::vector<Point> path = jumper.path;
        if (world.has_body(jumper.body)) path.push_back(to_point(world.position(jumper.body)));
        draw(picture, world, jumper.body, path, 0.27F, palette::blue);

        path = slow_jumper.path;
        const auto ahead = static_cast<float>((slow_world.time() - world.time()) * slow);
        const Point before = path[path.size() - (path.size() > 1 ? 2 : 1)];
        Point& at = path.back();
        at = {std::lerp(at.x, before.x, ahead), std::lerp(at.y, before.y, ahead)};
        draw(picture, slow_world, slow_jumper.body, path, -1.9F, palette::vermilion);
        return picture;
    }
};

int main(int argc, char** argv) { return run<Jump>(argc, argv); }
