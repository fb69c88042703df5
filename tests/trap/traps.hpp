// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/physics/stepping.hpp"
#include "oiler/scene/scene.hpp"
#include "support/dice.hpp"
#include "trap/measure.hpp"
#include "trap/truth.hpp"

namespace oiler::trap {

using test::Dice;

/// A scene file in the making.
struct Draft {
    int axes = 1;
    double shortest = 1e-3;  ///< s, the least duration at first
    /// The largest useful duration, s: the run then has enough periods.
    double longest = 100;
    std::string text{};  ///< the tables after [scene]
    int bodies = 0;

    /// "[1.5, 0]" from as many numbers as axes.
    [[nodiscard]] std::string vector(const std::vector<double>& numbers) const;
    /// Adds a body b0, b1, … and returns its name.
    std::string body(double mass, const std::vector<double>& position,
                     const std::vector<double>& velocity, const std::string& more = "");
    void spring(const std::string& body, const std::vector<double>& anchor, double stiffness,
                double damping, double rest_length = 0);
    void link(const std::string& body, const std::string& to, double stiffness, double damping,
              double rest_length = 0);
    void gravity(double g);
    void attractor(const std::vector<double>& position, double gm);
    void wind(const std::string& body, const std::vector<double>& velocity, double drag);
    void drive(const std::string& body, const std::vector<double>& amplitude, double hertz,
               double phase);
    void plane(const std::vector<double>& normal, double offset, double restitution,
               double friction);
    /// Limits the duration to so many periods of the frequency.
    void limit(double hertz, double periods = 2e4);
};

/// A kind of scene that advice may get wrong.
struct Kind {
    const char* name;
    void (*make)(Dice&, Draft&);
};

/// The kind of a seed. One in four has wind, a drive or a floor.
[[nodiscard]] const Kind& kind_of(std::uint64_t seed);
/// Scenes with obstacles.
[[nodiscard]] std::span<const Kind> obstacle_kinds();

/// One question to `oiler advise`.
struct Question {
    double tolerance = 0;  ///< m
    Meaning meaning = Meaning::drawn;
    std::vector<std::string> methods{};  ///< all if empty
    bool gives_min_rate = false;         ///< --min-rate 1, which is the default

    [[nodiscard]] std::string options() const;
};

/// What the program tells of an advice. Errors that are null are below the floor.
struct Told {
    Stepping stepping{};
    Real drawn = 0;                  ///< m
    std::optional<Real> at_steps{};  ///< m; some versions do not tell it
};

struct Answer {
    int exit = -1;
    double seconds = 0;
    std::string message{};       ///< the last line on standard error
    std::optional<Told> told{};  ///< with exit 0
    bool ended_early = false;    ///< with exit 1: before all settings were tried
};

struct Program {
    std::string path = "oiler";
    int patience = 300;  ///< s
    bool plain = false;  ///< without new options, and numbers may be missing
};

/// Asks about a scene. An answer that cannot be read has the exit code −1.
[[nodiscard]] Answer ask(const Program& program, const std::string& scene,
                         const Question& question);

/// A random scene with its true motion, and a question about it.
struct Trap {
    std::string kind{};
    std::string text{};  ///< the scene file
    Scene scene{};
    std::unique_ptr<Truth> truth{};
    double extent = 0;  ///< m, the largest distance of a body from its start
    Question question{};
};

/// The same trap for the same seed and kind. `plain` asks without --at-steps and --display.
[[nodiscard]] Trap make_trap(std::uint64_t seed, const Kind& kind, bool plain);

enum class Verdict {
    honest,        ///< the advice holds
    cannot,        ///< no setting meets the tolerance, and none was found
    refused,       ///< exit 2
    lie,           ///< a told error is less than 0.95 of the truth
    over,          ///< the advice does not meet the tolerance
    false_cannot,  ///< a setting meets the tolerance
    crash,         ///< any other exit, or an answer that cannot be read
};
inline constexpr std::size_t verdict_count = 7;

[[nodiscard]] std::string_view name_of(Verdict verdict);
[[nodiscard]] bool is_failure(Verdict verdict);

struct Judgement {
    Verdict verdict = Verdict::honest;
    std::string words{};
};

/// Steps what was advised and compares it with the truth.
[[nodiscard]] Judgement judge(const Trap& trap, const Answer& answer);

}  // namespace oiler::trap
