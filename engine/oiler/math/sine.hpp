// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "oiler/math/vec.hpp"

namespace oiler {

// The sine for forces that depend on time. The C library's last bit may differ between machines;
// these functions use + − × only.

/// 2^exponent, also where no whole type of the language has as many bits.
template <class T>
[[nodiscard]] constexpr T power_of_two(int exponent) {
    T power = 1;
    for (int i = 0; i < exponent; ++i) power = power * T(2);
    return power;
}

/// The nearest whole number, for |a| < 2^(digits − 2). For a larger a that is whole, it gives some
/// whole number.
template <Number V>
[[gnu::always_inline]] constexpr V nearest_whole(const V& a) {
    using T = Scalar<V>;
    constexpr T shift = T(3) * power_of_two<T>(std::numeric_limits<T>::digits - 2);
    const V shifted = a + V(shift);
    return shifted - V(shift);
}

/// The upper half of the digits of `a` (Dekker, A floating-point technique for extending the
/// available precision, 1971). The product of a lower half with an upper half, or of two upper
/// halves, has at most digits − 1 digits.
template <Number V>
[[gnu::always_inline]] constexpr V upper_half(const V& a) {
    using T = Scalar<V>;
    constexpr int half = std::numeric_limits<T>::digits / 2 + 1;
    constexpr T factor = power_of_two<T>(half) + T(1);
    const V scaled = a * V(factor);
    return scaled - (scaled - a);
}

/// The fraction of f·t, from −1/2 to 1/2, with an absolute error below 6 units of round-off,
/// however large f·t is. Products of halves are exact, and so are their fractions: a product above
/// the range of nearest_whole is whole, because it has so few digits.
template <Number V>
[[gnu::always_inline]] constexpr V turns(const V& frequency, double t) {
    using T = Scalar<V>;
    const V high = upper_half(frequency);
    const V low = frequency - high;
    V sum = V(T(0));
    for (double rest = t; rest != 0;) {
        const T part = upper_half(static_cast<T>(rest));
        rest -= static_cast<double>(part);
        for (const V& product : {high * V(part), low * V(part)})
            sum = sum + (product - nearest_whole(product));
    }
    return sum - nearest_whole(sum);
}

/// sin(2π·turns), with an absolute error below 10 units of round-off. It is the Taylor series over
/// a quarter of the angle and two doublings; the first term left out is below 2⁻⁷², or 2⁻¹²⁵ in
/// types of more digits than 64.
template <Number V>
[[gnu::always_inline]] constexpr V sine_of_turns(const V& turns) {
    using T = Scalar<V>;
    constexpr long double half_pi = 1.57079632679489661923132169163975144L;
    const V angle = (turns - nearest_whole(turns)) * V(T(half_pi));
    const V square = angle * angle;
    V sine = V(T(1));
    V cosine = V(T(1));
    for (int n = std::numeric_limits<T>::digits > 64 ? 30 : 20; n > 0; n -= 2) {
        cosine = V(T(1)) - cosine * square * V(T(1) / T(n * (n - 1)));
        sine = V(T(1)) - sine * square * V(T(1) / T(n * (n + 1)));
    }
    sine = sine * angle;
    for (int doubling = 0; doubling < 2; ++doubling) {
        const V twice = sine * cosine * V(T(2));
        cosine = V(T(1)) - sine * sine * V(T(2));
        sine = twice;
    }
    return sine;
}

}  // namespace oiler
