// SPDX-License-Identifier: MIT
#include "oiler/core/floating_point.hpp"

#include <cfenv>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include "support/test.hpp"

namespace oiler::test {
namespace {

void expect_refusal() {
    EXPECT_EQ(line_of_error(Exit::usage, [&] { require_ieee_arithmetic(); }).find('\n'),
              std::string::npos);
}

TEST(RequireIeeeArithmetic, AcceptsTheDefaultMode) { EXPECT_NO_THROW(require_ieee_arithmetic()); }

TEST(RequireIeeeArithmetic, RefusesOtherRounding) {
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        std::fesetround(mode);
        expect_refusal();
        std::fesetround(FE_TONEAREST);
    }
}

#ifdef __SSE2__

TEST(RequireIeeeArithmetic, RefusesFlushedSubnormals) {
    const unsigned before = _mm_getcsr();
    for (const unsigned bit : {0x0040U, 0x8000U}) {
        _mm_setcsr(before | bit);
        expect_refusal();
        _mm_setcsr(before);
    }
    EXPECT_NO_THROW(require_ieee_arithmetic());
}

TEST(RequireIeeeArithmetic, AcceptsExceptionFlagsAndMasks) {
    const unsigned before = _mm_getcsr();
    _mm_setcsr((before | 0x003FU) & ~0x0080U);
    EXPECT_NO_THROW(require_ieee_arithmetic());
    _mm_setcsr(before);
}

#endif

}  // namespace
}  // namespace oiler::test
