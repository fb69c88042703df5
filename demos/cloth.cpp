// SPDX-License-Identifier: MIT
// A cloth to pull, pin, cut and tear. At a rate below that of its fastest oscillation it tears
// itself to pieces.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "oiler/oiler.hpp"
#include "oiler/stability/stability.hpp"

using namespace oiler;

namespace {

constexpr Action pull{"pull", Mouse::left};
constexpr Action cut{"cut", Mouse::right, Key::x};
constexpr Action pin{"pin or unpin", Key::space, Mouse::middle};
constexpr Action again{"new cloth", Key::r};

constexpr int columns = 19, rows = 12;       // of bodies
constexpr double spacing = 0.17;             // m
constexpr double mass = 0.02;                // kg, of a body
constexpr double drag = 0.01;                // N·s/m
constexpr double stiffness = 70;             // N/m, of a thread
constexpr double damping = 0.01;             // N·s/m
constexpr double most_stretch = 2.1;         // of its length; then a thread tears
constexpr Vec3 gravity{0, -9.81};            // m/s²
constexpr double top = 1.25, ground = -1.7;  // m
constexpr double grasp = 0.25;               // m, around the mouse
constexpr double reach = 1;                  // m, of a pull
constexpr Link finger{.stiffness = 6, .damping = 0.1};
constexpr Link nail{.stiffness = 2 * stiffness};
constexpr std::array nailed{0, 4, 9, 14, 18};  // columns of the upper row

/// A spring of the cloth, between two bodies.
struct Thread {
    std::size_t a, b;
    LinkHandle link;
    double length;  // m
};
/// A spring from a body to a nail.
struct Nail {
    std::size_t body;
    LinkHandle link;
};
/// A spring from a body to the mouse.
struct Grip {
    std::size_t body;
    LinkHandle link;
    Vec3 offset;  // m, from the mouse
};

/// n of an endless flat net is 8. This one has edges: any method tears it, some slowly, at a rate
/// below that of this n, as measured.
constexpr double n_torn = 7.5;
/// Its weight stretches the net and turns its diagonals. From the rate of this n on, it hangs
/// without a tear, as measured; methods that damp hold at less.
constexpr double n_hanging = 8.4;
/// In no shape n is more than the sum of 8 threads at both ends of one.
constexpr double n_crumpled = 16;

/// The lowest rate from which on a wave of the cloth is stable, Hz; 1 if any is. A wave in which
/// neighbours move against each other is the fastest oscillation of a net: its ω² is n·k/m.
double lowest_rate(const Method& method, Damping where, double n) {
    const auto is_stable_at = [&](double rate) {
        const double springs = n / mass / rate;
        const Oscillation wave{springs * stiffness / rate, springs * damping + drag / mass / rate};
        return is_stable(step_matrices(method, where, std::span(&wave, 1)).front());
    };
    constexpr double step = 1.05;
    double rate = 20'000;
    while (rate > step && is_stable_at(rate / step)) rate /= step;
    if (rate <= step) return 1;
    double unstable = rate / step;
    while (rate - unstable > 0.1) {
        const double middle = (rate + unstable) / 2;
        (is_stable_at(middle) ? rate : unstable) = middle;
    }
    return std::ceil(rate);
}

/// The lowest stable rates of a method, Hz, which are kept.
struct Needs {
    double torn, hanging, crumpled;
};
const Needs& needs_of(const Method& method, Damping where) {
    static std::map<std::pair<const Method*, Damping>, Needs> known;
    const auto found = known.find({&method, where});
    if (found != known.end()) return found->second;
    return known[{&method, where}] = {lowest_rate(method, where, n_torn),
                                      lowest_rate(method, where, n_hanging),
                                      lowest_rate(method, where, n_crumpled)};
}

bool crosses(Point a, Point b, Point c, Point d) {
    const auto side = [](Point from, Point to, Point at) {
        return (to.x - from.x) * (at.y - from.y) - (to.y - from.y) * (at.x - from.x) > 0;
    };
    return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

}  // namespace

struct Cloth {
    static constexpr Control controls[] = {pull, cut, pin, again};
    static constexpr About about{.name = "cloth",
                                 .title = "A cloth to pull, pin, cut and tear",
                                 .rate = 120,
                                 .method = "velocity_verlet",
                                 .controls = controls};

    World world;
    std::vector<Entity> bodies;
    std::vector<Thread> threads;
    std::vector<Nail> nails;
    std::vector<Grip> grips;
    std::optional<Point> mouse;
    std::optional<Point> knife;  // where the mouse cut last

    explicit Cloth(const Settings& settings) : world(2, settings) {
        world.set_gravity(gravity);
        world.add_plane({.normal = {0, 1}, .offset = ground, .friction = 0.6});
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                bodies.push_back(world.spawn(
                    Body{
                        .mass = mass,
                        .position = {spacing * (column - (columns - 1) / 2.0), top - spacing * row},
                        .contact = Contact{0.02}},
                    LinearDrag{drag}));
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                for (const auto& [right, down] : {std::pair{1, 0}, {0, 1}, {1, 1}, {-1, 1}})
                    if (column + right >= 0 && column + right < columns && row + down < rows)
                        tie(body_at(column, row), body_at(column + right, row + down));
        for (const int column : nailed) nail_down(body_at(column, 0));
    }
    void hash(StateHash& hash) const {
        hash.add(threads.size(), nails.size(), grips.size(), mouse.has_value(), knife.has_value());
        for (const auto& point : {mouse, knife})
            if (point) hash.add(*point);
    }
    std::vector<Reading> readings() const { return {{"threads", double(threads.size())}}; }

    static std::size_t body_at(int column, int row) {
        return static_cast<std::size_t>(row * columns + column);
    }
    Vec3 position(std::size_t body) const { return world.position_of_row(body); }
    Point place(std::size_t body) const { return to_point(position(body)); }
    double apart(std::size_t a, std::size_t b) const { return length(position(a) - position(b)); }

    void tie(std::size_t a, std::size_t b) {
        const Link thread{.stiffness = stiffness, .damping = damping, .rest_length = apart(a, b)};
        threads.push_back({a, b, world.link(bodies[a], bodies[b], thread), thread.rest_length});
    }
    void nail_down(std::size_t body) {
        nails.push_back({body, world.link_to_point(bodies[body], position(body), nail)});
    }
    /// Removes the threads for which f(thread) is true.
    template <class F>
    void remove_threads(F f) {
        std::erase_if(threads, [&](const Thread& thread) {
            if (!f(thread)) return false;
            world.unlink(thread.link);
            return true;
        });
    }

    void update(const Input& input, Loop& loop) {
        if (input.pressed(again)) loop.restart();
        remove_threads([&](const Thread& thread) {
            return apart(thread.a, thread.b) > most_stretch * thread.length;
        });
        mouse = input.pointer();
        const std::optional<Point> before = std::exchange(knife, std::nullopt);
        if (!mouse || !input.held(pull)) let_go();
        if (!mouse) return;
        if (input.pressed(pull)) grip();
        drag_grips();
        if (input.pressed(pin)) pin_or_unpin();
        if (!input.held(cut)) return;
        knife = mouse;
        if (before)
            remove_threads([&](const Thread& thread) {
                return crosses(*before, *mouse, place(thread.a), place(thread.b));
            });
    }
    void grip() {
        for (const Entity body : world.within(to_vec(*mouse), grasp)) {
            const Vec3 at = world.position(body);
            grips.push_back(
                {world.row(body), world.link_to_point(body, at, finger), at - to_vec(*mouse)});
        }
    }
    void drag_grips() {
        for (const Grip& held : grips) {
            const Vec3 at = position(held.body);
            const Vec3 way = to_vec(*mouse) + held.offset - at;
            world.move_point(held.link, at + way * std::min(1.0, reach / (length(way) + 1e-9)));
        }
    }
    void let_go() {
        for (const Grip& held : grips) world.unlink(held.link);
        grips.clear();
    }
    void pin_or_unpin() {
        const auto distance = [&](Entity body) {
            return length(world.position(body) - to_vec(*mouse));
        };
        const std::vector<Entity> near = world.within(to_vec(*mouse), grasp);
        if (near.empty()) return;
        const std::size_t body = world.row(*std::ranges::min_element(near, {}, distance));
        const auto found = std::ranges::find(nails, body, &Nail::body);
        if (found == nails.end()) return nail_down(body);
        world.unlink(found->link);
        nails.erase(found);
    }

    Picture picture() const {
        Picture picture{.camera = {.centre = {0, -0.15F}, .height = 4.2F}};
        picture.polygons.push_back(
            {.points = rectangle({0, ground - 2}, {40, 4}), .colour = palette::pale, .layer = -1});
        draw_cloth(picture);
        draw_mouse(picture);
        draw_setting(picture);
        return picture;
    }

    /// 0 of a thread at its length, 1 of one that is about to tear.
    float strain(std::size_t a, std::size_t b, double rest) const {
        const double strain = (apart(a, b) / rest - 1) / (most_stretch - 1);
        return static_cast<float>(std::clamp(strain, 0.0, 1.0));
    }
    void draw_cloth(Picture& picture) const {
        const auto key = [&](std::uint32_t part, std::size_t body) {
            return key_of(world, bodies[body], part);
        };
        for (const auto& [a, b, link, rest] : threads) {
            if (b == a + columns + 1) {
                draw_patch(picture, key(1, a), {a, a + 1, b});
                draw_patch(picture, key(2, a), {a, a + columns, b});
            } else if (b == a + 1 || b == a + columns) {
                picture.polylines.push_back(
                    {key(b == a + 1 ? 1 : 2, a),
                     {place(a), place(b)},
                     0.8F,
                     palette::mix(palette::blue, palette::vermilion, strain(a, b, rest))});
            }
        }
        for (const Nail& one : nails)
            picture.discs.push_back({key(1, one.body), place(one.body), 0.045F, palette::ink});
    }
    /// A triangle whose first and last corner have a thread between them.
    void draw_patch(Picture& picture, ElementKey key, std::array<std::size_t, 3> corners) const {
        const auto& [a, b, c] = corners;
        if (std::max(apart(a, b), apart(b, c)) > most_stretch * spacing) return;
        const Colour colour = palette::mix(palette::sky_blue, palette::orange,
                                           strain(a, c, spacing * std::numbers::sqrt2));
        picture.polygons.push_back({.key = key,
                                    .points = {place(a), place(b), place(c)},
                                    .colour = palette::faded(colour, 170)});
    }
    void draw_mouse(Picture& picture) const {
        if (!mouse) return;
        picture.polylines.push_back({.points = circle(*mouse, static_cast<float>(grasp)),
                                     .colour = grips.empty() ? palette::grey : palette::orange});
        if (knife)
            picture.discs.push_back(
                {.centre = *mouse, .radius = 0.04F, .colour = palette::vermilion});
    }

    void draw_setting(Picture& picture) const {
        const auto& [method, rate, precision, damping_in] = world.settings().stepping;
        const Needs& needs = needs_of(*method, damping_in.value_or(method->damping));
        const auto hz = static_cast<double>(rate.steps);
        const Colour colour = hz < needs.torn       ? palette::vermilion
                              : hz < needs.crumpled ? palette::orange
                                                    : palette::green;
        const std::string words =
            needs.crumpled == 1
                ? "It holds at any rate."
                : fmt::format(
                      "It needs about {:.0f} Hz while it hangs, up to {:.0f} Hz crumpled: {}.",
                      needs.hanging, needs.crumpled,
                      hz < needs.torn       ? "it tears itself to pieces"
                      : hz < needs.hanging  ? "it may tear as it swings"
                      : hz < needs.crumpled ? "do not crumple it"
                                            : "it holds");
        add_text(picture, {14, 337}, fmt::format("{} at {} Hz", method->name, rate.steps), 15,
                 colour);
        add_text(picture, {14, 320}, words, 9, palette::ink);
        add_text(picture, {626, 337}, "F1: other rates and methods", 9, palette::grey,
                 Align::right);
        add_text(picture, {626, 320}, fmt::format("{} threads", threads.size()), 9, palette::grey,
                 Align::right);
        add_text(picture, {320, 10},
                 "Left button: pull   Right button: cut   Space: pin or unpin   R: new cloth", 10,
                 palette::ink, Align::centre);
    }
};

int main(int argc, char** argv) { return run<Cloth>(argc, argv); }
