// SPDX-License-Identifier: MIT
#include "trap/draws.hpp"

#include <algorithm>
#include <cmath>

namespace oiler::trap {
namespace {

/// A chain between two anchors. Rest lengths make it nonlinear.
void add_chain(Dice& dice, Draft& draft, int count, double rest, double periods) {
    const double omega = dice.log_uniform(0.5, 300);
    const double damping = dice.chance(0.5) ? 0 : rounded(omega * dice.log_uniform(1e-4, 1));
    const double stiffness = rounded(omega * omega);
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i)
        names.push_back(draft.body(
            dice.chance(0.5) ? 1 : mass_of(dice),
            {i + 1 + rounded(dice.uniform(-0.2, 0.2)), rounded(dice.uniform(-0.1, 0.1))}, {0}));
    draft.spring(names.front(), {0}, stiffness, damping, rest);
    for (int i = 1; i < count; ++i)
        draft.link(names[static_cast<std::size_t>(i)], names[static_cast<std::size_t>(i - 1)],
                   stiffness, damping, rest);
    if (dice.chance(0.5))
        draft.spring(names.back(), {static_cast<double>(count + 1)}, stiffness, damping, rest);
    draft.limit(omega * 6 / turn, periods);
}

}  // namespace

void add_oscillator(Dice& dice, Draft& draft, double omega, double size, bool damped) {
    // Squares of powers of two: damping can be exactly critical.
    const bool exact = dice.chance(0.3);
    const double mass = exact ? 1 : mass_of(dice);
    if (exact) omega = std::exp2(std::round(std::log2(omega)));
    const double stiffness = exact ? omega * omega : rounded(mass * omega * omega);
    const std::vector<double> anchor = random_point(dice, dice.chance(0.5) ? 0 : 10 * size);
    std::vector<double> position = anchor;
    for (double& number : position) number += rounded(dice.uniform(-size, size));
    const double speed = dice.chance(0.5) ? 0 : omega * size;
    const std::string body = draft.body(mass, position, random_point(dice, speed));
    draft.spring(body, anchor, stiffness, damped ? damping_of(dice, mass, stiffness) : 0);
    draft.limit(omega / turn);
}

void single_spring(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 3);
    if (dice.chance(0.5)) draft.gravity(9.81);
    add_oscillator(dice, draft, dice.log_uniform(0.01, 1e4), dice.log_uniform(0.01, 1000), true);
}

void several_springs(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 2);
    if (dice.chance(0.5)) draft.gravity(9.81);
    for (int i = dice.whole(2, 12); i > 0; --i)
        add_oscillator(dice, draft, dice.log_uniform(0.01, 1e3), dice.log_uniform(0.1, 100), true);
}

void many_springs(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 2);
    const double omega = dice.log_uniform(0.1, 1e3);
    for (int i = dice.whole(30, 200); i > 0; --i)
        add_oscillator(dice, draft, omega * dice.uniform(0.5, 1), dice.uniform(0.5, 2), false);
    draft.limit(omega / turn, 100);
}

void slow_and_fast(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 2);
    if (dice.chance(0.3)) draft.gravity(9.81);
    add_oscillator(dice, draft, dice.log_uniform(0.05, 2), dice.log_uniform(10, 1000), false);
    for (int i = dice.whole(1, 3); i > 0; --i)
        add_oscillator(dice, draft, turn * dice.log_uniform(10, 1000), dice.log_uniform(0.1, 5),
                       dice.chance(0.5));
}

void aliased(Dice& dice, Draft& draft) {
    constexpr double rates[]{1, 10, 30, 60};
    const double hertz = rates[dice.whole(0, 3)] * dice.whole(1, 16);
    const double stiffness = turn * hertz * turn * hertz;
    const double size = rounded(dice.log_uniform(0.1, 10));
    if (dice.chance(0.3)) draft.gravity(9.81);
    const bool released = dice.chance(0.5);
    const std::string body =
        draft.body(1, {released ? size : 0}, {released ? 0 : turn * hertz * size});
    draft.spring(body, {0}, stiffness, dice.chance(0.7) ? 0 : rounded(dice.log_uniform(1e-4, 1)));
    if (dice.chance(0.5))
        add_oscillator(dice, draft, dice.log_uniform(0.05, 2), dice.log_uniform(10, 300), false);
    draft.limit(hertz);
}

void linked_pair(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 3);
    const double omega = dice.log_uniform(0.1, 1e3);
    const double mass = mass_of(dice);
    const double stiffness = rounded(mass * omega * omega);
    const std::string a = draft.body(mass, random_point(dice, 5), random_point(dice, 5));
    const std::string b = draft.body(mass_of(dice), random_point(dice, 5), {0});
    draft.link(a, b, stiffness, damping_of(dice, mass, stiffness));
    if (dice.chance(0.7)) draft.spring(a, random_point(dice, 5), rounded(stiffness / 3), 0);
    if (dice.chance(0.5)) draft.spring(b, {0}, rounded(stiffness * dice.log_uniform(0.1, 10)), 0);
    if (dice.chance(0.3)) draft.gravity(9.81);
    draft.limit(omega * 3 / turn, 5000);
}

void linear_chain(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 2);
    if (dice.chance(0.3)) draft.gravity(9.81);
    add_chain(dice, draft, dice.whole(3, 20), 0, 1000);
}

void coiled_chain(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(1, 2);
    if (dice.chance(0.3)) draft.gravity(1);
    add_chain(dice, draft, dice.whole(2, 8), rounded(dice.uniform(0.3, 0.9)), 100);
}

void pendulum(Dice& dice, Draft& draft) {
    draft.axes = dice.whole(2, 3);
    const double omega = dice.log_uniform(3, 300);
    const double mass = mass_of(dice);
    const double length = rounded(dice.uniform(0.5, 3));
    draft.gravity(9.81);
    const double angle = dice.uniform(0.1, 1.2);
    const std::string body = draft.body(
        mass, {rounded(length * std::sin(angle)), rounded(-length * std::cos(angle) - 0.1)}, {0});
    draft.spring(body, {0}, rounded(mass * omega * omega),
                 dice.chance(0.5) ? 0 : rounded(mass * omega * dice.log_uniform(1e-3, 1)), length);
    draft.limit(omega / turn, 300);
}

}  // namespace oiler::trap
