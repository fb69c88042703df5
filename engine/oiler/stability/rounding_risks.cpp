// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

/// The acceleration by all forces on the body, without links, m/s².
Vec3 acceleration(const Bodies& bodies, std::size_t row) {
    const State<double, 3> state{bodies.position(row), bodies.velocity(row)};
    Vec3 total{};
    for_each_force_on(bodies, row,
                      [&](const auto& force) { total = total + accelerate(force, state, 0); });
    return total;
}

/// Whether a float at `x` stays if `step` is added.
bool is_too_short(double x, double step) {
    return static_cast<float>(x) + static_cast<float>(step) == static_cast<float>(x) &&
           static_cast<float>(x) - static_cast<float>(step) == static_cast<float>(x);
}

double half_of_last_place(double x) {
    const auto at = static_cast<float>(std::abs(x));
    return (std::nextafter(at, std::numeric_limits<float>::infinity()) - at) / 2.0;
}

/// The largest part of dt·v that the method adds to a position at once: a sum of smaller parts is
/// rounded part by part.
double largest_part(const Method& method) {
    double largest = 0;
    const auto include = [&](long double part) {
        largest = std::max(largest, static_cast<double>(std::abs(part)));
    };
    if (const auto* splitting = std::get_if<Splitting>(&method.rule)) {
        for (const Stage& stage : splitting->stages())
            if (stage.move == Move::drift) include(stage.coefficient);
    } else if (const auto* tableau = std::get_if<Tableau>(&method.rule)) {
        for (const long double weight : tableau->b) include(weight);
    } else {
        include(1);
    }
    return largest;
}

/// The first axis along which the body should move and does not.
std::optional<int> stuck_axis(const Bodies& bodies, std::size_t row, double dt, double part) {
    constexpr double steps = 64;
    const Vec3 x = bodies.position(row);
    const Vec3 v = bodies.velocity(row);
    const double least = std::sqrt(squared_length(v)) / 1000;
    for (int axis = 0; axis < bodies.axes(); ++axis) {
        if (v[axis] == 0 || std::abs(v[axis]) < least ||
            !is_too_short(x[axis], v[axis] * dt * part))
            continue;
        const double faster = std::abs(acceleration(bodies, row)[axis]) * steps * dt;
        if (is_too_short(x[axis], (std::abs(v[axis]) + faster) * dt * part)) return axis;
    }
    return std::nullopt;
}

}  // namespace

void add_rounding_risks(const Bodies& bodies, const Method& method, double dt,
                        std::vector<Risk>& risks) {
    if (bodies.precision() != Precision::single) return;
    const double part = largest_part(method);
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (const auto axis = stuck_axis(bodies, row, dt, part))
            risks.push_back({.row = row,
                             .of = Risk::Of::rounded_position,
                             .at = half_of_last_place(bodies.position(row)[*axis]),
                             .axis = *axis});
}

}  // namespace oiler
