// SPDX-License-Identifier: MIT
// Shows one jump at two rates: at 60 Hz it misses a ledge at 2.00 m, at 240 Hz it lands on it. The
// slider sets the rate of the right jump, which is that of the loop: the line on top speaks of it.
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

constexpr double gravity = 20;          // m/s²
constexpr Vec3 take_off{1.8, 9};        // m/s
constexpr float ledge = 2;              // m
constexpr std::int64_t interval = 2;    // s from one take-off to the next
constexpr std::int64_t left_rate = 60;  // Hz
constexpr std::array<std::int64_t, 12> rates{10, 15, 20,  30,  40,  50,
                                             60, 80, 100, 120, 144, 240};  // Hz, of the slider
constexpr Point slider_low{34, 38}, slider_high{606, 38};                  // units of the canvas
constexpr float slider_top = 56;                                           // likewise

/// The path of a body's feet, in m from the take-off.
struct Path {
    std::vector<Point> points{};  // one per step
    double apex = 0;              // m
};

struct Jumper {
    Entity body{};
    Path path{};

    void jump(World& world) {
        if (world.alive(body)) world.destroy(body);
        *this = {world.spawn(Body{.velocity = take_off}), {.points = {{0, 0}}}};
        world.add(body, Name{"right ball"});
    }

    bool rises(const World& world) const {
        return world.has_body(body) && world.velocity(body)[1] > 0;
    }

    /// Adds the position after a step. A body that falls onto the ledge or the ground stays there.
    void follow(World& world) {
        const Point before = path.points.back();
        path.points.push_back(before);
        if (!world.has_body(body)) return;
        Point& at = path.points.back() = to_point(world.position(body));
        path.apex = std::max(path.apex, world.position(body)[1]);
        const float floor = before.y >= ledge ? ledge : 0;
        if (at.y >= floor) return;
        at = {std::lerp(before.x, at.x, (before.y - floor) / (before.y - at.y)), floor};
        world.remove_body(body);
    }
};

/// The whole path of a jump at a rate.
Path simulate(Settings settings, std::int64_t rate) {
    settings.stepping.rate = {rate};
    World world(2, settings);
    world.set_gravity({0, -gravity});
    Jumper jumper;
    for (jumper.jump(world); world.has_body(jumper.body); jumper.follow(world)) world.step();
    return jumper.path;
}

/// A jump as it is drawn. Its end is known from the start, so that a drag shows what a rate does.
struct Shown {
    std::int64_t rate;
    const Path& whole;
    std::vector<Point> path;  // up to the feet
    ElementKey key;
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
    constexpr double half = 1e-9;  // rounds up
    const bool misses = shown.whole.apex < ledge;
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
    line(shown.whole.points, 1.5F, palette::faded(colour, 110));
    line(shown.path, 2.5F, colour, shown.key);
    picture.discs.push_back({.key = shown.key,
                             .centre = {feet.x + left, feet.y + radius},
                             .radius = radius,
                             .colour = colour});
    text({0.73F, 0.68F}, fmt::format("{} Hz", shown.rate), 30, colour);
    text({0.73F, 0.43F}, fmt::format("apex {:.3f} m", shown.whole.apex + half), 17, palette::ink);
    text({0.73F, 0.18F}, misses ? "misses" : "lands", 17, colour);
}

/// The place of a rate on the slider, from 0 to 1; other rates are between those beside them.
float share_of(std::int64_t rate) {
    const auto above = std::ranges::lower_bound(rates, rate);
    if (above == rates.begin()) return 0;
    if (above == rates.end()) return 1;
    const std::int64_t below = *(above - 1);
    const auto part = static_cast<float>(rate - below) / static_cast<float>(*above - below);
    return (static_cast<float>(above - rates.begin() - 1) + part) /
           static_cast<float>(rates.size() - 1);
}
std::int64_t rate_at(float share) {
    const float place = std::clamp(share, 0.0F, 1.0F) * static_cast<float>(rates.size() - 1);
    return rates[static_cast<std::size_t>(std::lround(place))];
}
std::int64_t next_above(std::int64_t rate) {
    const auto next = std::ranges::upper_bound(rates, rate);
    return next == rates.end() ? rate : *next;
}
std::int64_t next_below(std::int64_t rate) {
    const auto next = std::ranges::lower_bound(rates, rate);
    return next == rates.begin() ? rate : *(next - 1);
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
    Path left, right;      // up to their ends
    double last_apex = 0;  // m, of the last jump that reached it

    explicit Jump(const Settings& settings)
        : world(2, settings),
          left(simulate(settings, left_rate)),
          right(simulate(settings, settings.stepping.rate.steps)) {
        world.set_gravity({0, -gravity});
        jumper.jump(world);
    }

    std::int64_t rate() const { return world.settings().stepping.rate.steps; }

    void update(const Input& input, Loop& loop) {
        const bool again = world.tick() % (interval * rate()) == 0;
        again ? jumper.jump(world) : jumper.follow(world);
        if (!jumper.rises(world)) last_apex = jumper.path.apex;
        const std::int64_t wanted = wanted_rate(input);
        if (wanted != rate()) loop.change_rate(wanted);
    }
    std::int64_t wanted_rate(const Input& input) const {
        if (input.pressed(faster)) return next_above(rate());
        if (input.pressed(slower)) return next_below(rate());
        const std::optional<Point> mouse = input.pointer_canvas();
        if (!input.held(grab) || !mouse || mouse->y > slider_top) return rate();
        return rate_at((mouse->x - slider_low.x) / (slider_high.x - slider_low.x));
    }

    std::vector<Reading> readings() const { return {{"apex of the right ball", last_apex, "m"}}; }

    Picture picture() const {
        Picture picture{.camera = {.centre = {0, 1.01F}, .height = 2.8F}};
        draw(picture, shown_left(), -1.9F);
        draw(picture, shown_right(), 0.27F);
        draw_slider(picture);
        return picture;
    }

    Shown shown_right() const {
        std::vector<Point> path = jumper.path.points;
        if (world.has_body(jumper.body)) path.push_back(to_point(world.position(jumper.body)));
        return {rate(), right, std::move(path), key_of(world, jumper.body)};
    }

    Shown shown_left() const {
        const double steps = std::fmod(world.time(), double{interval}) * double{left_rate};
        const std::size_t last = left.points.size() - 1;
        const auto whole = std::min(static_cast<std::size_t>(steps), last);
        std::vector<Point> path(left.points.begin(),
                                left.points.begin() + static_cast<std::ptrdiff_t>(whole + 1));
        if (whole < last) {
            const auto part = static_cast<float>(steps - static_cast<double>(whole));
            const Point from = path.back(), to = left.points[whole + 1];
            path.push_back({std::lerp(from.x, to.x, part), std::lerp(from.y, to.y, part)});
        }
        const auto round = static_cast<std::uint32_t>(world.time() / double{interval});
        return {left_rate, left, std::move(path), {.object = 1, .part = 1, .jump = round}};
    }

    void draw_slider(Picture& picture) const {
        const auto place_of = [](std::int64_t at) {
            return std::lerp(slider_low.x, slider_high.x, share_of(at));
        };
        picture.polylines.push_back({.points = {slider_low, slider_high},
                                     .width = 3,
                                     .colour = palette::pale,
                                     .space = Space::canvas});
        for (const std::int64_t at : rates)
            add_text(picture, {place_of(at), 20}, fmt::format("{}", at), 9,
                     at == rate() ? palette::ink : palette::grey, Align::centre);
        add_text(picture, {320, 5}, "Drag the rate of the right ball in Hz, or press ← →", 9,
                 palette::ink, Align::centre);
        picture.discs.push_back({.centre = {place_of(rate()), slider_low.y},
                                 .radius = 8,
                                 .colour = palette::ink,
                                 .space = Space::canvas});
    }
};

int main(int argc, char** argv) { return run<Jump>(argc, argv); }
