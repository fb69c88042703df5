// SPDX-License-Identifier: MIT
#include "oiler/physics/response.hpp"

#include <algorithm>
#include <array>
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
struct ScaledResponse {
    Double<T> reach;
    Double<T> sway;
    Double<T> decay;
};

/// 1/n!; the last ones are below 2⁻¹²⁸.
template <class T>
constexpr std::array<Double<T>, 36> inverse_factorials = [] {
    std::array<Double<T>, 36> all{Double<T>{1}};
    for (std::size_t n = 1; n < all.size(); ++n) all[n] = all[n - 1] / static_cast<T>(n);
    return all;
}();

/// The terms of a Taylor series u = Σ uₙ/n!, uₙ₊₂ = −ct·uₙ₊₁ − kt²·uₙ, from n = 1 on, in numbers of
/// type N. For ct and √(kt²) ≤ 1/2, |uₙ| stays below 1 and falls.
template <class N, class T>
struct Terms {
    N ct;
    N kt2;
    N u;     ///< uₙ
    N next;  ///< uₙ₊₁
    std::size_t n = 1;
    N reach{};  ///< not summed without springs
    N sway{};

    /// Sums the terms until they are below `least`.
    void sum(T least) {
        const auto& factors = inverse_factorials<T>;
        const bool springs = high(kt2) != 0;
        while (n + 1 < factors.size() && size() * high(factors[n]) >= least) {
            sway = sway + u * as(factors[n + 1]);
            if (springs) reach = reach + u * as(factors[n]);
            u = std::exchange(next, springs ? -(ct * next + kt2 * u) : -(ct * next));
            ++n;
        }
    }

private:
    static constexpr T high(const Double<T>& a) { return a.high; }
    static constexpr T high(T a) { return a; }
    static constexpr N as(const Double<T>& a) {
        if constexpr (std::is_same_v<N, T>)
            return a.high;
        else
            return a;
    }
    [[nodiscard]] T size() const { return std::max(std::abs(high(u)), std::abs(high(next))); }
};

/// The shape for ct and √(kt²) ≤ 1/2. Terms below `coarse` have no more than the digits of T.
template <class T>
ScaledResponse<T> taylor(Double<T> ct, Double<T> kt2, T coarse) {
    Terms<Double<T>, T> terms{.ct = ct, .kt2 = kt2, .u = {1}, .next = -ct};
    terms.sum(coarse);
    Terms<T, T> rest{ct.high, kt2.high, terms.u.high, terms.next.high, terms.n};
    rest.sum(std::numeric_limits<T>::epsilon() * T(0x1p-48L));
    const Double<T> one{1};
    const Double<T> sway = terms.sway + Double<T>{rest.sway};
    if (kt2.high == 0) {
        const Double<T> reach = one - ct * sway;
        return {reach, sway, one - ct * reach};
    }
    const Double<T> reach = terms.reach + Double<T>{rest.reach};
    return {reach, sway, one - ct * reach - kt2 * sway};
}

/// The shape over twice the time. The second half starts from u = v·reach + a·sway, where the
/// acceleration is a − k·u.
template <class T>
ScaledResponse<T> doubled(const ScaledResponse<T>& s, Double<T> kt2) {
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
    // Doublings double errors.
    constexpr T epsilon = std::numeric_limits<T>::epsilon();
    ScaledResponse<T> shape =
        taylor(ct, kt2, doublings == 0 ? T(0x1p-40L) : epsilon * epsilon / 16);
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
