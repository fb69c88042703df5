// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "oiler/physics/methods/methods.hpp"

namespace oiler {

/// A spring and damper per unit mass: x'' = −k·x − c·v.
struct Oscillation {
    double k = 0;  ///< 1/s², ω²
    double c = 0;  ///< 1/s, 2ζω
};

/// The matrix of one step of an oscillation, on (x, v).
struct StepMatrix {
    long double xx, xv, vx, vv;

    [[nodiscard]] long double trace() const { return xx + vv; }
    [[nodiscard]] long double determinant() const { return xx * vv - xv * vx; }
};

/// Measures the matrices of one step of 1 s by stepping the unit states. They hold for any dt with
/// ω·dt = √k and c·dt = c. Those that overflow are infinite.
[[nodiscard]] std::vector<StepMatrix> step_matrices(const Method& method, Damping damping,
                                                    std::span<const Oscillation> oscillations);

/// The largest modulus of the eigenvalues.
[[nodiscard]] long double spectral_radius(const StepMatrix& matrix);

/// Whether no state grows: both eigenvalues are within the unit circle, apart from round-off. It
/// uses Jury's conditions, which unlike the eigenvalues are smooth where two eigenvalues meet.
[[nodiscard]] bool is_stable(const StepMatrix& matrix);

/// The factor on dt = 1 s up to which every step of the oscillation is stable, to 12 digits. It is
/// 0 if no step is stable, and infinite if all are stable up to max(ω, c)·dt = 40. The search
/// samples 8000 steps and the minima of the trace margin between them. It therefore also finds
/// instabilities that are far narrower than the samples, as some methods of high order have around
/// ω·dt = π.
[[nodiscard]] double stability_limit(const Method& method, Damping damping,
                                     const Oscillation& oscillation);

/// Whether the method applies damping along a spring or between bodies, and quadratic drag, in
/// half-steps around the step, which are always stable.
[[nodiscard]] bool splits_dampers(const Method& method, Damping damping);

/// Whether steps of the method are stable at any rate.
[[nodiscard]] bool is_implicit(const Method& method);

/// The steps at which stability is tested: a step and four shorter steps.
inline constexpr double tested_steps[] = {1.0, 0.8, 0.6, 0.4, 0.2};

/// An oscillation relative to a step.
struct ScaledOscillation {
    double omega_dt = 0;
    double damping_dt = 0;  ///< c·dt, c = 2ζω
};

/// max(ω, c)·dt.
[[nodiscard]] double size(const ScaledOscillation& of);

/// The oscillation with the same damping ratio and size 1, at a step of 1 s.
[[nodiscard]] Oscillation unit_oscillation(const ScaledOscillation& of);

/// A method's region of stability: the oscillations that are stable at a step of 1 s and at four
/// shorter steps, without its edge: oscillations that grow by a factor of 100 before they shrink.
class Region {
public:
    Region(const Method& method, Damping damping) : method_(method), damping_(damping) {}

    [[nodiscard]] const Method& method() const { return method_; }
    [[nodiscard]] Damping damping() const { return damping_; }

    bool contains(const ScaledOscillation& of);
    /// Whether all slower and less damped oscillations are in the region too. It samples a grid and
    /// answers only up to ω·dt = 1.5 and c·dt = 1.5, where no region has gaps.
    bool contains_all_up_to(const ScaledOscillation& of);

private:
    [[nodiscard]] bool measure(const Oscillation& of) const;

    const Method& method_;
    Damping damping_;
    std::map<std::pair<double, double>, bool> known_{};
};

}  // namespace oiler
