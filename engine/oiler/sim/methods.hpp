// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace oiler {

/// A kick changes velocities by the acceleration, a drift changes positions by the velocity.
enum class Move { kick, drift };

/// One move of a splitting method, by `coefficient` · dt.
struct Stage {
    Move move;
    long double coefficient;
};

/// A method that moves positions and velocities in turn.
struct Splitting {
    static constexpr std::size_t most_stages = 64;
    std::span<const Stage> stages;
};

/// An explicit Runge–Kutta method. With s stages: `b` and `c` have s numbers, `a` the s(s−1)/2
/// below the diagonal, row by row.
struct Tableau {
    static constexpr std::size_t most_stages = 4;
    std::span<const long double> a;
    std::span<const long double> b;
    std::span<const long double> c;
};

/// A way to step, and all that the rest of Oiler knows of it. To add one, add it to the list in
/// methods.cpp: the kernels, the options and the tests iterate that list.
struct Method {
    std::string_view name;
    int order;        ///< on forces that depend on position alone
    int evaluations;  ///< of the forces, in a step
    bool symplectic;  ///< on forces that have a potential
    std::variant<Splitting, Tableau> rule;
    std::string_view source;
};

/// The one list.
[[nodiscard]] std::span<const Method> methods();

/// Throws Error{usage} that names the choices.
[[nodiscard]] const Method& find_method(std::string_view name);

/// "explicit_euler, semi_implicit_euler"
[[nodiscard]] std::string method_names();

}  // namespace oiler
