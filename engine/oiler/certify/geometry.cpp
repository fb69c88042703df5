// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "oiler/certify/measures.hpp"

namespace oiler::certify {
namespace {

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

}  // namespace oiler::certify
