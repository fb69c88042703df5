// SPDX-License-Identifier: MIT
#include "trap/traps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "trap/draws.hpp"

namespace oiler::trap {

std::string Draft::vector(const std::vector<double>& numbers) const {
    std::string list;
    for (int axis = 0; axis < axes; ++axis)
        list += fmt::format("{}{}", axis > 0 ? ", " : "",
                            static_cast<std::size_t>(axis) < numbers.size()
                                ? numbers[static_cast<std::size_t>(axis)]
                                : 0.0);
    return "[" + list + "]";
}

std::string Draft::body(double mass, const std::vector<double>& position,
                        const std::vector<double>& velocity, const std::string& more) {
    const std::string name = fmt::format("b{}", bodies++);
    text += fmt::format("[[body]]\nname = \"{}\"\nmass = {}\nposition = {}\nvelocity = {}\n{}",
                        name, mass, vector(position), vector(velocity), more);
    return name;
}

void Draft::spring(const std::string& body, const std::vector<double>& anchor, double stiffness,
                   double damping, double rest_length) {
    text += fmt::format(
        "[[spring]]\nbody = \"{}\"\nanchor = {}\nstiffness = {}\ndamping = {}\nrest_length = {}\n",
        body, vector(anchor), stiffness, damping, rest_length);
}

void Draft::link(const std::string& body, const std::string& to, double stiffness, double damping,
                 double rest_length) {
    text += fmt::format(
        "[[spring]]\nbody = \"{}\"\nto = \"{}\"\nstiffness = {}\ndamping = {}\nrest_length = {}\n",
        body, to, stiffness, damping, rest_length);
}

void Draft::gravity(double g) {
    std::vector<double> acceleration(static_cast<std::size_t>(axes), 0.0);
    acceleration[axes == 1 ? 0 : 1] = -g;
    text += fmt::format("[gravity]\nacceleration = {}\n", vector(acceleration));
}

void Draft::attractor(const std::vector<double>& position, double gm) {
    text += fmt::format("[[attractor]]\nposition = {}\ngm = {}\n", vector(position), gm);
}

void Draft::limit(double hertz, double periods) { longest = std::min(longest, periods / hertz); }

namespace {

std::string drags(double linear, double quadratic) {
    return fmt::format("linear_drag = {}\nquadratic_drag = {}\n", rounded(linear),
                       rounded(quadratic));
}

/// A body on an ellipse, at the perihelion or at the aphelion.
void add_orbit(Dice& dice, Draft& draft, double gm, double distance) {
    const double e = dice.chance(0.15) ? 0 : rounded(dice.uniform(0, 0.99));
    const bool near = dice.chance(0.5);
    const double speed = std::sqrt(gm / distance * (near ? 1 + e : 1 - e));
    const double angle = dice.uniform(0, turn);
    draft.body(1, {distance * std::cos(angle), distance * std::sin(angle)},
               {-speed * std::sin(angle), speed * std::cos(angle)});
    const double perihelion = near ? distance : distance * (1 - e) / (1 + e);
    draft.limit(std::sqrt(gm / (perihelion * perihelion * perihelion)) / turn, 2e4);
}

void orbit(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(2, 3);
    const double gm = rounded(dice.log_uniform(0.01, 1e4));
    draft.attractor(dice.chance(0.5) ? std::vector<double>{0} : std::vector<double>{0, 0}, gm);
    for (int i = dice.whole(1, 3); i > 0; --i)
        add_orbit(dice, draft, gm, rounded(dice.log_uniform(0.5, 50)));
}

void attractors(Dice& dice, Draft& draft) {
    draft.axes = 2;
    const double gm = rounded(dice.log_uniform(0.1, 100));
    draft.attractor({0, 0}, gm);
    for (int i = dice.whole(1, 2); i > 0; --i)
        draft.attractor({rounded(dice.sign() * dice.uniform(4, 8)), rounded(dice.uniform(-8, 8))},
                        rounded(gm * dice.uniform(0.1, 1)));
    const double distance = rounded(dice.uniform(0.7, 2));
    draft.body(1, {distance, 0}, {0, rounded(std::sqrt(gm / distance) * dice.uniform(0.7, 1.2))});
    draft.limit(std::sqrt(gm) / turn, 30);
}

void projectiles(Dice& dice, Draft& draft, bool linear, bool quadratic) {
    draft.axes = dice.whole(1, 3);
    if (dice.chance(0.8)) draft.gravity(9.81);
    const double strength = dice.log_uniform(1e-4, 10);
    for (int i = dice.whole(1, 4); i > 0; --i)
        draft.body(mass_of(dice), random_point(dice, 10),
                   random_point(dice, dice.log_uniform(1, 300)),
                   drags(linear ? strength : 0, quadratic ? strength / 10 : 0));
    draft.longest = 60;
}

void linear_drag(Dice& dice, Draft& draft) { projectiles(dice, draft, true, false); }
void quadratic_drag(Dice& dice, Draft& draft) { projectiles(dice, draft, false, true); }
void both_drags(Dice& dice, Draft& draft) { projectiles(dice, draft, true, true); }
void free_flight(Dice& dice, Draft& draft) { projectiles(dice, draft, false, false); }

/// Different forces in one scene, without links.
void mixture(Dice& dice, Draft& draft) {
    draft.axes = 2;
    draft.gravity(9.81);
    add_oscillator(dice, draft, dice.log_uniform(0.1, 1e3), dice.log_uniform(0.1, 10), true);
    draft.body(mass_of(dice), {0}, random_point(dice, 50), drags(0, dice.log_uniform(1e-4, 0.1)));
    draft.body(mass_of(dice), {0}, random_point(dice, 50), drags(dice.log_uniform(1e-3, 1), 0));
    draft.body(1, {100, 100}, random_point(dice, 50));
    draft.longest = std::min(draft.longest, 30.0);
}

/// Up to 10,000 bodies from one table.
void many(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(2, 3);
    draft.gravity(9.81);
    const bool quadratic = dice.chance(0.3);
    const int count = static_cast<int>(dice.log_uniform(100, quadratic ? 300 : 10'000));
    const double drag = dice.log_uniform(1e-3, 1);
    const double speed = rounded(dice.log_uniform(1, 100));
    draft.text += fmt::format(
        "[[scatter]]\ncount = {}\nseed = {}\nposition_from = {}\nposition_to = {}\n"
        "velocity_from = {}\nvelocity_to = {}\n{}",
        count, dice.whole(0, 1000), draft.vector({-10, 0, -10}), draft.vector({10, 5, 10}),
        draft.vector({-speed, 0, -speed}), draft.vector({speed, speed, speed}),
        drags(quadratic ? 0 : drag, quadratic ? drag / 10 : 0));
    draft.longest = 3;
}

/// Nothing moves: springs at their anchors, a body in balance, a body without forces.
void at_rest(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 3);
    const bool falls = dice.chance(0.3);
    if (falls) draft.gravity(8);
    const std::string body = draft.body(1, {0, 0}, {0});
    // Stretched by 0.5 m, 16 N/m carry 8 N.
    std::vector<double> anchor{0, 0};
    if (falls) anchor[draft.axes == 1 ? 0 : 1] = 0.5;
    draft.spring(body, anchor, 16, dice.chance(0.5) ? 0 : 0.5);
    if (!falls) draft.body(1, random_point(dice, 10), {0});
}

constexpr Kind all[]{
    {"spring", single_spring},
    {"slow and fast", slow_and_fast},
    {"aliased", aliased},
    {"orbit", orbit},
    {"springs", several_springs},
    {"pair", linked_pair},
    {"chain", linear_chain},
    {"linear drag", linear_drag},
    {"quadratic drag", quadratic_drag},
    {"pendulum", pendulum},
    {"attractors", attractors},
    {"coiled chain", coiled_chain},
    {"mixture", mixture},
    {"many", many},
    {"both drags", both_drags},
    {"free flight", free_flight},
    {"at rest", at_rest},
    {"many springs", many_springs},
};

}  // namespace

std::span<const Kind> kinds() { return all; }

}  // namespace oiler::trap
