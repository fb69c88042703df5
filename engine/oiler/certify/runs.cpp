// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include "oiler/certify/certify.hpp"
#include "oiler/sim/bodies.hpp"
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

/// An orbit, or a spring in two axes for methods that cannot step an orbit.
Bodies plane(const Method& method) {
    Bodies bodies(2, Precision::extended);
    if (method.order == exact_order)
        bodies.add({}, Spring{.stiffness = 1});
    else
        bodies.add({}, Attractor{.gm = 1});
    return bodies;
}

using State4 = std::array<long double, 4>;  // x, y, vx, vy

State4 stepped(const Method& method, const State4& from) {
    Bodies bodies = plane(method);
    bodies.set_position(0, {static_cast<double>(from[0]), static_cast<double>(from[1])});
    bodies.set_velocity(0, {static_cast<double>(from[2]), static_cast<double>(from[3])});
    bodies.step(method, {.rate = {4}});
    const auto to = bodies.state(0);
    return {to.x[0], to.x[1], to.v[0], to.v[1]};
}

/// The derivative of a step by one coordinate: central differences of order 6 with spacing 2⁻¹¹,
/// accurate to about 10⁻¹⁵.
State4 derivative(const Method& method, std::size_t coordinate) {
    constexpr std::array<long double, 3> weights{45 / 60.0L, -9 / 60.0L, 1 / 60.0L};
    constexpr long double distance = 0x1p-11L;
    constexpr State4 at{0.75L, 0.125L, 0.25L, 1.125L};
    State4 sum{};
    for (std::size_t i = 0; i < weights.size(); ++i) {
        State4 ahead = at;
        State4 behind = at;
        ahead[coordinate] += static_cast<long double>(i + 1) * distance;
        behind[coordinate] -= static_cast<long double>(i + 1) * distance;
        const State4 after = stepped(method, ahead);
        const State4 before = stepped(method, behind);
        for (std::size_t j = 0; j < sum.size(); ++j)
            sum[j] += weights[i] * (after[j] - before[j]) / distance;
    }
    return sum;
}

}  // namespace

double symplectic_defect(const Method& method) {
    std::array<State4, 4> column;
    for (std::size_t i = 0; i < 4; ++i) column[i] = derivative(method, i);
    long double largest = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
            const State4& a = column[i];
            const State4& b = column[j];
            const long double area = a[0] * b[2] - a[2] * b[0] + a[1] * b[3] - a[3] * b[1];
            const long double unit = j == i + 2 ? 1 : i == j + 2 ? -1 : 0;
            largest = std::max(largest, std::abs(area - unit));
        }
    return static_cast<double>(largest);
}

double reversal_defect(const Method& method) {
    Bodies bodies = plane(method);
    bodies.set_position(0, {0.75, 0.125});
    bodies.set_velocity(0, {0.25, 1.125});
    const auto before = bodies.state(0);
    const Steps steps{.rate = {16}, .count = 16};
    if (bodies.try_step(method, steps)) return std::numeric_limits<double>::quiet_NaN();
    const auto turn = bodies.state(0);
    Bodies back = plane(method);
    back.set_state(0, {turn.x, -turn.v});
    if (back.try_step(method, steps)) return std::numeric_limits<double>::quiet_NaN();
    const auto after = back.state(0);
    return static_cast<double>(std::max(largest(after.x - before.x), largest(after.v + before.v)));
}

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
    std::vector<double> logarithms;
    while (static_cast<double>(run.steps) < most) {
        if (bodies.try_step(method, {each_second, run.steps, stride, damping})) break;
        run.steps += stride;
        const double share = energy.of(bodies.state(0)) / at_start;
        run.lowest = std::min(run.lowest, share);
        run.highest = std::max(run.highest, share);
        logarithms.push_back(std::log(form.of(bodies.state(0))));
    }
    run.trend = slope_over_index(logarithms) / static_cast<double>(stride);
    run.allowed =
        allowed_trend(method, static_cast<double>(run.steps)) + 1e-6 * std::abs(run.predicted);
    return run;
}

}  // namespace oiler::certify
