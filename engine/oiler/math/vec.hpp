// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>

namespace oiler {

/// The number type of the physics: float or double for a single body, long double for a reference,
/// a Batch of bodies for a run. The same text serves all.
template <class V>
concept Number = requires(V a, V b) {
    { a + b } -> std::convertible_to<V>;
    { a - b } -> std::convertible_to<V>;
    { a* b } -> std::convertible_to<V>;
    { a / b } -> std::convertible_to<V>;
    { -a } -> std::convertible_to<V>;
};

/// The element type of a Number: the type of the time step and of a method's coefficients.
template <class V>
struct ScalarOf {
    using type = V;
};
template <class V>
using Scalar = typename ScalarOf<V>::type;

/// Calls `f` with the compile-time constants 0, 1, … N−1 and returns an array of the results.
/// Unlike a loop it indexes no array at run time, so that optimisers keep the elements in
/// registers.
template <std::size_t N, class F>
[[gnu::always_inline]] constexpr auto generate(F f) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
        return std::array{f(std::integral_constant<std::size_t, I>{})...};
    }
    (std::make_index_sequence<N>{});
}

/// Calls `f` with the compile-time constants 0, 1, … N−1.
template <std::size_t N, class F>
[[gnu::always_inline]] constexpr void for_each_index(F f) {
    [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
        (f(std::integral_constant<std::size_t, I>{}), ...);
    }
    (std::make_index_sequence<N>{});
}

/// Calls `f` with 0, 1, … count−1: unrolled if the count is a compile-time constant, else in a
/// loop.
template <std::size_t N, class F>
[[gnu::always_inline]] constexpr void repeat(std::integral_constant<std::size_t, N>, F f) {
    for_each_index<N>(f);
}
template <class F>
[[gnu::always_inline]] constexpr void repeat(std::size_t count, F f) {
    for (std::size_t i = 0; i < count; ++i) f(i);
}

/// A position, velocity or acceleration: one Number per axis.
template <Number V, int Axes>
struct Vec {
    std::array<V, Axes> axis{};

    /// Not for temporaries: `world.velocity(mass)[0] += 1` would have no effect.
    constexpr V& operator[](int i) & { return axis[static_cast<std::size_t>(i)]; }
    constexpr const V& operator[](int i) const& { return axis[static_cast<std::size_t>(i)]; }

    [[gnu::always_inline]] friend constexpr Vec operator+(const Vec& a, const Vec& b) {
        return {generate<Axes>([&](auto i) { return V(a.axis[i] + b.axis[i]); })};
    }
    [[gnu::always_inline]] friend constexpr Vec operator-(const Vec& a, const Vec& b) {
        return {generate<Axes>([&](auto i) { return V(a.axis[i] - b.axis[i]); })};
    }
    [[gnu::always_inline]] friend constexpr Vec operator-(const Vec& a) {
        return {generate<Axes>([&](auto i) { return V(-a.axis[i]); })};
    }
    [[gnu::always_inline]] friend constexpr Vec operator*(const Vec& a, const V& s) {
        return {generate<Axes>([&](auto i) { return V(a.axis[i] * s); })};
    }
    friend constexpr Vec operator*(const V& s, const Vec& a) { return a * s; }
    friend constexpr Vec operator/(const Vec& a, const V& s) {
        return {generate<Axes>([&](auto i) { return V(a.axis[i] / s); })};
    }
    constexpr Vec& operator+=(const Vec& b) { return *this = *this + b; }
    constexpr Vec& operator-=(const Vec& b) { return *this = *this - b; }
    constexpr Vec& operator*=(const V& s) { return *this = *this * s; }
    constexpr Vec& operator/=(const V& s) { return *this = *this / s; }
    friend constexpr bool operator==(const Vec&, const Vec&) = default;
    template <class Hash>
    void hash(Hash& hash) const {
        hash.add(axis);
    }
};

inline constexpr std::string_view axis_names = "xyz";

/// The vector of the public API, for all axes and precisions of the columns. Axes that a world
/// lacks are zero.
using Vec3 = Vec<double, 3>;

/// The dot product, summed from the first axis to the last.
template <Number V, int Axes>
[[gnu::always_inline]] constexpr V dot(const Vec<V, Axes>& a, const Vec<V, Axes>& b) {
    V sum = a[0] * b[0];
    if constexpr (Axes > 1) sum = sum + a[1] * b[1];
    if constexpr (Axes > 2) sum = sum + a[2] * b[2];
    return sum;
}

template <Number V, int Axes>
[[gnu::always_inline]] constexpr V squared_length(const Vec<V, Axes>& a) {
    return dot(a, a);
}

/// The Euclidean length. It is 0 or infinite where its square is.
template <std::floating_point T, int Axes>
[[nodiscard]] T length(const Vec<T, Axes>& a) {
    return std::sqrt(squared_length(a));
}

/// The vector of length 1 in the direction of `a`; 0 for a length of 0.
template <std::floating_point T, int Axes>
[[nodiscard]] Vec<T, Axes> normalised(const Vec<T, Axes>& a) {
    const T size = length(a);
    return size == 0 ? Vec<T, Axes>{} : a / size;
}

/// to += what·s: the arithmetic of a kick or a drift.
template <Number V, int Axes>
[[gnu::always_inline]] constexpr void add_scaled(Vec<V, Axes>& to, const Vec<V, Axes>& what,
                                                 Scalar<V> s) {
    to = to + what * V(s);
}

/// The larger number; NaN if either is NaN.
template <std::floating_point T>
[[nodiscard]] constexpr T larger(T a, T b) {
    return b > a || b != b ? b : a;
}

/// The largest |coordinate|; NaN if any is NaN.
template <std::floating_point T, int Axes>
[[nodiscard]] [[gnu::always_inline]] inline T largest(const Vec<T, Axes>& a) {
    T size = 0;
    for (const T& number : a.axis) size = larger(size, std::abs(number));
    return size;
}

/// a/b; 0 if b is 0.
template <std::floating_point T>
[[gnu::always_inline]] constexpr T quotient_or_zero(T a, T b) {
    return b == 0 ? T(0) : a / b;
}

/// a/b; 0 if a is 0, whatever b is.
template <std::floating_point T>
[[gnu::always_inline]] constexpr T quotient_of_nonzero(T a, T b) {
    return a == 0 ? T(0) : a / b;
}

/// `value` if a > limit; otherwise 0.
template <std::floating_point T>
[[gnu::always_inline]] constexpr T value_above(T value, T a, T limit) {
    return a > limit ? value : T(0);
}

template <std::floating_point T>
[[nodiscard]] bool is_finite(T number) {
    return std::isfinite(number);
}

template <std::floating_point T>
[[nodiscard]] bool any_positive(T number) {
    return number > 0;
}

/// Whether 0 < |v| < limit.
template <std::floating_point T>
[[nodiscard]] bool any_nonzero_below(T v, T limit) {
    return std::abs(v) < limit && v != 0;
}

/// `instead` if 0 < |v| < limit, all |sizes| < limit and rate > 0; otherwise `value`.
template <std::floating_point T, class... Sizes>
[[nodiscard]] T replace_where_sleeping(T value, T instead, T rate, T limit, T v, Sizes... sizes) {
    const bool slow = (any_nonzero_below(v, limit) && ... && (std::abs(sizes) < limit));
    return slow && rate > 0 ? instead : value;
}

/// A vector in another precision and number of axes; 0 on axes that `from` lacks.
template <class To, class V, int Axes>
[[nodiscard]] To converted(const Vec<V, Axes>& from) {
    To to{};
    for (std::size_t i = 0; i < std::min(to.axis.size(), from.axis.size()); ++i)
        to.axis[i] = static_cast<std::decay_t<decltype(to.axis[i])>>(from.axis[i]);
    return to;
}

}  // namespace oiler
