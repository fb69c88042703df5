// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <numbers>

#include "trap/traps.hpp"

namespace oiler::trap {

inline constexpr double turn = 2 * std::numbers::pi;

/// Four significant digits keep a file readable.
inline double rounded(double number) { return std::stod(fmt::format("{:.4g}", number)); }

inline double mass_of(Dice& dice) { return rounded(dice.log_uniform(0.1, 10)); }

/// No, weak, exactly critical or strong damping of a spring, N·s/m.
inline double damping_of(Dice& dice, double mass, double stiffness) {
    const double critical = 2 * std::sqrt(mass * stiffness);
    const int choice = dice.whole(0, 4);
    if (choice == 0) return 0;
    if (choice == 1) return critical;
    if (choice == 2) return rounded(critical * dice.log_uniform(1, 50));
    return rounded(critical * dice.log_uniform(1e-5, 1));
}

inline std::vector<double> random_point(Dice& dice, double size) {
    std::vector<double> point(3);
    for (double& number : point) number = rounded(dice.uniform(-size, size));
    return point;
}

/// A body on a spring that oscillates by about `size` at `omega`, rad/s.
void add_oscillator(Dice& dice, Draft& draft, double omega, double size, bool damped);

// Kinds of scenes in springs.cpp.
void single_spring(Dice& dice, Draft& draft);
void several_springs(Dice& dice, Draft& draft);
void many_springs(Dice& dice, Draft& draft);
/// A slow large oscillation beside small fast ones.
void slow_and_fast(Dice& dice, Draft& draft);
/// A spring whose frequency is a multiple of a usual rate: samples at that rate see it at rest.
void aliased(Dice& dice, Draft& draft);
void linked_pair(Dice& dice, Draft& draft);
void linear_chain(Dice& dice, Draft& draft);
void coiled_chain(Dice& dice, Draft& draft);
/// An elastic pendulum; its spring never vanishes.
void pendulum(Dice& dice, Draft& draft);

}  // namespace oiler::trap
