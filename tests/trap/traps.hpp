// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "support/dice.hpp"

namespace oiler::trap {

using test::Dice;

/// A scene file in the making.
struct Draft {
    int axes = 1;
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
    /// Limits the duration to so many periods of the frequency.
    void limit(double hertz, double periods = 2e4);
};

/// A kind of scene that advice may get wrong.
struct Kind {
    const char* name;
    void (*make)(Dice&, Draft&);
};

[[nodiscard]] std::span<const Kind> kinds();

}  // namespace oiler::trap
