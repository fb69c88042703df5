// SPDX-License-Identifier: MIT
#include "oiler/stability/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "oiler/core/error.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

constexpr long double round_off = 1e-14L;
constexpr double farthest = 40;  // of max(ω, c)·dt, and of ω·dt/ζ beyond ζ = 1/2

/// The ω·dt, or ω·dt/ζ of overdamped springs, that is outside the region of every conditionally
/// stable method.
constexpr double outside_all = 1000;

/// The distance of the trace from the point where an eigenvalue leaves the unit circle at 1 or −1.
/// Unlike the eigenvalues it is smooth where two eigenvalues meet.
long double trace_margin(const StepMatrix& matrix) {
    return 1 + matrix.determinant() - std::abs(matrix.trace());
}

/// The factor by which an oscillation grows before it returns: 1 if it is slow, infinite at ω·dt =
/// 2 of velocity_verlet, where both eigenvalues are −1 and the amplitude grows with every step.
long double largest_growth(const StepMatrix& matrix, double omega) {
    const long double half = matrix.trace() / 2;
    const long double turn = std::sqrt(std::abs(matrix.determinant() - half * half));
    const long double loss = std::numbers::e_v<long double> * (1 - spectral_radius(matrix));
    const long double mixing = std::max({std::abs(matrix.xv) * omega, std::abs(matrix.vx) / omega,
                                         std::abs(matrix.xx - matrix.vv) / 2});
    return mixing / std::max(turn, loss);
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
    /// Finds the edge of stability between a stable and an unstable factor.
    [[nodiscard]] double edge_between(double stable, double unstable) const {
        return oiler::edge_between(stable, unstable, 1e-14,
                                   [&](double factor) { return is_stable(at(factor)); });
    }

private:
    const Method& method_;
    Damping damping_;
    Oscillation oscillation_;
};

}  // namespace

namespace {

/// None if any of the steps diverges, or if damping overflows in a backward drift.
std::optional<std::vector<StepMatrix>> finite_matrices(
    const Method& method, Damping damping, std::span<const Oscillation> oscillations) try {
    Bodies bodies(1, Precision::extended);
    for (const auto& [k, c] : oscillations)
        for (const Body& unit : {Body{.position = {1}}, Body{.velocity = {1}}})
            bodies.add(unit, Spring{.stiffness = k, .damping = c});
    if (bodies.try_step(method, {.rate = {1}, .damping = damping})) return std::nullopt;
    std::vector<StepMatrix> matrices;
    for (std::size_t i = 0; i < oscillations.size(); ++i) {
        const auto from_x = bodies.state(2 * i);
        const auto from_v = bodies.state(2 * i + 1);
        matrices.push_back({from_x.x[0], from_v.x[0], from_x.v[0], from_v.v[0]});
    }
    return matrices;
} catch (const Error&) {
    return std::nullopt;
}

}  // namespace

std::vector<StepMatrix> step_matrices(const Method& method, Damping damping,
                                      std::span<const Oscillation> oscillations) {
    if (auto matrices = finite_matrices(method, damping, oscillations)) return *std::move(matrices);
    if (oscillations.size() == 1)
        return {StepMatrix{std::numeric_limits<long double>::infinity(), 0, 0, 0}};
    const std::size_t half = oscillations.size() / 2;
    std::vector<StepMatrix> matrices = step_matrices(method, damping, oscillations.first(half));
    for (const StepMatrix& one : step_matrices(method, damping, oscillations.subspan(half)))
        matrices.push_back(one);
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

bool splits_dampers(const Method& method, Damping damping) {
    return std::holds_alternative<Splitting>(method.rule) && damping == Damping::in_drift;
}

bool is_implicit(const Method& method) {
    return std::holds_alternative<ImplicitStage>(method.rule) ||
           std::holds_alternative<ExactFlow>(method.rule);
}

double size(const ScaledOscillation& of) { return std::max(of.omega_dt, of.damping_dt); }

Oscillation unit_oscillation(const ScaledOscillation& of) {
    const double omega = of.omega_dt / size(of);
    return {omega * omega, of.damping_dt / size(of)};
}

bool Region::contains(const ScaledOscillation& of) {
    if (!(size(of) > 0)) return true;
    if (!std::isfinite(size(of))) return false;
    const double ratio =
        of.omega_dt > 0 ? std::clamp(of.damping_dt / of.omega_dt, 1.0, 1e9) : 1;  // 2ζ, at least 1
    const double reached = std::min(size(of), outside_all * ratio * ratio);
    const auto [k, c] = unit_oscillation(of);
    const Oscillation at{k * reached * reached, c * reached};
    const auto [known, is_new] = known_.try_emplace(std::pair(at.k, at.c), false);
    if (is_new) known->second = measure(at);
    return known->second;
}

bool Region::contains_all_up_to(const ScaledOscillation& of) {
    if (!(size(of) <= 1.5)) return false;
    for (const double omega : {0.0, 0.25, 0.5, 0.75, 1.0})
        for (const double c : {0.0, 0.25, 0.5, 0.75, 1.0})
            if (!contains({of.omega_dt * omega, of.damping_dt * c})) return false;
    return true;
}

bool Region::measure(const Oscillation& of) const {
    std::vector<Oscillation> tried;
    for (const double part : tested_steps) tried.push_back({of.k * part * part, of.c * part});
    const auto matrices = step_matrices(method_, damping_, tried);
    constexpr double most_growth = 100;
    const double omega = std::sqrt(of.k);
    if (omega > 0.5 && largest_growth(matrices.front(), omega) > most_growth) return false;
    return std::all_of(matrices.begin(), matrices.end(), is_stable);
}

}  // namespace oiler
