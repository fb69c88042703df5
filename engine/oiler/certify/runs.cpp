// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include "oiler/certify/measures.hpp"
#include "oiler/stability/stability.hpp"

namespace oiler::certify {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

constexpr Rate each_second{1};

/// An undamped spring with the given ω·dt, for steps of 1 s, in double.
Bodies undamped_spring(double omega_dt) {
    Bodies bodies(1, Precision::double_);
    bodies.add({.position = {1}}, Spring{.stiffness = omega_dt * omega_dt});
    return bodies;
}

StepMatrix matrix_at(const Method& method, Damping damping, double omega_dt) {
    const Oscillation oscillation{omega_dt * omega_dt, 0};
    return step_matrices(method, damping, std::span(&oscillation, 1)).front();
}

/// The growth factor of an oscillation: measured in double, and predicted by the step matrix.
struct Growth {
    double measured;
    double predicted;
};

/// Runs as many steps as should give a growth of 10⁶, at most 10⁷; 10⁶ steps if no growth is
/// predicted.
Growth grow(const Method& method, Damping damping, double omega_dt) {
    const long double rate = std::log(spectral_radius(matrix_at(method, damping, omega_dt)));
    const double steps =
        rate > 1e-12L ? std::clamp(static_cast<double>(std::log(1e6L) / rate), 1.0, 1e7) : 1e6;
    Bodies bodies = undamped_spring(omega_dt);
    const double predicted = std::exp(static_cast<double>(rate) * std::floor(steps));
    if (bodies.try_step(
            method,
            {.rate = each_second, .count = static_cast<std::int64_t>(steps), .damping = damping}))
        return {std::numeric_limits<double>::infinity(), predicted};
    const auto end = bodies.state(0);
    return {static_cast<double>(std::hypot(end.x[0], end.v[0] / omega_dt)), predicted};
}

/// A quadratic form of the state: the energy, or z ∧ Mz, which a step matrix M of determinant 1
/// conserves.
struct Form {
    long double xx, xv, vv;

    [[nodiscard]] double of(const State<long double, 3>& state) const {
        const long double x = state.x[0];
        const long double v = state.v[0];
        return static_cast<double>(xx * x * x + xv * x * v + vv * v * v);
    }
};

/// The slope of log(value) over the index, by least squares.
double relative_trend(const std::vector<double>& values) {
    const double middle = static_cast<double>(values.size() - 1) / 2;
    double products = 0;
    double squares = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double at = static_cast<double>(i) - middle;
        products += at * std::log(values[i]);
        squares += at * at;
    }
    return products / squares;
}

/// The largest number of roundings per step, each of a number no larger than the amplitude.
double roundings(const Method& method) {
    if (const auto* splitting = std::get_if<Splitting>(&method.rule))
        return 3 * static_cast<double>(splitting->stages().size());
    return 24;
}

/// The energy of the oscillation, J.
Form energy_form(double omega_dt) {
    return {static_cast<long double>(omega_dt) * omega_dt / 2, 0, 0.5L};
}

/// The trend per step that round-off explains. Random roundings grow with the square root of the
/// steps. Correlated ones, for example of drifts that cancel, left up to 1/1000 per step in
/// measurements. The matrix of the exact method is rounded once, so its determinant differs from 1
/// by one rounding.
double allowed_trend(const Method& method, double steps) {
    const double rounding = roundings(method) * epsilon;
    const double bias = method.order == exact_order ? epsilon : rounding / 1000;
    return rounding / std::sqrt(steps) + bias;
}

}  // namespace

double evaluations_per_step(const Method& method, Damping damping, bool one_call) {
    constexpr std::int64_t steps = 1000;
    Bodies bodies = undamped_spring(0.1);
    if (one_call)
        bodies.step(method, {.rate = each_second, .count = steps, .damping = damping});
    else
        for (std::int64_t i = 0; i < steps; ++i)
            bodies.step(method, {.rate = each_second, .first = i, .damping = damping});
    return static_cast<double>(bodies.evaluations()) / static_cast<double>(steps);
}

// At (1 − 10⁻⁶) × the limit, a bounded oscillation may reach about √10⁶ times its start. At
// (1 + 10⁻⁶) × the limit, it grows as the step matrix predicts, up to such a factor. Without a
// limit, the test runs at small and at large steps.
bool confirm_limit(const Method& method, Damping damping, double limit) {
    const auto holds = [&](double omega_dt) {
        return grow(method, damping, omega_dt).measured < 1e4;
    };
    const auto grows = [&](double omega_dt) {
        const Growth growth = grow(method, damping, omega_dt);
        return growth.predicted > 100 && growth.measured > std::sqrt(growth.predicted);
    };
    if (limit == 0) return grows(0.25);
    if (std::isinf(limit)) return holds(0.25) && holds(30) && holds(1000);
    return holds(limit * (1 - 1e-6)) && grows(limit * (1 + 1e-6));
}

LongRun run_long(const Method& method, Damping damping, double limit, std::int64_t steps) {
    constexpr std::int64_t samples = 10'000;
    const double omega_dt = limit > 0 ? std::min(0.45, limit / 4) : 0.01;
    const StepMatrix m = matrix_at(method, damping, omega_dt);
    const Form energy = energy_form(omega_dt);
    const Form form = method.symplectic ? Form{-m.vx, m.xx - m.vv, m.xv} : energy;
    Bodies bodies = undamped_spring(omega_dt);
    const double at_start = energy.of(bodies.state(0));
    LongRun run{.steps = 0, .omega_dt = omega_dt, .lowest = 1, .highest = 1};
    if (!method.symplectic) run.predicted = 2 * static_cast<double>(std::log(spectral_radius(m)));
    // Stops before the energy has changed by a factor of e⁵⁰⁰.
    const double most = std::min(static_cast<double>(steps), 500 / std::abs(run.predicted));
    const auto stride = std::max<std::int64_t>(1, static_cast<std::int64_t>(most) / samples);
    std::vector<double> values;
    while (static_cast<double>(run.steps) < most) {
        if (bodies.try_step(method, {each_second, run.steps, stride, damping})) break;
        run.steps += stride;
        const double share = energy.of(bodies.state(0)) / at_start;
        run.lowest = std::min(run.lowest, share);
        run.highest = std::max(run.highest, share);
        values.push_back(form.of(bodies.state(0)));
    }
    run.trend = relative_trend(values) / static_cast<double>(stride);
    run.allowed =
        allowed_trend(method, static_cast<double>(run.steps)) + 1e-6 * std::abs(run.predicted);
    return run;
}

}  // namespace oiler::certify
