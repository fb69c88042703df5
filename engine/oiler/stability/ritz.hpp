// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/stability/component.hpp"

namespace oiler {

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
