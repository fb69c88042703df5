// SPDX-License-Identifier: MIT
// A map of where a damped spring comes to rest, rings or explodes with a method. The mouse drags a
// crosshair over it, and the spring beside it does what that point says.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "oiler/oiler.hpp"
#include "oiler/physics/closed_forms.hpp"
#include "oiler/plot/plot.hpp"
#include "oiler/stability/stability.hpp"

using namespace oiler;

namespace {

constexpr Action drag{"drag the crosshair, choose a method", Mouse::left};
constexpr Action next_method{"next method", Key::space, Pad::south};
constexpr Axis across{"frequency", Key::left, Key::right, Stick::left_x};
constexpr Axis upwards{"damping", Key::down, Key::up, Stick::left_y};

constexpr int columns = 100, rows = 71;  // of the map
constexpr int fine = 4;                  // texels of a column or a row
constexpr double column_width = 0.032;   // of ω·dt
constexpr double row_height = 0.02;      // of ζ
constexpr double widest = columns * column_width, most_damped = (rows - 1) * row_height;
constexpr Box map_box{{44, 60}, {316, 312}}, curve_box{{436, 178}, {626, 306}};
constexpr Point list_at{346, 117};  // the upper left corner of the methods
constexpr float list_line = 13;
constexpr int steps = 40;                // of the curve
constexpr double shown_rate = 10;        // steps per second on the screen
constexpr double most_seen = 1.5;        // m
constexpr double far_away = 20;          // m
constexpr double rest_at_end = 4;        // steps on the screen, at the end
constexpr double little = 0.1;           // of the amplitude, after a period: it comes to rest
constexpr double crosshair_speed = 0.4;  // 1/s

constexpr Colour rests = palette::mix(palette::paper, palette::sky_blue, 0.75F);
constexpr Colour rings{250, 232, 140};

/// A method, and where it puts damping.
struct Choice {
    const Method* method;
    Damping damping;
    friend auto operator<=>(const Choice&, const Choice&) = default;
};

std::string describe(const Choice& choice) {
    const bool is_splitting = std::holds_alternative<Splitting>(choice.method->rule);
    return is_splitting
               ? fmt::format("{}, damping in the {}", choice.method->name, name_of(choice.damping))
               : std::string(choice.method->name);
}

Oscillation oscillation(double omega_dt, double zeta) {
    return {omega_dt * omega_dt, 2 * zeta * omega_dt};
}

/// The factor on the amplitude in one period of the undamped spring.
double per_period(double radius, double omega_dt) {
    return std::pow(radius, 2 * std::numbers::pi / omega_dt);
}
double radius_of(const StepMatrix& step) { return static_cast<double>(spectral_radius(step)); }
double true_per_period(double zeta) {
    const double slowest = zeta < 1 ? zeta : zeta - std::sqrt(zeta * zeta - 1);
    return std::exp(-2 * std::numbers::pi * slowest);
}

/// A spring of the map.
struct Spot {
    double radius;  // spectral, of a step
    bool explodes;
};

/// The map of a method.
struct Map {
    std::vector<Spot> spots;  // row by row from the lowest
    std::shared_ptr<const Bitmap> bitmap;
    std::array<double, rows> limits{};  // ω·dt of the border
};

/// The colour of a place of the map, in columns and rows from the lowest spring.
Colour colour_at(const Map& map, double x, double y) {
    const int column = std::min(static_cast<int>(x), columns - 2);
    const int row = std::min(static_cast<int>(y), rows - 2);
    const double right = x - column, up = y - row;
    const auto spot = [&](int i, int j) {
        return map.spots[static_cast<std::size_t>((row + j) * columns + column + i)];
    };
    const double radius = std::lerp(std::lerp(spot(0, 0).radius, spot(1, 0).radius, right),
                                    std::lerp(spot(0, 1).radius, spot(1, 1).radius, right), up);
    const double omega_dt = column_width * (x + 1);
    const double beyond = omega_dt - std::lerp(map.limits[static_cast<std::size_t>(row)],
                                               map.limits[static_cast<std::size_t>(row + 1)], up);
    const bool explodes = std::abs(beyond) < column_width
                              ? beyond > 0
                              : spot(right > 0.5 ? 1 : 0, up > 0.5 ? 1 : 0).explodes;
    const double left = per_period(radius, omega_dt);
    if (!explodes) return left > little ? rings : rests;
    return palette::mix(palette::paper, palette::vermilion,
                        static_cast<float>(std::clamp(0.4 + std::log10(left) / 4, 0.4, 1.0)));
}

/// Borders are smooth: a texel has the mean colour of several places.
std::shared_ptr<const Bitmap> draw(const Map& map) {
    constexpr int samples = 3, width = columns * fine, height = rows * fine;
    const auto place = [](int texel, int sample, int most) {
        const double at = (samples * texel + sample + 0.5) / (samples * fine) - 0.5;
        return std::clamp(at, 0.0, most - 1.0);
    };
    std::vector<std::uint8_t> texels;
    for (int texel = 0; texel < width * height; ++texel) {
        std::array<int, 3> sum{};
        for (int i = 0; i < samples * samples; ++i) {
            const Colour one = colour_at(map, place(texel % width, i % samples, columns),
                                         place(height - 1 - texel / width, i / samples, rows));
            sum[0] += one.r, sum[1] += one.g, sum[2] += one.b;
        }
        for (const int channel : sum)
            texels.push_back(static_cast<std::uint8_t>(channel / (samples * samples)));
        texels.push_back(255);
    }
    return make_bitmap({width, height}, std::move(texels));
}

/// Measures a step of each spring of the map, and the border of each row by bisection.
Map make_map(const Choice& choice) {
    const auto measure = [&](const std::vector<Oscillation>& springs) {
        return step_matrices(*choice.method, choice.damping, springs);
    };
    std::vector<Oscillation> springs;
    for (int row = 0; row < rows; ++row)
        for (int column = 1; column <= columns; ++column)
            springs.push_back(oscillation(column * column_width, row * row_height));
    const std::vector<StepMatrix> measured = measure(springs);

    Map map;
    for (int row = 0; row < rows; ++row) {
        const auto first = measured.begin() + row * columns;
        for (int column = 1; column <= columns; ++column)
            map.spots.push_back({radius_of(first[column - 1]), !is_stable(first[column - 1])});
        const auto stable = std::find_if_not(first, first + columns, is_stable) - first;
        map.limits[static_cast<std::size_t>(row)] = static_cast<double>(stable) * column_width;
    }
    for (double width = column_width / 2; width > 1e-6; width /= 2) {
        springs.clear();
        for (std::size_t row = 0; row < rows; ++row)
            springs.push_back(
                oscillation(map.limits[row] + width, static_cast<double>(row) * row_height));
        const std::vector<StepMatrix> tried = measure(springs);
        for (std::size_t row = 0; row < rows; ++row)
            if (is_stable(tried[row])) map.limits[row] += width;
    }
    map.bitmap = draw(map);
    return map;
}

/// A map takes some tens of milliseconds, so it is kept.
const Map& map_of(const Choice& choice) {
    static std::map<Choice, Map> maps;
    const auto found = maps.find(choice);
    return found != maps.end() ? found->second
                               : maps.emplace(choice, make_map(choice)).first->second;
}

}  // namespace

struct StabilityMap {
    static constexpr Control controls[] = {drag, next_method, across, upwards};
    static constexpr About about{.name = "stability_map",
                                 .title = "Where a spring rests, rings or explodes",
                                 .rate = 60,
                                 .controls = controls};

    World world;              // without bodies: it has the method, the rate and the time
    double x = 1.7, y = 0.1;  // of the crosshair: ω·dt and ζ
    bool is_dragged = false;
    double released = 0;  // s, when the spring was let go

    explicit StabilityMap(const Settings& settings) : world(1, settings) {}
    void hash(StateHash& hash) const { hash.add(x, y, is_dragged, released, describe(choice())); }

    Choice choice() const {
        const Stepping& stepping = world.settings().stepping;
        return {stepping.method, damping_of(stepping)};
    }
    std::vector<Choice> choices() const {
        std::vector<Choice> list;
        for (const char* const name :
             {"explicit_euler", "semi_implicit_euler", "velocity_verlet", "rk4", "implicit_euler"})
            list.push_back({&find_method(name), find_method(name).damping});
        list.insert(list.begin() + 2, {list[1].method, Damping::in_drift});
        if (std::ranges::find(list, choice()) == list.end()) list.push_back(choice());
        return list;
    }
    double omega_dt() const { return std::round(100 * x) / 100; }
    std::size_t row() const { return static_cast<std::size_t>(std::lround(y / row_height)); }
    double zeta() const { return row_height * static_cast<double>(row()); }
    Rate rate() const { return world.settings().stepping.rate; }
    double omega() const { return omega_dt() / rate().dt(); }  // rad/s
    double stiffness() const { return omega() * omega(); }     // N/m, of 1 kg
    double damping() const { return 2 * zeta() * omega(); }    // N·s/m

    void update(const Input& input) {
        const auto pointer = input.pointer_canvas();
        if (input.pressed(drag) && pointer) press(*pointer);
        is_dragged = is_dragged && input.held(drag);
        if (is_dragged && pointer) {
            x = (pointer->x - map_box.low.x) / (map_box.high.x - map_box.low.x) * widest;
            y = (pointer->y - map_box.low.y) / (map_box.high.y - map_box.low.y) * most_damped;
        }
        x = std::clamp(x + crosshair_speed * world.dt() * input.axis(across), 0.02, widest);
        y = std::clamp(y + crosshair_speed * world.dt() * input.axis(upwards), 0.0, most_damped);
        if (!input.pressed(next_method)) return;
        const std::vector<Choice> list = choices();
        const auto next = std::ranges::find(list, choice()) + 1;
        choose(next == list.end() ? list.front() : *next);
    }
    void press(Point pointer) {
        is_dragged = std::clamp(pointer.x, map_box.low.x, map_box.high.x) == pointer.x &&
                     std::clamp(pointer.y, map_box.low.y, map_box.high.y) == pointer.y;
        if (is_dragged) released = world.time();
        const std::vector<Choice> list = choices();
        const float line = (list_at.y - pointer.y) / list_line;
        if (pointer.x > list_at.x && line > 0 && line < static_cast<float>(list.size()))
            choose(list[static_cast<std::size_t>(line)]);
    }
    void choose(const Choice& chosen) {
        Stepping stepping = world.settings().stepping;
        stepping.method = chosen.method;
        stepping.damping = chosen.damping;
        world.set_stepping(stepping);
        released = world.time();
    }
    /// The positions of the spring after each step, m, let go at 1 m, until it is far away.
    std::vector<double> simulate() const {
        World alone(1, world.settings());
        const Entity mass =
            alone.spawn({.position = {1}}, Spring{.stiffness = stiffness(), .damping = damping()});
        std::vector<double> path{1};
        while (path.size() <= steps && std::abs(path.back()) < far_away) {
            alone.step();
            path.push_back(alone.position(mass)[0]);
        }
        return path;
    }

    Picture picture() const {
        Picture picture;
        draw_map(picture, map_of(choice()));
        draw_spring(picture);
        draw_verdict(picture);
        draw_list(picture);
        add_text(
            picture, {320, 8},
            "Drag the crosshair, or press the arrows. Click a method, or press Space for the next.",
            9, palette::grey, Align::centre);
        return picture;
    }

    static void line(Picture& picture, Point from, Point to, float width,
                     Colour colour = palette::ink) {
        picture.polylines.push_back(
            {.points = {from, to}, .width = width, .colour = colour, .space = Space::canvas});
    }
    static void disc(Picture& picture, Point centre, float radius, Colour colour) {
        picture.discs.push_back(
            {.centre = centre, .radius = radius, .colour = colour, .space = Space::canvas});
    }

    void draw_map(Picture& picture, const Map& map) const {
        Plot plot{.box = map_box,
                  .x_label = "frequency × timestep, ω·dt",
                  .y_label = "damping ratio",
                  .x = {0, widest},
                  .y = {0, most_damped},
                  .x_ticks = 6,
                  .y_ticks = 3};
        const Point low = plot.to_canvas({column_width / 2, -row_height / 2});
        const Point high =
            plot.to_canvas({widest + column_width / 2, most_damped + row_height / 2});
        picture.sprites.push_back({.centre = {(low.x + high.x) / 2, (low.y + high.y) / 2},
                                   .size = {high.x - low.x, high.y - low.y},
                                   .bitmap = map.bitmap,
                                   .space = Space::canvas});
        const auto curve = [&](std::vector<DataPoint> points, float width) {
            plot.series.push_back(
                {.colour = palette::ink, .points = std::move(points), .width = width});
        };
        std::vector<DataPoint> border;
        for (int row = 0; row < rows; ++row)
            border.push_back({map.limits[static_cast<std::size_t>(row)], row * row_height});
        curve(std::move(border), 2);
        curve({{omega_dt(), 0}, {omega_dt(), most_damped}}, 1);
        curve({{0, zeta()}, {widest, zeta()}}, 1);
        for (const auto& [colour, name] :
             {std::pair{rests, "rests"}, {rings, "rings"}, {palette::vermilion, "explodes"}})
            plot.series.push_back({.name = name, .colour = colour, .points = {{0, 0}}, .width = 8});
        plot.draw(picture, {});
        const Point at = plot.to_canvas({omega_dt(), zeta()});
        disc(picture, at, 6, palette::ink);
        disc(picture, at, 4, palette::paper);
    }

    void draw_spring(Picture& picture) const {
        const std::vector<double> path = simulate();
        const auto last = static_cast<double>(path.size()) - 1;
        const double step = std::min(
            std::fmod((world.time() - released) * shown_rate, last + rest_at_end), last - 0.001);
        const auto before = static_cast<std::size_t>(step);
        const double at = std::lerp(path[before], path[before + 1], step - std::floor(step));
        Plot plot{.box = curve_box,
                  .x_label = "step",
                  .y_label = "position, m",
                  .x = {0, steps},
                  .y = {-most_seen, most_seen},
                  .x_ticks = 4,
                  .y_ticks = 3};
        Series exact{.name = "true", .colour = palette::orange};
        for (int i = 0; i <= 16 * steps; ++i) {
            const double t = i / 16.0;
            exact.points.push_back(
                {t, damped_oscillator(1.0, stiffness(), damping(), {1.0, 0.0}, t * rate().dt()).x});
        }
        Series drawn{.name = "simulated", .colour = palette::blue, .width = 2};
        for (std::size_t i = 0; i < path.size(); ++i)
            drawn.points.push_back({static_cast<double>(i), path[i]});
        plot.series = {std::move(exact), std::move(drawn)};
        plot.draw(picture, {});

        const bool is_lost = std::abs(at) > most_seen;
        const Point dot = plot.to_canvas({step, std::clamp(at, -most_seen, most_seen)});
        const Point hook{372, 316}, mass{hook.x, dot.y};
        const Colour colour = is_lost ? palette::vermilion : palette::blue;
        line(picture, {hook.x - 18, hook.y}, {hook.x + 18, hook.y}, 3);
        picture.polylines.push_back({.points = coil(hook, mass, 10, 7),
                                     .width = 1.5F,
                                     .colour = palette::grey,
                                     .space = Space::canvas});
        line(picture, mass, dot, 0.7F, palette::faded(palette::grey, 120));
        disc(picture, mass, 10, colour);
        disc(picture, dot, 3.5F, colour);
        if (is_lost)
            add_text(picture, {hook.x, 163}, fmt::format("{:.2g} m", at), 9, colour, Align::centre);
    }

    void draw_verdict(Picture& picture) const {
        const Oscillation spring = oscillation(omega_dt(), zeta());
        const StepMatrix step =
            step_matrices(*choice().method, choice().damping, std::span(&spring, 1)).front();
        const double left = per_period(radius_of(step), omega_dt());
        if (is_stable(step))
            add_text(picture, {352, 334},
                     fmt::format("{}: {:.0f} % left after a period",
                                 left < little ? "rests" : "rings", 100 * left),
                     14, palette::blue);
        else
            add_text(picture, {352, 334},
                     fmt::format("explodes: × {:.3g} per step", radius_of(step)), 14,
                     palette::vermilion);
        add_text(picture, {352, 147},
                 fmt::format("ω·dt = {:.2f} at {} Hz, ζ = {:.2f}: truly, {:.0f} % left", omega_dt(),
                             rate().steps, zeta(), 100 * true_per_period(zeta())),
                 9, palette::ink);
        add_text(picture, {352, 133}, limit_text(), 9, palette::ink);
    }
    /// What the point means for a game at the rate of the world.
    std::string limit_text() const {
        const std::string here = fmt::format("1 kg on {:.0f} N/m", stiffness());
        const double limit = map_of(choice()).limits[row()];
        if (limit < column_width / 2) return here + " explodes at any rate.";
        if (limit > widest) return here + " at this rate: the limit is off the map.";
        return fmt::format("{} needs ω·dt ≤ {:.2f}, so {:.0f} Hz.", here, limit,
                           std::ceil(omega() / limit));
    }

    void draw_list(Picture& picture) const {
        const std::vector<Choice> list = choices();
        for (std::size_t i = 0; i < list.size(); ++i) {
            const Point at{352, list_at.y - list_line * (static_cast<float>(i) + 0.5F)};
            if (list[i] == choice())
                picture.polygons.push_back({.points = rectangle({486, at.y}, {280, list_line}),
                                            .colour = palette::pale,
                                            .space = Space::canvas});
            add_text(picture, {at.x, at.y - 3}, describe(list[i]), 9, palette::ink);
        }
    }
};

int main(int argc, char** argv) { return run<StabilityMap>(argc, argv); }
