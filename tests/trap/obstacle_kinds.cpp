// SPDX-License-Identifier: MIT
// Balls among circles, boxes, segments, chains and tiles, which may move. They have a radius: what
// points do at corners is not checked, nor are layers, belts and one-way sides.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "trap/traps.hpp"

namespace oiler::trap {
namespace {

constexpr double radius = 0.125;  ///< m, of the balls

double rounded(double number) { return std::stod(fmt::format("{:.4g}", number)); }

std::string surface_of(Dice& dice) {
    const int choice = dice.whole(0, 4);
    const double restitution = choice == 0 ? 0 : choice == 1 ? 1 : rounded(dice.uniform(0.2, 0.95));
    return fmt::format("restitution = {}\nfriction = {}\n", restitution,
                       dice.chance(0.4) ? 0 : rounded(dice.uniform(0.02, 1)));
}

/// Constant velocity or a swing.
std::string motion_of(Dice& dice, bool swings) {
    if (!swings)
        return fmt::format("velocity = [{}, {}]\n", rounded(dice.uniform(-2, 2)),
                           rounded(dice.uniform(-1, 1)));
    return fmt::format("swing = [{}, {}]\nperiod = {}\nphase = {}\n",
                       dice.chance(0.5) ? 0 : rounded(dice.uniform(-0.5, 0.5)),
                       rounded(dice.uniform(-0.4, 0.4)), rounded(dice.uniform(0.5, 3)),
                       rounded(dice.uniform(0, 6)));
}

void circle(Draft& draft, double x, double y, double size, const std::string& more) {
    draft.text +=
        fmt::format("[[obstacle]]\nshape = \"circle\"\ncentre = [{}, {}]\nradius = {}\n{}",
                    rounded(x), rounded(y), rounded(size), more);
}

void box(Draft& draft, double x, double y, double width, double height, double angle,
         const std::string& more) {
    draft.text += fmt::format(
        "[[obstacle]]\nshape = \"box\"\ncentre = [{}, {}]\nsize = [{}, {}]\nangle = {}\n{}",
        rounded(x), rounded(y), rounded(width), rounded(height), rounded(angle), more);
}

std::string some_drag(Dice& dice) {
    const int choice = dice.whole(0, 2);
    return fmt::format("linear_drag = {}\nquadratic_drag = {}\n",
                       choice == 1 ? rounded(dice.log_uniform(0.01, 1)) : 0,
                       choice == 2 ? rounded(dice.log_uniform(0.01, 0.3)) : 0);
}

/// A ball with drag or in wind, above y = 0.6 m.
std::string ball(Dice& dice, Draft& draft) {
    const std::string name =
        draft.body(rounded(dice.log_uniform(0.2, 5)),
                   {rounded(dice.uniform(-0.8, 0.8)), rounded(dice.uniform(0.6, 2.5))},
                   {rounded(dice.uniform(-2, 2)), rounded(dice.uniform(-3, 3))},
                   some_drag(dice) + fmt::format("contact = {}\n", radius));
    if (dice.chance(0.2))
        draft.wind(name, {rounded(dice.uniform(-8, 8)), rounded(dice.uniform(-2, 2))},
                   rounded(dice.log_uniform(0.01, 0.2)));
    return name;
}

void balls(Dice& dice, Draft& draft, double longest) {
    draft.axes = 2;
    draft.gravity(9.81);
    for (int i = dice.whole(1, 2); i > 0; --i) ball(dice, draft);
    draft.shortest = 0.7;
    draft.longest = longest;
}

void pegs(Dice& dice, Draft& draft) {
    balls(dice, draft, 2);
    for (int i = dice.whole(1, 5); i > 0; --i)
        circle(draft, dice.uniform(-1.5, 1.5), dice.uniform(-2, 0), dice.uniform(0.05, 0.4),
               surface_of(dice));
}

/// A turned box over one that lies, on which balls slide or come to rest.
void turned_boxes(Dice& dice, Draft& draft) {
    balls(dice, draft, 4);
    box(draft, 0, -0.5, dice.uniform(0.5, 3), dice.uniform(0.1, 1), dice.uniform(-0.7, 0.7),
        surface_of(dice));
    box(draft, 0, -3, 20, 1, 0, surface_of(dice));
}

void segments(Dice& dice, Draft& draft) {
    balls(dice, draft, 3);
    for (int i = dice.whole(1, 3); i > 0; --i)
        draft.text += fmt::format(
            "[[obstacle]]\nshape = \"segment\"\nfrom = [{}, {}]\nto = [{}, {}]\n{}",
            rounded(dice.uniform(-2, -0.5)), rounded(dice.uniform(-1, 0.2)),
            rounded(dice.uniform(0.5, 2)), rounded(dice.uniform(-1, 0.2)), surface_of(dice));
}

void chain(Dice& dice, Draft& draft) {
    balls(dice, draft, 3);
    std::string points;
    const int count = dice.whole(3, 6);
    for (int i = 0; i < count; ++i)
        points += fmt::format("{}[{}, {}]", i > 0 ? ", " : "",
                              rounded(-2 + 4.0 * i / (count - 1) + dice.uniform(-0.2, 0.2)),
                              rounded(dice.uniform(-0.8, 0.2)));
    draft.text += fmt::format("[[chain]]\npoints = [{}]\n{}{}", points, surface_of(dice),
                              dice.chance(0.25) ? motion_of(dice, dice.chance(0.5)) : "");
}

void moving(Dice& dice, Draft& draft, bool swings) {
    balls(dice, draft, 3);
    const std::string more = surface_of(dice) + motion_of(dice, swings);
    const int choice = dice.whole(0, 2);
    if (choice == 0)
        circle(draft, dice.uniform(-0.5, 0.5), -0.5, dice.uniform(0.2, 1), more);
    else
        box(draft, 0, -0.5, dice.uniform(1, 6), dice.uniform(0.1, 0.5),
            choice == 1 ? 0 : dice.uniform(-0.4, 0.4), more);
}

void moving_obstacle(Dice& dice, Draft& draft) { moving(dice, draft, false); }
void swinging_obstacle(Dice& dice, Draft& draft) { moving(dice, draft, true); }

/// A ball that starts on a box or on top of a circle, and slides over its end or round it.
void slide_over(Dice& dice, Draft& draft) {
    draft.axes = 2;
    draft.gravity(9.81);
    draft.shortest = 0.7;
    draft.longest = 3;
    const std::string drag = some_drag(dice) + fmt::format("contact = {}\n", radius);
    draft.body(1, {0, 0.5 + radius}, {rounded(dice.sign() * dice.uniform(0.3, 4)), 0}, drag);
    if (dice.chance(0.4))
        circle(draft, 0, 0, 0.5, surface_of(dice));
    else
        box(draft, 0, 0, dice.uniform(0.3, 4), 1, 0, surface_of(dice));
    if (dice.chance(0.5)) box(draft, 0, -2.5, 30, 1, 0, surface_of(dice));
}

void tiles(Dice& dice, Draft& draft) {
    balls(dice, draft, 3);
    std::string rows;
    for (int row = 0; row < 3; ++row) {
        rows += row > 0 ? "\", \"" : "";
        for (int column = 0; column < 8; ++column) rows += dice.chance(0.3 + 0.3 * row) ? '#' : '.';
    }
    draft.text += fmt::format("[[tiles]]\norigin = [-2.0, -1.5]\ntile = 0.5\nrows = [\"{}\"]\n{}",
                              rows, surface_of(dice));
}

/// A ball on a spring that swings against a peg and a box.
void spring_ball(Dice& dice, Draft& draft) {
    draft.axes = 2;
    draft.gravity(9.81);
    draft.shortest = 0.7;
    draft.longest = 3;
    const double omega = dice.log_uniform(2, 30);
    const double length = dice.chance(0.5) ? 0 : 1;
    draft.spring(ball(dice, draft), {0, rounded(dice.uniform(0, 1.5))}, rounded(omega * omega),
                 dice.chance(0.5) ? 0 : rounded(dice.uniform(0.05, 1)), length);
    box(draft, 0, -1, 8, dice.uniform(0.5, 1.5), dice.uniform(-0.2, 0.2), surface_of(dice));
    circle(draft, dice.sign() * dice.uniform(1, 2), 0.5, dice.uniform(0.1, 0.4), surface_of(dice));
}

constexpr Kind all[]{
    {"pegs", pegs},
    {"turned boxes", turned_boxes},
    {"segments", segments},
    {"chain", chain},
    {"moving", moving_obstacle},
    {"swinging", swinging_obstacle},
    {"slide over", slide_over},
    {"tiles", tiles},
    {"spring ball", spring_ball},
};

}  // namespace

std::span<const Kind> obstacle_kinds() { return all; }

}  // namespace oiler::trap
