// SPDX-License-Identifier: MIT
#include "oiler/stability/drag_risks.hpp"

#include <cmath>
#include <limits>

namespace oiler {
namespace {

/// The drag of a body, its free fall and its speed.
struct Falling {
    double linear = 0;     ///< 1/s
    double quadratic = 0;  ///< 1/m
    double gravity = 0;    ///< m/s²; 0 if other forces hold the body
    double speed = 0;      ///< m/s

    /// The speed at which drag balances gravity: b·v + c·v² = g.
    [[nodiscard]] double terminal_speed() const {
        const double root = std::sqrt(linear * linear + 4 * quadratic * gravity);
        return 2 * gravity / (linear + root);
    }
};

Falling falling_of(const Bodies& bodies, std::size_t row) {
    Falling of{.speed = std::sqrt(squared_length(bodies.velocity(row)))};
    bool is_held = false;
    for (std::size_t i = 0; i < bodies.most_forces_of_a_kind(); ++i) {
        const auto [gravity, spring, linear, quadratic, coil, attractor] =
            bodies.forces_per_mass(row, i);
        if (gravity) of.gravity = std::sqrt(squared_length(gravity->acceleration));
        if (linear) of.linear += linear->coefficient;
        if (quadratic) of.quadratic += quadratic->coefficient;
        is_held = is_held || (spring && spring->stiffness != 0) || (coil && coil->stiffness != 0) ||
                  (attractor && attractor->gm != 0);
    }
    if (is_held) of.gravity = 0;
    return of;
}

/// Whether a step makes a body of 1 m/s faster, for each c·|v|·dt.
std::vector<bool> speed_up(const Method& method, Damping damping, std::vector<double> drags) {
    Bodies bodies(1, Precision::extended);
    for (const double drag : drags) bodies.add({.velocity = {1}}, QuadraticDrag{drag});
    std::vector<bool> faster(drags.size(), true);
    if (bodies.try_step(method, {.rate = {1}, .damping = damping})) return faster;
    for (std::size_t row = 0; row < drags.size(); ++row)
        faster[row] = !(std::abs(bodies.state(row).v[0]) <= 1 + 1e-14L);
    return faster;
}

bool has_quadratic_drag(const Bodies& bodies) {
    for (const Stored& stored : bodies.stored())
        if (stored.of == QuadraticDrag::name && stored.rows > 0) return true;
    return false;
}

}  // namespace

double quadratic_drag_limit(const Method& method, Damping damping) {
    std::vector<double> drags;
    for (double drag = 0.05; drag < 1000; drag *= 1.01) drags.push_back(drag);
    double low = 0;
    double high = std::numeric_limits<double>::infinity();
    const std::vector<bool> faster = speed_up(method, damping, drags);
    for (std::size_t i = 0; i < drags.size() && std::isinf(high); ++i)
        (faster[i] ? high : low) = drags[i];
    if (std::isinf(high)) return high;
    while (high - low > 1e-14 * high) {
        const double middle = (low + high) / 2;
        (speed_up(method, damping, {middle}).front() ? high : low) = middle;
    }
    return low;
}

void add_drag_risks(const Bodies& bodies, Region& region, double dt, std::vector<Risk>& risks) {
    if (is_implicit(region.method()) || splits_dampers(region.method(), region.damping())) return;
    if (!has_quadratic_drag(bodies)) return;
    const double limit = quadratic_drag_limit(region.method(), region.damping());
    std::vector<bool> linked(bodies.size());
    for (std::size_t i = 0; i < bodies.link_count(); ++i)
        for (const std::size_t row : bodies.linked_rows(i)) linked[row] = true;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        const Falling of = falling_of(bodies, row);
        if (!(of.quadratic > 0)) continue;
        Risk risk{.row = row, .of = Risk::Of::quadratic_drag, .at = of.speed};
        risk.damping_dt = (of.linear + of.quadratic * of.speed) * dt;
        if (!(risk.damping_dt <= limit)) risks.push_back(risk);
        if (linked[row] || of.gravity == 0) continue;
        risk.of = Risk::Of::terminal_speed;
        risk.at = of.terminal_speed();
        risk.damping_dt = (of.linear + 2 * of.quadratic * risk.at) * dt;
        if (!region.contains({0, risk.damping_dt})) risks.push_back(risk);
    }
}

}  // namespace oiler
