// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/stability/oscillations.hpp"

namespace oiler {

/// An eigenvalue of a symmetric matrix with its eigenvector of length 1.
struct Mode {
    double value;
    std::vector<double> vector;
};

/// The sum of the products of all vectors.
[[nodiscard]] double inner(const WeightedVectors& a, const WeightedVectors& b);

/// The vector of a mode, body by body.
[[nodiscard]] WeightedVectors to_vectors(const std::vector<double>& numbers,
                                         const Component& component);

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

/// A weighted sum of the stiffness and the damping matrix of a component.
struct MatrixSum {
    double stiffness = 0;
    double damping = 0;
    bool dampers_split = false;  ///< leaves the dampers out, but not the drag
};

/// An approximate eigenvalue with its vector of length 1. An eigenvalue is within `residual`.
struct RitzPair {
    double value = 0;
    double residual = 0;
    WeightedVectors vector{};
};

[[nodiscard]] WeightedVectors product(const Component& component, const MatrixSum& sum,
                                      const WeightedVectors& u);
/// The Rayleigh quotient of a vector of length 1.
[[nodiscard]] double quotient(const Component& component, const MatrixSum& sum,
                              const WeightedVectors& u);

/// Finds the highest eigenvalue by Lanczos' iteration from a random start. It stops when the
/// residual is below 2 % of the value, which makes a frequency uncertain by 1 %, or after 128
/// iterations. After 32 iterations the value is expected to be below the highest eigenvalue by less
/// than 4 % even if all eigenvalues are clustered (Kuczyński & Woźniakowski 1992); measured on nets
/// it is less than 0.1 %.
[[nodiscard]] RitzPair highest_ritz_pair(const Component& component, const MatrixSum& sum);

}  // namespace oiler
