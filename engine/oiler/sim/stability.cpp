// SPDX-License-Identifier: MIT
#include "oiler/sim/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

constexpr long double round_off = 1e-14L;
constexpr double farthest = 40;  // of max(ω, c)·dt

Oscillation scaled(const Oscillation& oscillation, double factor) {
    return {oscillation.k * factor * factor, oscillation.c * factor};
}

bool is_stable_at(const Method& method, Damping damping, const Oscillation& oscillation) {
    return is_stable(step_matrices(method, damping, std::span(&oscillation, 1)).front());
}

}  // namespace

std::vector<StepMatrix> step_matrices(const Method& method, Damping damping,
                                      std::span<const Oscillation> oscillations) {
    Bodies bodies(1, Precision::extended);
    for (const auto& [k, c] : oscillations)
        for (const Body& unit : {Body{.position = {1}}, Body{.velocity = {1}}})
            bodies.add(unit, Spring{.stiffness = k, .damping = c});
    std::vector<StepMatrix> matrices(
        oscillations.size(), StepMatrix{std::numeric_limits<long double>::infinity(), 0, 0, 0});
    if (bodies.try_step(method, {.rate = {1}, .damping = damping})) return matrices;
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        const auto from_x = bodies.state(2 * i);
        const auto from_v = bodies.state(2 * i + 1);
        matrices[i] = {from_x.x[0], from_v.x[0], from_x.v[0], from_v.v[0]};
    }
    return matrices;
}

long double spectral_radius(const StepMatrix& matrix) {
    const long double half = matrix.trace() / 2;
    const long double determinant = matrix.determinant();
    const long double discriminant = half * half - determinant;
    if (discriminant < 0) return std::sqrt(determinant);
    return std::abs(half) + std::sqrt(discriminant);
}

bool is_stable(const StepMatrix& matrix) {
    const long double determinant = matrix.determinant();
    return determinant <= 1 + round_off && std::abs(matrix.trace()) <= 1 + determinant + round_off;
}

double stability_limit(const Method& method, Damping damping, const Oscillation& oscillation) {
    const double unit = 1 / std::max(std::sqrt(std::abs(oscillation.k)), std::abs(oscillation.c));
    constexpr int points = 16'000;
    std::vector<Oscillation> grid;
    for (int i = 1; i <= points; ++i)
        grid.push_back(scaled(oscillation, unit * farthest * i / points));
    const auto matrices = step_matrices(method, damping, grid);
    const auto unstable = std::find_if_not(matrices.begin(), matrices.end(), is_stable);
    if (unstable == matrices.end()) return std::numeric_limits<double>::infinity();
    if (unstable == matrices.begin()) return 0;
    double low = unit * farthest * static_cast<double>(unstable - matrices.begin()) / points;
    double high = low + unit * farthest / points;
    while (high - low > 1e-14 * high) {
        const double middle = (low + high) / 2;
        (is_stable_at(method, damping, scaled(oscillation, middle)) ? low : high) = middle;
    }
    return low;
}

}  // namespace oiler
