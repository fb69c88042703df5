// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace oiler {

/// A kick changes velocities by accelerations; a drift changes positions by velocities.
enum class Move { kick, drift };

/// One move of a splitting method, by `coefficient` · dt.
struct Stage {
    Move move = Move::kick;
    long double coefficient = 0;
};

/// A method that changes positions and velocities in turn.
class Splitting {
public:
    static constexpr std::size_t most_stages = 40;

    constexpr Splitting(std::initializer_list<Stage> stages) {
        for (const Stage& stage : stages) add(stage);
    }
    /// The stages forwards, then backwards without repeating the last.
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

/// An explicit Runge–Kutta method: the rows of `a` below the diagonal, the weights `b` and the
/// nodes `c`.
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

/// y' = y + dt·f(s), where the stage s solves s = y + dt·a·f(s).
struct ImplicitStage {
    long double a;
};

/// The exact motion; it needs forces that are linear in position and velocity.
struct ExactFlow {};

/// Where a splitting applies forces that depend on velocity.
enum class Damping {
    in_kick,   ///< explicitly in the kicks, as in the article; reduces the order to 1
    in_drift,  ///< linear damping exactly in the drifts, other kinds in half-steps around the step
};

/// "kick" or "drift", as in the options.
[[nodiscard]] std::string_view name_of(Damping damping);
/// The damping of such a name; empty if there is none.
[[nodiscard]] std::optional<Damping> find_damping(std::string_view name);

/// The order of a method whose only error is round-off.
inline constexpr int exact_order = std::numeric_limits<int>::max();

/// An integration method with everything that the rest of Oiler uses. To add a method, add it to
/// the list in methods.cpp. The kernels, the options, the certificates and the tests iterate that
/// list.
struct Method {
    std::string_view name;
    int order = 1;        ///< for smooth forces that depend on position alone
    int evaluations = 1;  ///< of the forces per step; the last kick shares its evaluation with the
                          ///< first kick of the next step; 0: as many as solving an equation takes
    bool symplectic = false;  ///< for forces that have a potential
    bool symmetric = false;   ///< a step back returns to the start
    std::variant<Splitting, Tableau, ImplicitStage, ExactFlow> rule = ExactFlow{};
    std::string_view source;
    Damping damping = Damping::in_drift;  ///< the default; for splittings only
};

/// All methods.
[[nodiscard]] std::span<const Method> methods();

/// Throws Error{usage} that names similar methods.
[[nodiscard]] const Method& find_method(std::string_view name);

/// The evaluations of the forces per step of a long run. With damping in the kicks, a method that
/// starts and ends with a kick needs one more, because the two kicks cannot share an evaluation.
[[nodiscard]] int evaluations_with(const Method& method, Damping damping);

/// The order with linear damping. Only a splitting with damping in the kicks loses order.
[[nodiscard]] int damped_order(const Method& method, Damping damping);
/// The order with quadratic drag, or with damping along a spring or between bodies. It is at most 2
/// for a splitting, because half-steps of damping around its step have order 2.
[[nodiscard]] int dragged_order(const Method& method, Damping damping);

}  // namespace oiler
