// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

namespace oiler {

// Distances in ulps: the number of floating-point numbers from one to the other. 0 and −0 are the
// same place, so the distance across zero is the sum of both distances from zero.

/// The distance from a NaN to any number.
inline constexpr std::uint64_t not_in_ulps = std::numeric_limits<std::uint64_t>::max();

[[nodiscard]] std::uint64_t ulps_between(float a, float b);
[[nodiscard]] std::uint64_t ulps_between(double a, double b);

/// Whether two numbers are the same to the sign of 0 and the payload of a NaN.
[[nodiscard]] bool has_same_bits(double a, double b);

}  // namespace oiler
