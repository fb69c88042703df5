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

/// What a step does to (x, v) of an oscillation.
struct StepMatrix {
    long double xx, xv, vx, vv;

    [[nodiscard]] long double trace() const { return xx + vv; }
    [[nodiscard]] long double determinant() const { return xx * vv - xv * vx; }
};

/// The matrices of one step of 1 s, which are those of ω·dt = √k and c·dt = c for any dt, from
/// stepping the unit states.
[[nodiscard]] std::vector<StepMatrix> step_matrices(const Method& method, Damping damping,
                                                    std::span<const Oscillation> oscillations);

/// The larger of the moduli of the eigenvalues.
[[nodiscard]] long double spectral_radius(const StepMatrix& matrix);

/// Whether no state grows: both eigenvalues are within the unit circle, but for round-off. By
/// Jury's conditions, which unlike the eigenvalues stay smooth where two of these meet.
[[nodiscard]] bool is_stable(const StepMatrix& matrix);

/// The factor on dt = 1 s up to which every step of the oscillation is stable: 0 where none is,
/// infinite where all are up to max(ω, c)·dt = 40. To 12 digits. Instabilities are also found where
/// they are far narrower than the 8000 steps that are tried, as those of some methods of high order
/// around ω·dt = π, where the margin comes to a least.
[[nodiscard]] double stability_limit(const Method& method, Damping damping,
                                     const Oscillation& oscillation);

}  // namespace oiler
