// SPDX-License-Identifier: MIT
#include "oiler/physics/response.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace oiler {
namespace {

/// A number with twice the digits of T: the unevaluated sum of two. Sums and products are from
/// Dekker, A floating-point technique for extending the available precision, 1971; two_sum is
/// Knuth's.
template <std::floating_point T>
struct Double {
    T high = 0;
    T low = 0;

    static constexpr Double two_sum(T a, T b) {
        const T sum = a + b;
        const T b_part = sum - a;
        return {sum, (a - (sum - b_part)) + (b - b_part)};
    }
    static constexpr Double two_product(T a, T b) {
        const T product = a * b;
        const Double x = split(a);
        const Double y = split(b);
        return {product,
                ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low};
    }
    static constexpr Double split(T a) {
        constexpr int half = (std::numeric_limits<T>::digits + 1) / 2;
        constexpr T factor = static_cast<T>((1ULL << half) + 1);
        const T high = factor * a - (factor * a - a);
        return {high, a - high};
    }

    friend constexpr Double operator+(Double a, Double b) {
        const Double sum = two_sum(a.high, b.high);
        const Double rest = two_sum(a.low, b.low);
        const Double first = two_sum(sum.high, sum.low + rest.high);
        return two_sum(first.high, first.low + rest.low);
    }
    friend constexpr Double operator-(Double a) { return {-a.high, -a.low}; }
    friend constexpr Double operator-(Double a, Double b) { return a + -b; }
    friend constexpr Double operator*(Double a, Double b) {
        const Double product = two_product(a.high, b.high);
        return two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
    }
    friend constexpr Double operator/(Double a, T b) {
        const T quotient = a.high / b;
        const Double rest = a - two_product(quotient, b);
        return two_sum(quotient, rest.high / b);
    }
    /// The product with a power of two, which is exact.
    [[nodiscard]] constexpr Double times(T power) const { return {high * power, low * power}; }
};

/// reach/t, sway/t² and decay as functions of c·t and k·t².
template <class T>
struct Shape {
    Double<T> reach;
    Double<T> sway;
    Double<T> decay;
};

/// The Taylor series u = Σ uₙ/n!, uₙ₊₂ = −ct·uₙ₊₁ − kt²·uₙ. For ct and √(kt²) ≤ 1/2, |uₙ| stays
/// below 1, and 1/n! is below 2⁻¹²⁸ from n = 35 on.
template <class T>
Shape<T> taylor(Double<T> ct, Double<T> kt2) {
    Double<T> u{0};
    Double<T> next{1};
    Double<T> inverse_factorial{1};
    Shape<T> sum{};
    for (int n = 0; n < 35; ++n) {
        const T after = static_cast<T>(n + 1);
        sum.decay = sum.decay + next * inverse_factorial;
        sum.reach = sum.reach + u * inverse_factorial;
        inverse_factorial = inverse_factorial / after;
        sum.sway = sum.sway + u * inverse_factorial;
        u = std::exchange(next, -(ct * next + kt2 * u));
    }
    return sum;
}

/// The shape over twice the time. The second half starts from u = v·reach + a·sway, where the
/// acceleration is a − k·u.
template <class T>
Shape<T> doubled(const Shape<T>& s, Double<T> kt2) {
    const Double<T> one{1};
    const Double<T> left = one - kt2 * s.sway;
    return {(s.reach * (s.decay + left)).times(T(0.5)),
            (s.sway + s.reach * s.reach + left * s.sway).times(T(0.25)),
            s.decay * s.decay - kt2 * s.reach * s.reach};
}

template <class T>
Response<T> respond(T k, T c, T t) {
    Double<T> ct = Double<T>::two_product(c, t);
    Double<T> kt2 = Double<T>::two_product(k, t) * Double<T>{t};
    const T size = std::max(std::abs(ct.high), std::sqrt(std::abs(kt2.high)));
    if (!std::isfinite(size)) return {size, size, size};
    int doublings = 0;
    for (T scale = size; scale > T(0.5); scale /= 2) {
        ++doublings;
        ct = ct.times(T(0.5));
        kt2 = kt2.times(T(0.25));
    }
    Shape<T> shape = taylor(ct, kt2);
    for (int i = 0; i < doublings; ++i) {
        shape = doubled(shape, kt2);
        kt2 = kt2.times(T(4));
    }
    const Double<T> reach = shape.reach * Double<T>{t};
    const Double<T> sway = shape.sway * Double<T>::two_product(t, t);
    return {reach.high, sway.high, shape.decay.high};
}

}  // namespace

template <std::floating_point T>
Response<T> oscillator_response(T k, T c, T t) {
    if constexpr (std::is_same_v<T, float>) {
        const auto [reach, sway, decay] = respond<double>(k, c, t);
        return {static_cast<float>(reach), static_cast<float>(sway), static_cast<float>(decay)};
    } else {
        return respond<T>(k, c, t);
    }
}

template Response<float> oscillator_response(float, float, float);
template Response<double> oscillator_response(double, double, double);
template Response<long double> oscillator_response(long double, long double, long double);

}  // namespace oiler
