// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>

namespace oiler {

/// The solution of u'' = a − c·u' − k·u with u = 0, u' = v at the start, after t seconds: u =
/// v·reach + a·sway and u' = v·decay + a·reach. For k = c = 0, reach, sway and decay are t, t²/2
/// and 1.
template <std::floating_point T>
struct Response {
    T reach;  ///< s
    T sway;   ///< s²
    T decay;
};

/// `k` is in 1/s², `c` in 1/s, `t` in s, each of any sign. For ω·t < 2⁵⁰ and any damping, the error
/// is one unit of round-off, or 2⁻¹⁰⁰ of t, t² and 1 for results close to 0. The algorithm is a
/// Taylor series over t/2ᵐ, then m doublings, with twice the digits of T. It uses only + − × ÷, so
/// that the bits are the same on every machine. The result is not finite if it overflows, which may
/// happen for damping backwards in time and for numbers beyond about 10³⁰⁰.
template <std::floating_point T>
[[nodiscard]] Response<T> oscillator_response(T k, T c, T t);

}  // namespace oiler
