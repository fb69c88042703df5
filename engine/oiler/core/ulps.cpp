// SPDX-License-Identifier: MIT
#include "oiler/core/ulps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace oiler {
namespace {

/// The bits without the sign are ordered as the magnitudes are (IEEE 754).
std::uint64_t steps_between(std::uint64_t a, std::uint64_t b, std::uint64_t sign) {
    const auto [low, high] = std::minmax({a & ~sign, b & ~sign});
    const bool across_zero = ((a ^ b) & sign) != 0;
    return across_zero ? low + high : high - low;
}

}  // namespace

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
