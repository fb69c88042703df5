// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/stability/component.hpp"
#include "oiler/stability/stability.hpp"

namespace oiler {

/// An eigenvalue of a symmetric matrix with its eigenvector of length 1.
struct Mode {
    double value;
    std::vector<double> vector;
};

/// The modes of the stiffness matrix of a component by their ω², 1/s², the highest last.
[[nodiscard]] std::vector<Mode> stiffness_modes(const Component& component);

/// The mode of the damping matrix, with drag, with the highest rate, 1/s. `dampers_split` leaves
/// the dampers out.
[[nodiscard]] Mode fastest_damping(const Component& component, bool dampers_split);

/// The highest mode of a symmetric tridiagonal matrix.
[[nodiscard]] Mode highest_mode(const std::vector<double>& diagonal,
                                const std::vector<double>& beside);

/// Measures the matrix of one step of an explicit method on a whole component, from all unit
/// states, and returns its spectral radius. Infinite if the matrix is not finite. The error is
/// about 10⁻⁷, because eigenvalues at 1 of bodies in free flight are defective.
[[nodiscard]] double spectral_radius_of_step(const Component& component, const Method& method,
                                             Damping damping, double dt);

}  // namespace oiler
