// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "oiler/physics/methods/methods.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler {

/// Estimates the work of a step: force evaluations, each on one body or link.
class StepWork {
public:
    explicit StepWork(const Bodies& bodies) {
        const auto size = static_cast<double>(bodies.size());
        const auto links = static_cast<double>(bodies.link_count());
        per_evaluation_ = size + links;
        // A few iterations; each factorises the matrix of a net.
        to_solve_ = 4 * (links > 0 ? std::sqrt(size * bodies.axes()) : 1);
    }

    [[nodiscard]] double per_step(const Method& method) const {
        return per_evaluation_ * (method.evaluations > 0 ? method.evaluations : to_solve_);
    }

    /// A rough guess, on one core.
    [[nodiscard]] double seconds_per_step(const Method& method) const {
        constexpr double explicit_evaluation = 5e-9;  // s
        constexpr double implicit_evaluation = 3e-8;  // s
        return per_step(method) *
               (method.evaluations > 0 ? explicit_evaluation : implicit_evaluation);
    }

private:
    double per_evaluation_;
    double to_solve_;  ///< evaluations per implicit step
};

}  // namespace oiler
