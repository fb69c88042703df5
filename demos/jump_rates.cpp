// SPDX-License-Identifier: MIT
// A platform character in five lanes: the same keys and the same jump, stepped at five rates. A
// chart beside the lanes shows which of them reach a ledge at 2.00 m.
// --method changes the method of all lanes, --rate the rate of the last one.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "oiler/oiler.hpp"

using namespace oiler;

namespace {

constexpr Axis walk{
    "walk", {Key::left, Key::a, Pad::left}, {Key::right, Key::d, Pad::right}, Stick::left_x};
constexpr Action jump{"jump", Key::space, Key::up, Key::w, Mouse::left, Pad::south};

constexpr double gravity = 20, take_off = 9, walking = 3;        // m/s², m/s, m/s
constexpr double true_apex = take_off * take_off / 2 / gravity;  // m
constexpr double ledge = 2, ledge_left = 9, ledge_right = 14;    // m
constexpr double track = 20.6, start = 7;                        // m
constexpr double patience = 0.2;                                 // s that an early press is kept
constexpr double never = -1;                                     // s
constexpr std::int64_t show = 4;  // s, the demo until a key is pressed
constexpr Contact sole{0.3};
constexpr std::array<std::int64_t, 4> slow_rates{20, 30, 60, 120};  // Hz

struct Wish {
    double walk = 0;  // -1 to 1
    bool jump = false;
};

/// The character of a lane.
struct Player {
    Entity body{};
    Vec3 before{};     // m, before the last step
    double floor = 0;  // m
    double apex = 0;   // m, of the last jump
    bool must_jump = false;
    bool is_flying = false;
    std::vector<Vec3> path{};  // of the feet in the last jump, m, one point per step
    void hash(StateHash& hash) const { hash.add(before, floor, apex, must_jump, is_flying); }

    static Vec3 feet(const Vec3& centre) { return centre - Vec3{0, sole.radius}; }
    [[nodiscard]] Vec3 feet(const World& world) const { return feet(world.position(body)); }
    [[nodiscard]] bool stands(const World& world) const {
        return feet(world)[1] < floor + 1e-6 && world.velocity(body)[1] < 1e-6;
    }

    [[nodiscard]] bool rises() const {
        return is_flying && path.back()[1] - path.front()[1] >= apex;
    }

    void enter(World& world) {
        world.set_gravity({0, -gravity});
        world.add_plane({.normal = {0, 1}});
        before = {start, sole.radius};
        body = world.spawn(Body{.position = before, .contact = sole});
        world.add(body, Name{"hero"});
    }
    /// Does what the player wants, before a step. The ledge is a floor from above only.
    void act(World& world, double direction) {
        const Vec3 at = feet(world);
        const bool on_ledge = at[1] > ledge - 1e-6 && at[0] > ledge_left && at[0] < ledge_right;
        if (const double below = on_ledge ? ledge : 0; below != std::exchange(floor, below)) {
            world.clear_planes();
            world.add_plane({.normal = {0, 1}, .offset = below});
        }
        const bool jumps = std::exchange(must_jump, false);
        const bool at_end = direction < 0 ? at[0] < 0.3 : at[0] > track - 0.3;
        world.set_velocity(
            body, {at_end ? 0 : walking * direction, jumps ? take_off : world.velocity(body)[1]});
        if (jumps) {
            path = {at};
            apex = 0;
            is_flying = true;
        }
        before = world.position(body);
    }
    void go_back(World& world) {
        before = {start, sole.radius};
        world.teleport(body, before);
        world.set_velocity(body, {});
    }
    /// Looks where a step has led.
    void see(const World& world) {
        if (!is_flying) return;
        path.push_back(feet(world));
        apex = std::max(apex, path.back()[1] - path.front()[1]);
        is_flying = !stands(world);
    }
};

struct Lane {
    World world;
    Player player;
    [[nodiscard]] std::int64_t rate() const { return world.settings().stepping.rate.steps; }
};

}  // namespace

struct JumpRates {
    static constexpr Control controls[] = {walk, jump};
    static constexpr About about{.name = "jump_rates",
                                 .title = "The same jump at five rates: which reach the ledge?",
                                 .rate = 240,
                                 .duration = show,
                                 .controls = controls,
                                 .changes_in_play = false,
                                 .has_line = false};  // it would speak of one lane

    World world;
    Player player;
    std::vector<Lane> slow;     // each at most one step ahead of `world`
    bool is_played = false;     // nobody has pressed a key yet
    double pressed_at = never;  // s, the last press of jump
    float facing = 1;

    explicit JumpRates(const Settings& settings) : world(2, settings) {
        player.enter(world);
        for (const std::int64_t rate : slow_rates) {
            Settings own = settings;
            own.stepping.rate = {rate};
            slow.push_back({World(2, own), {}});
            slow.back().player.enter(slow.back().world);
        }
    }
    /// Adds what the world does not hold to the hash of a state.
    void hash(StateHash& hash) const {
        hash.add(player, is_played, pressed_at);
        for (const Lane& lane : slow) hash.add(lane.world.state_hash(), lane.player);
    }
    std::vector<Reading> readings() const { return {{"apex", player.apex, "m"}}; }

    void update(const Input& input) {
        player.see(world);
        is_played = is_played || input.pressed(jump) || input.axis(walk) != 0;
        const Wish wish = is_played ? Wish{input.axis(walk), input.pressed(jump)} : example();
        if (wish.walk != 0) facing = wish.walk > 0 ? 1 : -1;
        if (wish.jump) pressed_at = world.time();
        if (world.time() - pressed_at < patience && all_stand()) {
            pressed_at = never;
            player.must_jump = true;
            for (Lane& lane : slow) lane.player.must_jump = true;
        }
        player.act(world, wish.walk);
        const std::int64_t rate = world.settings().stepping.rate.steps;
        for (Lane& lane : slow)
            while (lane.world.tick() * rate < (world.tick() + 1) * lane.rate()) {
                lane.player.act(lane.world, wish.walk);
                lane.world.step();
                lane.player.see(lane.world);
            }
    }

    /// What the character does until somebody plays.
    Wish example() {
        constexpr double take_off_at = 0.5, to = 1.6;  // s
        const std::int64_t rate = world.settings().stepping.rate.steps;
        const std::int64_t tick = world.tick() % (show * rate);
        const auto begins = [&](double at) {
            return tick == std::llround(at * static_cast<double>(rate));
        };
        if (world.tick() > 0 && begins(0)) {
            player.go_back(world);
            for (Lane& lane : slow) lane.player.go_back(lane.world);
        }
        return {static_cast<double>(tick) < to * static_cast<double>(rate) ? 1.0 : 0.0,
                begins(take_off_at)};
    }
    bool all_stand() const {
        return player.stands(world) && std::ranges::all_of(slow, [](const Lane& lane) {
                   return lane.player.stands(lane.world);
               });
    }

    Picture picture() const {
        // The camera sees the last lane where it is drawn, so that a pixel and the rings of the
        // inspector are right.
        const Point ground = place(slow.size(), {});
        Picture picture{.camera = {.centre = {(canvas_width / 2 - ground.x) / metre,
                                              (canvas_height / 2 - ground.y) / metre},
                                   .height = canvas_height / metre}};
        for (std::size_t i = 0; i < slow.size(); ++i) {
            const Lane& lane = slow[i];
            const double ahead =
                (lane.world.time() - world.time()) * static_cast<double>(lane.rate());
            const Vec3 after = lane.world.position(lane.player.body);
            draw_lane(picture, i, lane.world, lane.player,
                      after + ahead * (lane.player.before - after));
        }
        draw_lane(picture, slow.size(), world, player, world.position(player.body));
        add_text(picture, {chart_x(ledge) - 2, 332}, "ledge 2.00 m", 9, palette::ink, Align::right);
        add_text(picture, {626, 346}, "true apex 2.025 m", 9, palette::green, Align::right);
        add_text(picture, {14, 10}, "← → walk, Space jumps: all five obey", 10, palette::ink);
        add_text(picture, {626, 10}, std::string(world.settings().stepping.method->name), 10,
                 palette::grey, Align::right);
        return picture;
    }

    static constexpr float lane_height = 61, first_ground = 285;
    static constexpr float metre = 19, left = 62;                // units of the canvas
    static constexpr double chart_low = 1.75, chart_high = 2.3;  // m
    static Point place(std::size_t lane, const Vec3& at) {
        return {left + metre * static_cast<float>(at[0]),
                first_ground - lane_height * static_cast<float>(lane) +
                    metre * static_cast<float>(at[1])};
    }
    static float chart_x(double height) {
        const double share = (height - chart_low) / (chart_high - chart_low);
        return static_cast<float>(450 + 176 * std::clamp(share, 0.0, 1.0));
    }
    static void line(Picture& picture, std::vector<Point> points, float width, Colour colour) {
        picture.polylines.push_back({.points = std::move(points),
                                     .width = width,
                                     .colour = colour,
                                     .space = Space::canvas});
    }
    static void block(Picture& picture, Point low, Point high, Colour colour, ElementKey key = {}) {
        picture.polygons.push_back({.key = key,
                                    .points = {low, {high.x, low.y}, high, {low.x, high.y}},
                                    .colour = colour,
                                    .space = Space::canvas});
    }

    /// Draws a lane whose character has its centre at `shown`.
    void draw_lane(Picture& picture, std::size_t index, const World& of, const Player& who,
                   const Vec3& shown) const {
        const auto at = [&](double x, double y) { return place(index, {x, y}); };
        const bool misses = !who.rises() && who.apex < ledge;
        const Colour colour = misses ? palette::vermilion : palette::blue;
        block(picture, at(0, -0.2), at(track, 0), palette::grey);
        block(picture, at(ledge_left, ledge - 0.25), at(ledge_right, ledge), palette::ink);
        add_text(picture, at(ledge_right + 0.3, ledge - 0.3), "2.00 m", 8, palette::grey);
        add_text(picture, at(-2.6, 1), fmt::format("{}", of.settings().stepping.rate.steps), 18,
                 palette::ink);
        add_text(picture, at(-2.6, 0.2), "Hz", 10, palette::ink);
        std::vector<Point> path;
        for (const Vec3& feet : who.path) path.push_back(at(feet[0], feet[1]));
        if (of.settings().stepping.rate.steps <= 60)
            for (const Point& one : path)
                picture.discs.push_back({.centre = one,
                                         .radius = 1.3F,
                                         .colour = palette::faded(colour, 160),
                                         .space = Space::canvas});
        line(picture, std::move(path), 1, palette::faded(colour, 160));
        draw_character(picture, key_of(of, who.body, static_cast<std::uint32_t>(10 * index)),
                       place(index, Player::feet(shown)), colour);
        draw_chart(picture, at(0, 0.2).y, who, colour);
    }

    /// Draws the apex of a lane on an axis of its height, from the canvas height `low` up.
    static void draw_chart(Picture& picture, float low, const Player& who, Colour colour) {
        constexpr float foot = 16, dot = 28, head = 40;
        for (const auto& [height, ink] :
             {std::pair{ledge, palette::ink}, {true_apex, palette::green}})
            line(picture, {{chart_x(height), low + foot}, {chart_x(height), low + head}}, 1.5F,
                 ink);
        const double apex = who.apex;
        if (apex == 0) return;
        picture.discs.push_back({.centre = {chart_x(apex), low + dot},
                                 .radius = 4,
                                 .colour = colour,
                                 .space = Space::canvas});
        constexpr double half = 1e-9;                                  // rounds up
        const double off = 100 * (std::abs(apex - true_apex) + half);  // cm
        if (who.rises()) return;
        add_text(picture, {chart_x(chart_low), low}, fmt::format("{:.3f} m", apex + half), 10,
                 palette::ink);
        add_text(picture, {chart_x(chart_high), low},
                 off < 0.05
                     ? "exact"
                     : fmt::format("{:.1f} cm too {}", off, apex < true_apex ? "low" : "high"),
                 10, colour, Align::right);
    }

    void draw_character(Picture& picture, ElementKey key, Point feet, Colour colour) const {
        block(picture, {feet.x - 3.5F, feet.y}, {feet.x + 3.5F, feet.y + 10}, colour, key);
        const auto disc = [&](Point centre, float radius, Colour ink) {
            ++key.part;
            picture.discs.push_back({.key = key,
                                     .centre = {feet.x + centre.x, feet.y + centre.y},
                                     .radius = radius,
                                     .colour = ink,
                                     .space = Space::canvas});
        };
        disc({0, 13}, 4.5F, colour);
        disc({2 * facing, 14}, 1.2F, palette::paper);
    }
};

int main(int argc, char** argv) { return run<JumpRates>(argc, argv); }
