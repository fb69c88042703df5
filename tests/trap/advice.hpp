// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "oiler/physics/stepping.hpp"
#include "trap/measure.hpp"

namespace oiler::trap {

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
};

struct Program {
    std::string path = "oiler";
    int patience = 300;  ///< s
    bool plain = false;  ///< without new options, and numbers may be missing
};

/// Asks about a scene. An answer that cannot be read has the exit code −1.
[[nodiscard]] Answer ask(const Program& program, const std::string& scene,
                         const Question& question);

}  // namespace oiler::trap
