// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include "oiler/certify/certify.hpp"
#include "oiler/physics/closed_forms.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::certify {
namespace {

/// Bodies whose exact motion over one second is known in long double.
struct Problem {
    std::string_view name;
    int axes;
    bool linear;  ///< whether all forces are linear in position and velocity
    void (*fill)(Bodies& bodies);
    State<long double, 3> (*end)(std::size_t row);  ///< after 1 s
    /// The order of a method on this problem.
    int (*order)(const Method& method, Damping damping);
};

using Real = long double;

constexpr double spring_stiffness = 25;  // N/m
constexpr double spring_damping = 1;     // N·s/m
/// Two independent starts, so that no error vanishes by a lucky phase.
constexpr std::array<Motion<Real>, 2> starts{{{1, 0}, {0, 5}}};

void fill_springs(Bodies& bodies, double b) {
    for (const Motion<Real>& start : starts)
        bodies.add({.position = {static_cast<double>(start.x)},
                    .velocity = {static_cast<double>(start.v)}},
                   Spring{.stiffness = spring_stiffness, .damping = b});
}

State<Real, 3> along_x(const Motion<Real>& motion) { return {{motion.x}, {motion.v}}; }

State<Real, 3> spring_end(std::size_t row, Real b) {
    return along_x(damped_oscillator<Real>(1, spring_stiffness, b, starts[row], 1));
}

/// An ellipse of eccentricity 0.44 with a period of 4.3 s, from its nearest point. No method's
/// leading error changes sign at the measured steps. The numbers are dyadic, so the start is exact.
constexpr double gm = 12;            // m³/s²
constexpr double nearest = 1;        // m
constexpr double fastest = 4.15625;  // m/s

void fill_orbit(Bodies& bodies) {
    bodies.add({.position = {nearest}, .velocity = {0, fastest}}, Attractor{.gm = gm});
}

State<Real, 3> orbit_end(std::size_t) {
    const State<Real, 2> end = orbit<Real>(gm, nearest, fastest, 1);
    return {{end.x[0], end.x[1]}, {end.v[0], end.v[1]}};
}

constexpr double gravity = 10;  // m/s²
constexpr double drag = 0.5;    // N·s²/m²

void fill_fall(Bodies& bodies) {
    bodies.set_gravity({-gravity, 0, 0});
    bodies.add({}, QuadraticDrag{drag});
}

State<Real, 3> fall_end(std::size_t) { return along_x(quadratic_fall<Real>(gravity, drag, 1)); }

int plain_order(const Method& method, Damping) { return method.order; }

constexpr std::array problems{
    Problem{"spring", 1, true, [](Bodies& bodies) { fill_springs(bodies, 0); },
            [](std::size_t row) { return spring_end(row, 0); }, plain_order},
    Problem{"orbit", 2, false, fill_orbit, orbit_end, plain_order},
    Problem{"damped spring", 1, true, [](Bodies& bodies) { fill_springs(bodies, spring_damping); },
            [](std::size_t row) { return spring_end(row, spring_damping); }, damped_order},
    Problem{"fall with drag", 1, false, fill_fall, fall_end, dragged_order},
};

Bodies bodies_of(const Problem& problem, Precision precision) {
    Bodies bodies(problem.axes, precision);
    problem.fill(bodies);
    return bodies;
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double round_off(Precision precision) {
    return precision == Precision::extended
               ? static_cast<double>(std::numeric_limits<long double>::epsilon())
               : std::numeric_limits<double>::epsilon();
}

struct Errors {
    double position = 0;
    double velocity = 0;
};

Errors errors_after_a_second(const Method& method, Damping damping, const Problem& problem,
                             Precision precision, std::int64_t steps) {
    Bodies bodies = bodies_of(problem, precision);
    if (bodies.try_step(method, {.rate = {steps}, .count = steps, .damping = damping}))
        return {nan, nan};
    Errors largest;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        const auto end = bodies.state(row);
        const auto exact = problem.end(row);
        largest.position =
            std::max(largest.position, static_cast<double>(oiler::largest(end.x - exact.x)));
        largest.velocity =
            std::max(largest.velocity, static_cast<double>(oiler::largest(end.v - exact.v)));
    }
    return largest;
}

/// The slope of −log₂(error) over the index, by least squares. NaN if slopes between neighbours
/// differ by more than 1.5: then errors do not fall as a power of dt.
double slope(std::span<const double> errors) {
    std::vector<double> logarithms;
    std::vector<double> slopes;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        logarithms.push_back(-std::log2(errors[i]));
        if (i > 0) slopes.push_back(std::log2(errors[i - 1] / errors[i]));
    }
    const auto [least, most] = std::ranges::minmax(slopes);
    return most - least > 1.5 ? nan : slope_over_index(logarithms);
}

/// Uses the five finest step sizes at which both errors exceed 100 × the round-off of the steps.
MeasuredOrder measure_order(const Method& method, Damping damping, const Problem& problem,
                            Precision precision) {
    constexpr std::size_t sizes = 5;
    constexpr std::int64_t most_steps = 1 << 13;
    std::vector<double> positions;
    std::vector<double> velocities;
    for (std::int64_t steps = 4; steps <= most_steps; steps *= 2) {
        const Errors errors = errors_after_a_second(method, damping, problem, precision, steps);
        const double floor = 100 * round_off(precision) * std::sqrt(static_cast<double>(4 * steps));
        if (errors.position < floor || errors.velocity < floor) break;
        positions.push_back(errors.position);
        velocities.push_back(errors.velocity);
    }
    MeasuredOrder order{
        .problem = problem.name, .precision = precision, .claimed = problem.order(method, damping)};
    order.exact = positions.empty();
    if (positions.size() < sizes) return order;
    order.position = slope(std::span(positions).last(sizes));
    order.velocity = slope(std::span(velocities).last(sizes));
    return order;
}

}  // namespace

std::vector<MeasuredOrder> measure_orders(const Method& method, Damping damping) {
    std::vector<MeasuredOrder> orders;
    for (const Problem& problem : problems)
        for (const Precision precision : {Precision::double_, Precision::extended})
            if (problem.linear || method.order != exact_order)
                orders.push_back(measure_order(method, damping, problem, precision));
    return orders;
}

}  // namespace oiler::certify
