// SPDX-License-Identifier: MIT
#include "oiler/stability/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

constexpr long double round_off = 1e-14L;
constexpr double farthest = 40;  // of max(ω, c)·dt, and of ω·dt/ζ beyond ζ = 1/2

/// The distance of the trace from the point where an eigenvalue leaves the unit circle at 1 or −1.
/// Unlike the eigenvalues it is smooth where two eigenvalues meet.
long double trace_margin(const StepMatrix& matrix) {
    return 1 + matrix.determinant() - std::abs(matrix.trace());
}

/// The steps of an oscillation at multiples of dt = 1 s.
class Ray {
public:
    Ray(const Method& method, Damping damping, const Oscillation& oscillation)
        : method_(method), damping_(damping), oscillation_(oscillation) {}

    [[nodiscard]] std::vector<StepMatrix> at(const std::vector<double>& factors) const {
        std::vector<Oscillation> scaled;
        for (const double factor : factors)
            scaled.push_back({oscillation_.k * factor * factor, oscillation_.c * factor});
        return step_matrices(method_, damping_, scaled);
    }
    [[nodiscard]] StepMatrix at(double factor) const { return at(std::vector{factor}).front(); }

    /// Finds the factor between two with the smallest trace margin by golden-section search.
    [[nodiscard]] double least_between(double low, double high) const {
        constexpr double golden = 0.6180339887498949;
        while (high - low > 1e-8 * high) {
            const double left = high - golden * (high - low);
            const double right = low + golden * (high - low);
            if (trace_margin(at(left)) < trace_margin(at(right)))
                high = right;
            else
                low = left;
        }
        return (low + high) / 2;
    }
    /// Finds the edge of stability between a stable and an unstable factor by bisection.
    [[nodiscard]] double edge_between(double low, double high) const {
        while (high - low > 1e-14 * high) {
            const double middle = (low + high) / 2;
            (is_stable(at(middle)) ? low : high) = middle;
        }
        return low;
    }

private:
    const Method& method_;
    Damping damping_;
    Oscillation oscillation_;
};

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
    return matrix.determinant() <= 1 + round_off && trace_margin(matrix) >= -round_off;
}

double stability_limit(const Method& method, Damping damping, const Oscillation& oscillation) {
    constexpr std::size_t points = 8000;
    const Ray ray(method, damping, oscillation);
    const double omega = std::sqrt(std::abs(oscillation.k));
    const double c = std::abs(oscillation.c);
    const double unit = farthest / std::max(omega, c);
    std::vector<double> factors;
    for (std::size_t i = 0; i <= points; ++i)
        factors.push_back(unit * static_cast<double>(i) / points);
    // With damping in the drift, the limit of an overdamped spring is as large as ω·dt = 4ζ.
    if (omega > 0)
        for (const double end = farthest / omega * std::min(c / omega, 1e9); factors.back() < end;)
            factors.push_back(1.01 * factors.back());
    const std::vector<StepMatrix> steps = ray.at(factors);
    if (!is_stable(steps[1])) return 0;
    for (std::size_t i = 1; i + 1 < factors.size(); ++i) {
        if (!is_stable(steps[i + 1])) return ray.edge_between(factors[i], factors[i + 1]);
        const long double here = trace_margin(steps[i]);
        if (here > trace_margin(steps[i - 1]) || here > trace_margin(steps[i + 1])) continue;
        const double least = ray.least_between(factors[i - 1], factors[i + 1]);
        if (!is_stable(ray.at(least))) return ray.edge_between(factors[i - 1], least);
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace oiler
