// SPDX-License-Identifier: MIT
#include "oiler/certify/problems.hpp"

#include <array>
#include <cmath>

#include "oiler/physics/closed_forms.hpp"

namespace oiler::certify {
namespace {

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

constexpr std::array list{
    Problem{"spring", 1, true, [](Bodies& bodies) { fill_springs(bodies, 0); },
            [](std::size_t row) { return spring_end(row, 0); }, plain_order},
    Problem{"orbit", 2, false, fill_orbit, orbit_end, plain_order},
    Problem{"damped spring", 1, true, [](Bodies& bodies) { fill_springs(bodies, spring_damping); },
            [](std::size_t row) { return spring_end(row, spring_damping); }, damped_order},
    Problem{"fall with drag", 1, false, fill_fall, fall_end, dragged_order},
};

}  // namespace

std::span<const Problem> problems() { return list; }

Bodies bodies_of(const Problem& problem, Precision precision) {
    Bodies bodies(problem.axes, precision);
    problem.fill(bodies);
    return bodies;
}

}  // namespace oiler::certify
