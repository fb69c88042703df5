// SPDX-License-Identifier: MIT
// Shows a salvo at seven elevations: without drag, with linear and with quadratic drag. The first
// two have closed forms, drawn below them.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "oiler/app/run.hpp"
#include "oiler/core/length_text.hpp"
#include "oiler/physics/closed_forms.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/text.hpp"
#include "oiler/plot/plot.hpp"

using namespace oiler;

namespace {

constexpr double gravity = -9.81;                // m/s²
constexpr double linear_coefficient = 0.25;      // N·s/m
constexpr double quadratic_coefficient = 0.015;  // N·s²/m²
constexpr double interval = 8;                   // s from one salvo to the next

enum class Drag { none, linear, quadratic };
struct Kind {
    Drag drag;
    const char* name;
    Colour colour;
};
constexpr std::array kinds{Kind{Drag::none, "no drag", palette::blue},
                           Kind{Drag::linear, "linear drag", palette::green},
                           Kind{Drag::quadratic, "quadratic drag", palette::orange}};

/// Tangents u of half the elevation. The direction (1 − u², 2u)/(1 + u²) needs no sine, so its bits
/// are the same on every machine.
constexpr std::array half_tangents{0.18, 0.26, 0.34, 0.42, 0.50, 0.58, 0.66};

struct Shot {
    Drag drag;
    Vec3 launch;   // m/s
    double fired;  // s
};
struct Trail {
    std::vector<Point> points;
};
struct Salvo {};

/// Exact position `t` s after the launch, without drag or with linear drag.
Vec3 exact(const Shot& shot, double t) {
    const double c = shot.drag == Drag::linear ? linear_coefficient : 0;
    return {linear_drag_motion({0.0, shot.launch[0]}, 0.0, c, t).x,
            linear_drag_motion({0.0, shot.launch[1]}, gravity, c, t).x};
}

/// Moves the last point, which is below the ground, up the last segment to the ground.
void cut_at_ground(std::vector<Point>& points) {
    const Point above = points[points.size() - 2];
    Point& below = points.back();
    below = {above.x + (below.x - above.x) * above.y / (above.y - below.y), 0};
}

/// Smallest distance of two points. Closer points would cost memory and be invisible.
constexpr float trail_spacing = 0.1F;  // m

void extend(Trail& trail, Point at, bool landed) {
    if (trail.points.empty() || landed ||
        std::hypot(at.x - trail.points.back().x, at.y - trail.points.back().y) >= trail_spacing)
        trail.points.push_back(at);
    if (landed) cut_at_ground(trail.points);
}

}  // namespace

struct Projectile {
    static constexpr About about{
        .name = "projectile", .title = "Which drag shortens a shot most?", .rate = 60};

    World world;
    std::mt19937_64 random;
    std::array<double, kinds.size()> largest_error{};  // m, per kind

    explicit Projectile(const Settings& settings) : world(2, settings), random(settings.seed) {
        world.set_gravity({0, gravity});
        fire_salvo();
    }

    void fire_salvo() {
        const double speed = 29 + 2 * static_cast<double>(random() >> 11) * 0x1p-53;
        for (const Kind& kind : kinds)
            for (const double u : half_tangents)
                fire({kind.drag,
                      {speed * (1 - u * u) / (1 + u * u), speed * 2 * u / (1 + u * u)},
                      world.time()});
        world.schedule(interval, Salvo{});
    }

    void fire(const Shot& shot) {
        const Entity entity = world.create();
        const Body body{.velocity = shot.launch};
        if (shot.drag == Drag::none) world.add_body(entity, body);
        if (shot.drag == Drag::linear) world.add_body(entity, body, LinearDrag{linear_coefficient});
        if (shot.drag == Drag::quadratic)
            world.add_body(entity, body, QuadraticDrag{quadratic_coefficient});
        world.add(entity, shot);
        world.add(entity, Trail{});
    }

    void update(const Input&) {
        world.each_body<Shot, Trail>(
            [&](Entity entity, const Moving& moving, const Shot& shot, Trail& trail) {
                const Vec3 at = moving.position();
                extend(trail, to_point(at), at[1] < 0);
                if (shot.drag != Drag::quadratic) measure(shot, at);
                if (at[1] < 0) world.remove_body(entity);
            });
        world.due<Salvo>([&](Salvo) {
            world.each<Shot>([&](Entity entity, const Shot&) { world.destroy(entity); });
            fire_salvo();
        });
    }

    void measure(const Shot& shot, const Vec3& at) {
        const Vec3 truth = exact(shot, world.time() - shot.fired);
        double& largest = largest_error[static_cast<std::size_t>(shot.drag)];
        largest = std::max(largest, std::hypot(at[0] - truth[0], at[1] - truth[1]));
    }

    Picture picture() const {
        Picture picture{.camera = {.centre = {280 / 6.0F, 140 / 6.0F}, .height = 60}};
        Plot{.box = {{40, 40}, {628, 310}},
             .title = "",
             .x_label = "distance, m",
             .y_label = "height, m",
             .x = {0, 98},
             .y = {0, 45}}
            .draw(picture, {});
        world.each<Shot>([&](Entity, const Shot& shot) { draw_exact(picture, shot); });
        world.each<Shot, Trail>([&](Entity entity, const Shot& shot, const Trail& trail) {
            draw_shot(picture, entity, shot, trail);
        });
        draw_labels(picture);
        return picture;
    }

    static void draw_exact(Picture& picture, const Shot& shot) {
        if (shot.drag == Drag::quadratic) return;
        Polyline curve{.width = 0.75F, .colour = palette::grey};
        double t = 0;
        do {
            curve.points.push_back(to_point(exact(shot, t)));
            t += 0.05;
        } while (curve.points.size() == 1 || curve.points.back().y > 0);
        cut_at_ground(curve.points);
        picture.polylines.push_back(std::move(curve));
    }

    void draw_shot(Picture& picture, Entity entity, const Shot& shot, const Trail& trail) const {
        const Colour colour = kinds[static_cast<std::size_t>(shot.drag)].colour;
        const ElementKey key = key_of(world, entity);
        Polyline path{.key = key,
                      .points = trail.points,
                      .width = 1.75F,
                      .colour = palette::faded(colour, 150)};
        if (world.has_body(entity)) path.points.push_back(to_point(world.position(entity)));
        if (path.points.empty()) return;
        picture.discs.push_back(
            {.key = key, .centre = path.points.back(), .radius = 0.55F, .colour = colour});
        picture.polylines.push_back(std::move(path));
    }

    void draw_labels(Picture& picture) const {
        add_text(picture, {16, 340},
                 fmt::format("{}   t = {:.2f} s", caption(world.settings().stepping), world.time()),
                 13, palette::ink);
        float y = 296;
        for (const Kind& kind : kinds) {
            const double error = largest_error[static_cast<std::size_t>(kind.drag)];
            picture.discs.push_back({.centre = {400, y + 3.5F},
                                     .radius = 4,
                                     .colour = kind.colour,
                                     .space = Space::canvas});
            add_text(picture, {410, y},
                     kind.drag == Drag::quadratic
                         ? std::string(kind.name)
                         : fmt::format("{}: error at most {}", kind.name, length_text(error)),
                     10, palette::ink);
            y -= 14;
        }
        picture.polylines.push_back({.points = {{394, y + 3.5F}, {406, y + 3.5F}},
                                     .width = 0.75F,
                                     .colour = palette::grey,
                                     .space = Space::canvas});
        add_text(picture, {410, y}, "exact", 10, palette::ink);
    }
};

int main(int argc, char** argv) { return run<Projectile>(argc, argv); }
