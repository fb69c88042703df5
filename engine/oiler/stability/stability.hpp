// SPDX-License-Identifier: MIT
#pragma once

#include <span>
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
/// ω·dt = √k and c·dt = c.
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

}  // namespace oiler
