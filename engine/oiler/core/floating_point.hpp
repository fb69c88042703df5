// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

namespace oiler {

/// Throws Error(Exit::usage) unless the calling thread rounds to nearest and keeps subnormal
/// numbers. A single linked shared object that was built with -ffast-math switches subnormals off
/// for the whole process before main(), because g++ puts crtfastmath.o into it. Runs would then
/// silently give other bits. Call this once at start, before starting threads: threads inherit the
/// mode.
void require_ieee_arithmetic();

// Distances in ulps: the number of floating-point numbers from one to the other. 0 and −0 are the
// same place, so the distance across zero is the sum of both distances from zero.

/// The distance from a NaN to any number.
inline constexpr std::uint64_t not_in_ulps = std::numeric_limits<std::uint64_t>::max();

[[nodiscard]] std::uint64_t ulps_between(float a, float b);
[[nodiscard]] std::uint64_t ulps_between(double a, double b);

/// Whether two numbers are the same to the sign of 0 and the payload of a NaN.
[[nodiscard]] bool has_same_bits(double a, double b);

}  // namespace oiler
