// SPDX-License-Identifier: MIT
#include "trap/chebyshev.hpp"

#include <cmath>

namespace oiler::trap {
namespace {

using Series = std::array<Real, Chebyshev::coefficients>;

/// The integral from −1: that of T_n is T_(n+1)/(2n + 2) − T_(n−1)/(2n − 2).
Series integral(const Series& series) {
    constexpr std::size_t count = Chebyshev::coefficients;
    Series sum{};
    for (std::size_t n = 1; n < count; ++n) {
        const Real before = n == 1 ? 2 * series[0] : series[n - 1];
        const Real after = n + 1 < count ? series[n + 1] : 0;
        sum[n] = (before - after) / static_cast<Real>(2 * n);
    }
    for (std::size_t n = 1; n < count; ++n) sum[0] += n % 2 == 1 ? sum[n] : -sum[n];
    return sum;
}

}  // namespace

Real Chebyshev::sum(const Real* series, Real x) {
    Real next = 0;
    Real after = 0;
    for (std::size_t n = coefficients - 1; n > 0; --n) {
        const Real current = series[n] + 2 * x * next - after;
        after = next;
        next = current;
    }
    return series[0] + x * next - after;
}

Chebyshev::Chebyshev() {
    const Real pi = std::acos(Real(-1));
    const auto ends = [](std::size_t i) { return i == 0 || i == degree ? Real(0.5) : Real(1); };
    for (std::size_t i = 0; i < nodes; ++i)
        at[i] = -std::cos(pi * static_cast<Real>(i) / static_cast<Real>(degree));
    for (std::size_t j = 0; j < nodes; ++j) {
        Series basis{};
        for (std::size_t n = 0; n < nodes; ++n) {
            const Real angle = pi * static_cast<Real>((n * (degree - j)) % (2 * degree)) /
                               static_cast<Real>(degree);
            basis[n] = 2 * ends(n) * ends(j) * std::cos(angle) / static_cast<Real>(degree);
            transform[n][j] = basis[n];
        }
        const Series first = integral(basis);
        const Series second = integral(first);
        for (std::size_t i = 0; i < nodes; ++i) {
            once[i][j] = sum(first.data(), at[i]);
            twice[i][j] = sum(second.data(), at[i]);
        }
        for (std::size_t n = 0; n < coefficients; ++n) position[n][j] = second[n];
    }
}

const Chebyshev& Chebyshev::get() {
    static const Chebyshev one;
    return one;
}

}  // namespace oiler::trap
