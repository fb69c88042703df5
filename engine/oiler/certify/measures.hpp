// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "oiler/certify/certify.hpp"

namespace oiler::certify {

// The measurements of a certificate.

/// Measures the order on each problem that the method can step, in double and in long double.
[[nodiscard]] std::vector<MeasuredOrder> measure_orders(const Method& method, Damping damping);

/// The largest entry of MᵀJM − J, where M is the derivative of a step of an orbit and J that of
/// x ∧ v; 0 for a step that conserves it.
[[nodiscard]] double symplectic_defect(const Method& method);

/// The distance from the start after 16 steps of an orbit and 16 with reversed velocity.
[[nodiscard]] double reversal_defect(const Method& method);

/// Force evaluations per step over 1000 steps, in one call or in one call per step.
[[nodiscard]] double evaluations_per_step(const Method& method, Damping damping, bool one_call);

/// Whether runs in double are bounded just below `limit`, of ω·dt, and grow just above it.
[[nodiscard]] bool confirm_limit(const Method& method, Damping damping, double limit);

/// Runs an undamped spring with ω·dt = 0.45 or limit/4, whichever is smaller; 0.01 if limit is 0.
[[nodiscard]] LongRun run_long(const Method& method, Damping damping, double limit,
                               std::int64_t steps);

}  // namespace oiler::certify
