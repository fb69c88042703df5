// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>

namespace oiler {

/// What u'' = a − c·u' − k·u from u = 0, u' = v leads to after t seconds: u = v·reach + a·sway and
/// u' = v·decay + a·reach. For k = c = 0 these are t, t²/2 and 1.
template <std::floating_point T>
struct Response {
    T reach;  ///< s
    T sway;   ///< s²
    T decay;
};

/// `k` in 1/s², `c` in 1/s, `t` in s, of any sign. To one unit of round-off as long as ω·t < 2⁵⁰,
/// whatever the damping, and where next to nothing is left to 2⁻¹⁰⁰ of t, t² and 1. The same bits
/// on every machine, since nothing but + − × ÷ is used: Taylor series over t/2ᵐ, then m doublings,
/// with twice T's digits. Not finite where that overflows, as it may for damping backwards in time
/// and for numbers beyond some 10³⁰⁰.
template <std::floating_point T>
[[nodiscard]] Response<T> oscillator_response(T k, T c, T t);

}  // namespace oiler
