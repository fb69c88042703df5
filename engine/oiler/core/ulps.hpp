// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>

namespace oiler {

/// Distance of two numbers in units in the last place: the number of steps of std::nextafter from
/// one to the other. -0.0 and 0.0 are one step apart, so that only equal bits have distance 0.
template <std::floating_point Real>
[[nodiscard]] constexpr std::uint64_t ulps_between(Real a, Real b) {
    using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    constexpr Bits sign = Bits{1} << (8 * sizeof(Real) - 1);
    // Maps the numbers to integers in their order: negative ones below, positive ones above.
    const auto order = [](Real value) {
        const auto bits = std::bit_cast<Bits>(value);
        return (bits & sign) != 0 ? static_cast<Bits>(~bits) : static_cast<Bits>(bits | sign);
    };
    const Bits first = order(a);
    const Bits second = order(b);
    return first < second ? second - first : first - second;
}

}  // namespace oiler
