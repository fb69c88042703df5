// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/sim/bodies.hpp"

namespace oiler::certify {

/// How errors fall with dt: the slopes of log error over log dt through five step sizes, each half
/// of the one before. NaN where no five lie between those at which errors begin to fall as a power
/// of dt and those at which round-off is left.
struct MeasuredOrder {
    std::string_view problem;
    Precision precision;
    int claimed;
    double position = std::numeric_limits<double>::quiet_NaN();
    double velocity = std::numeric_limits<double>::quiet_NaN();
    bool exact = false;  ///< at no step size was anything left but round-off

    /// That of the worse of both, since one may do better than the method claims.
    [[nodiscard]] double slope() const { return std::min(position, velocity); }
    [[nodiscard]] bool measured() const { return !std::isnan(position) && !std::isnan(velocity); }
};

/// What energy does on the undamped spring over many steps in double.
struct LongRun {
    std::int64_t steps;  ///< fewer than asked for where the energy became too large or too small
    double omega_dt;
    double lowest;  ///< energy over that at the start, at any step
    double highest;
    /// Growth per step, relative: of the quadratic form that the step conserves, which unlike the
    /// energy does not sway; where it conserves none, of the energy.
    double trend = 0;
    double predicted = 0;  ///< trend from the step matrix, 0 for a method that conserves a form
    double allowed = 0;    ///< of the difference, what round-off may make
};

/// What a method was measured to be.
struct Certificate {
    const Method* method;
    Damping damping;
    std::vector<MeasuredOrder> orders;
    double symplectic_defect;   ///< largest entry of MᵀJM − J for a step of an orbit
    double reversal_defect;     ///< after steps there and, velocities turned, back; relative
    double evaluations;         ///< per step, in a run of many
    double single_evaluations;  ///< per step, where nothing is left of the one before
    double limit;  ///< of ω·dt on the undamped spring; 0: none is stable, infinite: all are
    bool limit_confirmed;  ///< by simulating on both sides of it
    LongRun energy;
    std::vector<std::string> failures;  ///< what is not as the table claims
};

/// Measures a method in double and long double, with a long run of `steps`. Some seconds for 10⁷.
[[nodiscard]] Certificate certify(const Method& method, Damping damping, std::int64_t steps);

}  // namespace oiler::certify
