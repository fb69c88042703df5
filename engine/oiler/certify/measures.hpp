// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "oiler/certify/certify.hpp"

namespace oiler::certify {

// What a certificate is put together from.

/// On each of the problems that the method takes, in double and in long double.
[[nodiscard]] std::vector<MeasuredOrder> measure_orders(const Method& method, Damping damping);

/// The largest entry of MᵀJM − J, where M is the derivative of a step of an orbit and J that of
/// x ∧ v; 0 for a step that conserves it.
[[nodiscard]] double symplectic_defect(const Method& method);

/// How far 16 steps of an orbit and, with the velocity turned, as many back miss the start.
[[nodiscard]] double reversal_defect(const Method& method);

/// Of the forces, in a run of 1000 steps at once or one by one.
[[nodiscard]] double evaluations_per_step(const Method& method, Damping damping, bool at_once);

/// Whether runs in double are bounded and grow where `limit`, of ω·dt, says so.
[[nodiscard]] bool confirm_limit(const Method& method, Damping damping, double limit);

/// At ω·dt = 0.45 or a quarter of the limit, whichever is smaller.
[[nodiscard]] LongRun run_long(const Method& method, Damping damping, double limit,
                               std::int64_t steps);

}  // namespace oiler::certify
