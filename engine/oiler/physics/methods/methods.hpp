// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace oiler {

/// A kick changes velocities by the acceleration, a drift changes positions by the velocity.
enum class Move { kick, drift };

/// One move of a splitting method, by `coefficient` · dt.
struct Stage {
    Move move = Move::kick;
    long double coefficient = 0;
};

/// A method that moves positions and velocities in turn.
class Splitting {
public:
    static constexpr std::size_t most_stages = 40;

    constexpr Splitting(std::initializer_list<Stage> stages) {
        for (const Stage& stage : stages) add(stage);
    }
    /// The same stages there and back, the last one once.
    [[nodiscard]] static constexpr Splitting palindrome(std::initializer_list<Stage> half) {
        Splitting whole(half);
        for (std::size_t i = half.size() - 1; i-- > 0;) whole.add(whole.stages_[i]);
        return whole;
    }
    [[nodiscard]] constexpr std::span<const Stage> stages() const {
        return {stages_.data(), count_};
    }

private:
    constexpr void add(const Stage& stage) { stages_.at(count_++) = stage; }

    std::array<Stage, most_stages> stages_{};
    std::size_t count_ = 0;
};

/// An explicit Runge–Kutta method: for each stage its row of `a`, below the diagonal, then `b` and
/// `c`.
class Tableau {
public:
    static constexpr std::size_t most_stages = 4;
    using Row = std::array<long double, most_stages>;

    constexpr Tableau(std::initializer_list<Row> rows, const Row& weights, const Row& nodes)
        : b(weights), c(nodes), count(rows.size() + 1) {
        std::size_t i = 0;
        for (const Row& row : rows) a.at(++i) = row;
    }

    std::array<Row, most_stages> a{};
    Row b;
    Row c;
    std::size_t count;
};

/// y' = y + dt·f(s) from a stage s = y + dt·a·f(s) that solves its own equation.
struct ImplicitStage {
    long double a;
};

/// The exact motion, where all forces are linear in position and velocity.
struct ExactFlow {};

/// Where a splitting puts the forces that depend on velocity.
enum class Damping {
    in_kick,  ///< into the kicks, explicitly, as the article does; costs all orders above the first
    in_drift,  ///< linear damping exactly into the drifts, any other in half-steps around the step
};

/// "kick" or "drift", as the options say it.
[[nodiscard]] std::string_view name_of(Damping damping);

/// The order of a method whose only error is round-off.
inline constexpr int exact_order = std::numeric_limits<int>::max();

/// A way to step, and all that the rest of Oiler knows of it. To add one, add it to the list in
/// methods.cpp: the kernels, the options, the certificates and the tests iterate that list.
struct Method {
    std::string_view name;
    int order = 1;        ///< where forces are smooth and depend on position alone
    int evaluations = 1;  ///< of the forces in a step, where the last kick's serves the next step's
                          ///< first; 0: as many as an equation takes to solve
    bool symplectic = false;  ///< on forces that have a potential
    bool symmetric = false;   ///< stepping back retraces the way
    std::variant<Splitting, Tableau, ImplicitStage, ExactFlow> rule = ExactFlow{};
    std::string_view source;
    Damping damping = Damping::in_drift;  ///< unless the user chooses; of splittings only
};

/// The one list.
[[nodiscard]] std::span<const Method> methods();

/// Throws Error{usage} that names the choices.
[[nodiscard]] const Method& find_method(std::string_view name);

/// "explicit_euler, semi_implicit_euler"
[[nodiscard]] std::string method_names();

/// How often a step evaluates the forces in a run of many: once more than the method says where
/// velocities have a say in its last kick, so that the next step's first needs another.
[[nodiscard]] int evaluations_with(const Method& method, Damping damping);

/// The order that is left with linear damping: what a splitting loses with it in the kicks, and no
/// other method does.
[[nodiscard]] int damped_order(const Method& method, Damping damping);
/// The order that is left with quadratic drag, or with damping along a spring or between bodies.
/// Half-steps of its flow around a splitting's step leave two.
[[nodiscard]] int dragged_order(const Method& method, Damping damping);

}  // namespace oiler
