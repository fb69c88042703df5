// SPDX-License-Identifier: MIT
#include "trap/kepler.hpp"

#include <cmath>
#include <stdexcept>

namespace oiler::trap {
namespace {

const Real pi = std::acos(Real(-1));

Real dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

Orbit::Orbit(const Point& centre, Real gm, const Point& x, const Point& v)
    : centre_(centre), v_(v), gm_(gm) {
    for (std::size_t axis = 0; axis < 3; ++axis) d_[axis] = x[axis] - centre[axis];
    const Real r = std::sqrt(dot(d_, d_));
    a_ = 1 / (2 / r - dot(v, v) / gm);
    e_cos_ = 1 - r / a_;
    e_sin_ = dot(d_, v) / std::sqrt(gm * std::abs(a_));
    e_ = std::hypot(e_cos_, e_sin_);
    if (!(a_ > 0) || e_ >= 1) throw std::domain_error("the orbit is not an ellipse");
    period_ = 2 * pi * std::sqrt(a_ * a_ * a_ / gm);
}

/// The period of a circle through the perihelion.
Real Orbit::shortest_period() const { return period_ * std::pow(1 - e_, Real(1.5)); }

/// Solves Kepler's equation from the start, mean = x − e_cos·sin x + e_sin·(1 − cos x), for mean in
/// [0, 2π]: Newton's method within a shrinking bracket.
Real Orbit::turned(Real mean) const {
    Real low = mean - 2 * e_;
    Real high = mean + 2 * e_;
    Real x = mean;
    for (int i = 0; i < 200; ++i) {
        const Real sine = std::sin(x);
        const Real cosine = std::cos(x);
        const Real excess = x - e_cos_ * sine + e_sin_ * (1 - cosine) - mean;
        (excess > 0 ? high : low) = x;
        Real next = x - excess / (1 - e_cos_ * cosine + e_sin_ * sine);
        if (!(next >= low && next <= high)) next = (low + high) / 2;
        if (std::abs(next - x) <= 2e-19L * (1 + std::abs(x))) return next;
        x = next;
    }
    return x;
}

Point Orbit::at(Real t) const {
    t = std::fmod(t, period_);
    const Real x = turned(2 * pi * t / period_);
    const Real r = std::sqrt(dot(d_, d_));
    const Real half = std::sin(x / 2);
    const Real f = 1 - 2 * a_ / r * half * half;
    const Real g = t - period_ / (2 * pi) * (x - std::sin(x));
    Point point;
    for (std::size_t axis = 0; axis < 3; ++axis)
        point[axis] = centre_[axis] + f * d_[axis] + g * v_[axis];
    return point;
}

void Orbit::prepare(std::int64_t rate, std::size_t inside) {
    rate_ = rate;
    inside_ = inside;
}

void Orbit::sample(std::int64_t n, Point* out) {
    const auto rate = static_cast<Real>(rate_);
    for (std::size_t j = 0; j <= inside_; ++j)
        out[j] = at((static_cast<Real>(n) + share_of(j, inside_)) / rate);
}

}  // namespace oiler::trap
