// SPDX-License-Identifier: MIT
// Shows one jump at two rates: at 60 Hz it misses a ledge at 2.00 m, at 240 Hz it lands on it. A
// slider changes the left rate, --rate the right one, --method the method of both.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "oiler/oiler.hpp"

using namespace oiler;

namespace {

constexpr Action slower{"lower rate", Key::left, Key::a, Pad::left};
constexpr Action faster{"higher rate", Key::right, Key::d, Pad::right};
constexpr Action grab{"drag the slider", Mouse::left};

constexpr double gravity = 20;        // m/s²
constexpr Vec3 take_off{1.8, 9};      // m/s
constexpr float ledge = 2;            // m
constexpr std::int64_t interval = 2;  // s from one take-off to the next
constexpr std::array<std::int64_t, 12> rates{10, 15, 20,  30,  40,  50,
                                             60, 80, 100, 120, 144, 240};  // Hz, of the slider
constexpr Point slider_low{34, 38}, slider_high{606, 38};                  // units of the canvas

/// A jumping body and the path of its feet, in m from the take-off.
struct Jumper {
    Entity body{};
    std::vector<Point> path{};  // one point per step

    void jump(World& world) {
        if (world.alive(body)) world.destroy(body);
        *this = {world.spawn(Body{.velocity = take_off}), {{0, 0}}};
        world.add(body, Name{"right ball"});
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

/// The whole path of a jump at another rate.
std::vector<Point> simulate(Settings settings, std::int64_t rate) {
    settings.stepping.rate = {rate};
    World world(2, settings);
    world.set_gravity({0, -gravity});
    Jumper jumper;
    for (jumper.jump(world); world.has_body(jumper.body); jumper.follow(world)) world.step();
    return jumper.path;
}

/// A jump as it is drawn.
struct Shown {
    std::int64_t rate;
    std::vector<Point> path;  // up to the feet
    float apex;               // m, so far
    bool is_over;
    ElementKey key;
    std::vector<Point> whole{};  // the path up to the end
};

/// Draws a jump with the take-off at x = `left`.
void draw(Picture& picture, const Shown& shown, float left) {
    const auto line = [&](std::vector<Point> points, float width, Colour ink, ElementKey key = {}) {
        for (Point& point : points) point.x += left;
        picture.polylines.push_back(
            {.key = key, .points = std::move(points), .width = width, .colour = ink});
    };
    const auto text = [&](Point at, const std::string& words, float size, Colour ink) {
        add_text(picture, {at.x + left, at.y}, words, size, ink, Align::centre).space =
            Space::world;
    };
    const bool misses = shown.is_over && shown.apex < ledge;
    const Colour colour = misses ? palette::vermilion : palette::blue;
    std::vector<Point> arc;
    for (double t = 0; t < 2.001 * take_off[1] / gravity; t += 0.01)
        arc.push_back(to_point({take_off[0] * t, take_off[1] * t - gravity / 2 * t * t}));
    line(arc, 8, palette::pale);
    text({1.5F, 1.5F}, "exact", 15, palette::grey);
    for (float x = -0.2F; x < 1.8F; x += 0.1F)
        line({{x, ledge}, {x + 0.06F, ledge}}, 2.5F, palette::ink);
    text({0.07F, ledge + 0.05F}, "2.00 m", 15, palette::ink);
    line({{-0.2F, 0}, {1.86F, 0}}, 2.5F, palette::ink);

    constexpr float radius = 0.09F;
    const Point feet = shown.path.back();
    line(shown.whole, 1.5F, palette::faded(colour, 110));
    line(shown.path, 2.5F, colour, shown.key);
    picture.discs.push_back({.key = shown.key,
                             .centre = {feet.x + left, feet.y + radius},
                             .radius = radius,
                             .colour = colour});
    text({0.73F, 0.68F}, fmt::format("{} Hz", shown.rate), 30, colour);
    text({0.73F, 0.43F}, fmt::format("apex {:.3f} m", shown.apex), 17, palette::ink);
    if (shown.is_over) text({0.73F, 0.18F}, misses ? "misses" : "lands", 17, colour);
}

float place_of(std::size_t rate) {
    return std::lerp(slider_low.x, slider_high.x,
                     static_cast<float>(rate) / static_cast<float>(rates.size() - 1));
}

}  // namespace

struct Jump {
    static constexpr Control controls[] = {slower, faster, grab};
    static constexpr About about{.name = "jump",
                                 .title = "Drag the rate: does the jump reach its ledge?",
                                 .rate = 240,
                                 .duration = interval,
                                 .controls = controls,
                                 .changes_in_play = false};

    World world;
    Jumper jumper;
    std::size_t dragged = 6;  // the rate of the left jump, which is only drawn
    bool is_grabbed = false;
    std::vector<Point> dragged_path;

    explicit Jump(const Settings& settings)
        : world(2, settings), dragged_path(simulate(settings, rates[dragged])) {
        world.set_gravity({0, -gravity});
        jumper.jump(world);
    }

    void update(const Input& input) {
        const std::int64_t rate = world.settings().stepping.rate.steps;
        const bool again = world.tick() % (interval * rate) == 0;
        again ? jumper.jump(world) : jumper.follow(world);
        drag(input);
    }

    void drag(const Input& input) {
        const std::size_t before = dragged;
        if (input.pressed(faster)) dragged = std::min(dragged + 1, rates.size() - 1);
        if (input.pressed(slower) && dragged > 0) --dragged;
        const std::optional<Point> mouse = input.pointer_canvas();
        if (input.pressed(grab)) is_grabbed = mouse && mouse->y < 50;
        is_grabbed = is_grabbed && input.held(grab);
        if (is_grabbed && mouse) {
            const float share = (mouse->x - slider_low.x) / (slider_high.x - slider_low.x);
            dragged = static_cast<std::size_t>(
                std::lround(std::clamp(share, 0.0F, 1.0F) * static_cast<float>(rates.size() - 1)));
        }
        if (dragged != before) dragged_path = simulate(world.settings(), rates[dragged]);
    }

    std::vector<Reading> readings() const {
        return {{"right apex", double{std::ranges::max(jumper.path, {}, &Point::y).y}, "m"}};
    }

    Picture picture() const {
        Picture picture{.camera = {.centre = {0, 1.01F}, .height = 2.8F}};
        draw(picture, shown_dragged(), -1.9F);
        draw(picture, shown_live(), 0.27F);
        draw_slider(picture);
        return picture;
    }

    Shown shown_live() const {
        std::vector<Point> path = jumper.path;
        if (world.has_body(jumper.body)) path.push_back(to_point(world.position(jumper.body)));
        return {world.settings().stepping.rate.steps, std::move(path),
                std::ranges::max(jumper.path, {}, &Point::y).y, !world.has_body(jumper.body),
                key_of(world, jumper.body)};
    }

    /// Its result is there at once, so that a drag shows what the rate does.
    Shown shown_dragged() const {
        const std::int64_t rate = rates[dragged];
        const double steps = std::fmod(world.time(), double{interval}) * static_cast<double>(rate);
        const std::size_t last = dragged_path.size() - 1;
        const auto whole = std::min(static_cast<std::size_t>(steps), last);
        std::vector<Point> path(dragged_path.begin(),
                                dragged_path.begin() + static_cast<std::ptrdiff_t>(whole + 1));
        if (whole < last) {
            const auto part = static_cast<float>(steps - static_cast<double>(whole));
            const Point from = path.back(), to = dragged_path[whole + 1];
            path.push_back({std::lerp(from.x, to.x, part), std::lerp(from.y, to.y, part)});
        }
        const float apex = std::ranges::max(dragged_path, {}, &Point::y).y;
        const auto round = static_cast<std::uint32_t>(world.time() / double{interval});
        return {rate,        std::move(path), apex, true, {.object = 1, .part = 1, .jump = round},
                dragged_path};
    }

    void draw_slider(Picture& picture) const {
        picture.polylines.push_back({.points = {slider_low, slider_high},
                                     .width = 3,
                                     .colour = palette::pale,
                                     .space = Space::canvas});
        for (std::size_t i = 0; i < rates.size(); ++i)
            add_text(picture, {place_of(i), 20}, fmt::format("{}", rates[i]), 9,
                     i == dragged ? palette::ink : palette::grey, Align::centre);
        add_text(picture, {620, 20}, "Hz", 9, palette::grey);
        add_text(picture, {320, 5}, "Drag the rate of the left jump, or press ← →", 9, palette::ink,
                 Align::centre);
        picture.discs.push_back({.centre = {place_of(dragged), slider_low.y},
                                 .radius = 8,
                                 .colour = palette::ink,
                                 .space = Space::canvas});
    }
};

int main(int argc, char** argv) { return run<Jump>(argc, argv); }
