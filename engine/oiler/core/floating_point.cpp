// SPDX-License-Identifier: MIT
#include "oiler/core/floating_point.hpp"

#include <cfenv>

#include "oiler/core/error.hpp"

#ifdef __SSE2__
#include <xmmintrin.h>
#else
#include <limits>
#endif

namespace oiler {
namespace {

#ifdef __SSE2__

// Intel SDM volume 1, 10.2.3: the MXCSR register.
bool keeps_subnormals() {
    constexpr unsigned denormals_are_zero = 1U << 6;
    constexpr unsigned flush_to_zero = 1U << 15;
    return (_mm_getcsr() & (denormals_are_zero | flush_to_zero)) == 0;
}

bool rounds_to_nearest() {
    constexpr unsigned rounding_control = 3U << 13;
    return (_mm_getcsr() & rounding_control) == 0 && std::fegetround() == FE_TONEAREST;
}

#else

bool keeps_subnormals() {
    volatile double smallest_normal = std::numeric_limits<double>::min();
    volatile double subnormal = smallest_normal / 2;
    return subnormal * 2 == smallest_normal;
}

bool rounds_to_nearest() { return std::fegetround() == FE_TONEAREST; }

#endif

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

}  // namespace oiler
