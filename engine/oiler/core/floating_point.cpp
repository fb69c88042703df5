// SPDX-License-Identifier: MIT
#include "oiler/core/floating_point.hpp"

#include <algorithm>
#include <bit>
#include <cfenv>
#include <cmath>
#include <limits>

#include "oiler/core/error.hpp"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace oiler {
namespace {

bool keeps_subnormals() {
    volatile double smallest_normal = std::numeric_limits<double>::min();
    volatile double subnormal = smallest_normal / 2;
    return subnormal * 2 == smallest_normal;
}

bool rounds_to_nearest() {
#ifdef __SSE2__
    // Intel SDM volume 1, 10.2.3: the MXCSR register.
    constexpr unsigned rounding_control = 3U << 13;
    if ((_mm_getcsr() & rounding_control) != 0) return false;
#endif
    return std::fegetround() == FE_TONEAREST;
}

/// The bits without the sign are ordered as the magnitudes are (IEEE 754).
std::uint64_t steps_between(std::uint64_t a, std::uint64_t b, std::uint64_t sign) {
    const auto [low, high] = std::minmax({a & ~sign, b & ~sign});
    const bool across_zero = ((a ^ b) & sign) != 0;
    return across_zero ? low + high : high - low;
}

}  // namespace

void require_ieee_arithmetic() {
    if (!keeps_subnormals())
        fail(Exit::usage,
             "floating point: subnormal numbers are flushed to zero in this process, which changes "
             "results; find the linked or preloaded library that was built with -ffast-math and "
             "rebuild it without");
    if (!rounds_to_nearest())
        fail(Exit::usage,
             "floating point: rounding is not to nearest in this process, which changes results; "
             "call std::fesetround(FE_TONEAREST) before running");
}

std::uint64_t ulps_between(float a, float b) {
    if (std::isnan(a) || std::isnan(b)) return not_in_ulps;
    return steps_between(std::bit_cast<std::uint32_t>(a), std::bit_cast<std::uint32_t>(b),
                         std::uint64_t{1} << 31);
}

std::uint64_t ulps_between(double a, double b) {
    if (std::isnan(a) || std::isnan(b)) return not_in_ulps;
    return steps_between(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b),
                         std::uint64_t{1} << 63);
}

bool has_same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace oiler
