// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/physics/stepping.hpp"

namespace oiler::certify {

/// The measured order of a method: the slope of log error over log dt through five step sizes, each
/// half of the one before. NaN if fewer than five lie between the asymptotic range and round-off.
struct MeasuredOrder {
    std::string_view problem;
    Precision precision;
    int claimed;
    double position = std::numeric_limits<double>::quiet_NaN();
    double velocity = std::numeric_limits<double>::quiet_NaN();
    bool exact = false;  ///< only round-off at every step size

    /// The smaller slope, because one of them may exceed the claimed order.
    [[nodiscard]] double slope() const { return std::min(position, velocity); }
    [[nodiscard]] bool measured() const { return !std::isnan(position) && !std::isnan(velocity); }
};

/// The energy of the undamped spring over many steps in double.
struct LongRun {
    std::int64_t steps;  ///< fewer than requested if the energy overflows or vanishes
    double omega_dt;
    double lowest;   ///< the lowest energy at a step, relative to the start
    double highest;  ///< the highest, likewise
    /// Relative growth per step: of the quadratic form that the step conserves, which unlike the
    /// energy does not oscillate; of the energy if the step conserves none.
    double trend = 0;
    double predicted = 0;  ///< trend from the step matrix, 0 for a method that conserves a form
    double allowed = 0;    ///< difference of both that round-off explains
};

/// The measured properties of a method.
struct Certificate {
    const Method* method;
    Damping damping;
    std::vector<MeasuredOrder> orders;
    double symplectic_defect;   ///< largest entry of MᵀJM − J for a step of an orbit
    double reversal_defect;     ///< after 16 steps forth and 16 with reversed velocities; relative
    double evaluations;         ///< force evaluations per step, many steps per call
    double single_evaluations;  ///< force evaluations per step, one step per call
    double limit;               ///< of ω·dt, undamped spring; 0: never stable, infinite: always
    bool limit_confirmed;       ///< by simulation on both sides of the limit
    LongRun energy;
    std::vector<std::string> failures;  ///< deviations from the method table
};

/// Measures a method in double and long double, with a long run of `steps`. 10⁷ take some seconds.
[[nodiscard]] Certificate certify(const Method& method, Damping damping, std::int64_t steps);

// The measurements of a certificate.

/// Measures the order on each problem that the method can step, in double and in long double.
[[nodiscard]] std::vector<MeasuredOrder> measure_orders(const Method& method, Damping damping);

/// The slope of values over their index, by least squares.
[[nodiscard]] double slope_over_index(std::span<const double> values);

/// The largest entry of MᵀJM − J, where M is the derivative of a step of an orbit and J that of
/// x ∧ v; 0 for a step that conserves it.
[[nodiscard]] double symplectic_defect(const Method& method);

/// The distance from the start after 16 steps of an orbit and 16 with reversed velocity.
[[nodiscard]] double reversal_defect(const Method& method);

/// Force evaluations per step over 1000 steps, in one call or in one call per step.
[[nodiscard]] double evaluations_per_step(const Method& method, Damping damping, bool one_call);

/// Whether runs in double are bounded just below `limit`, of ω·dt, and grow just above it.
[[nodiscard]] bool confirm_limit(const Method& method, Damping damping, double limit);

/// Runs an undamped spring with ω·dt = 0.45 or limit/4, whichever is smaller; 0.01 if limit is 0.
[[nodiscard]] LongRun run_long(const Method& method, Damping damping, double limit,
                               std::int64_t steps);

}  // namespace oiler::certify
