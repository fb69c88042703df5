// SPDX-License-Identifier: MIT
#include "trap/oscillator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oiler::trap {
namespace {

/// The position after t s from the coefficients of its Taylor series: u(0), u'(0), …
struct Series {
    Real x = 0;
    Real v = 0;
};

/// For k·t² + c·t < 1, where the closed forms cancel.
Series series(Real k, Real c, Real f, Real u0, Real v0, Real t) {
    constexpr int terms = 28;
    std::array<Real, terms> a{u0, v0};
    for (int n = 0; n + 2 < terms; ++n) {
        const auto m = static_cast<Real>(n);
        a[n + 2] = ((n == 0 ? f : 0) - c * (m + 1) * a[n + 1] - k * a[n]) / ((m + 1) * (m + 2));
    }
    Series sum;
    for (int n = terms - 1; n >= 0; --n) {
        sum.x = sum.x * t + a[n];
        if (n > 0) sum.v = sum.v * t + static_cast<Real>(n) * a[n];
    }
    return sum;
}

Flow short_flow(Real k, Real c, Real t) {
    const Series from_x = series(k, c, 0, 1, 0, t);
    const Series from_v = series(k, c, 0, 0, 1, t);
    return {from_x.x, from_v.x, series(k, c, 1, 0, 0, t).x, from_x.v, from_v.v};
}

Flow dragged(Real c, Real t) {
    const Real xv = -std::expm1(-c * t) / c;
    return {1, xv, (t - xv) / c, 0, std::exp(-c * t)};
}

Flow underdamped(Real k, Real gamma, Real w, Real t) {
    const Real decay = std::exp(-gamma * t);
    const Real xv = decay * (w > 0 ? std::sin(w * t) / w : t);
    const Real cosine = decay * std::cos(w * t);
    const Real xx = cosine + gamma * xv;
    return {xx, xv, (1 - xx) / k, -k * xv, cosine - gamma * xv};
}

/// With the rates slow = γ − s and fast = γ + s.
Flow overdamped(Real k, Real gamma, Real s, Real t) {
    const Real slow = k / (gamma + s);
    const Real fast = gamma + s;
    const Real decay = std::exp(-slow * t);
    const Real xv = decay * -std::expm1(-2 * s * t) / (2 * s);
    const Real xf = (-std::expm1(-slow * t) / slow - xv) / fast;
    return {decay + slow * xv, xv, xf, -k * xv, decay - fast * xv};
}

}  // namespace

Flow flow(Real k, Real c, Real t) {
    if (k * t * t + c * t < 1) return short_flow(k, c, t);
    if (k == 0) return dragged(c, t);
    const Real gamma = c / 2;
    const Real discriminant = gamma * gamma - k;
    if (discriminant <= 0) return underdamped(k, gamma, std::sqrt(-discriminant), t);
    return overdamped(k, gamma, std::sqrt(discriminant), t);
}

void Oscillators::add(const OscillatorBody& body) {
    const auto [entry, is_new] = known_.try_emplace({body.k, body.c}, kinds_.size());
    if (is_new) kinds_.push_back({body.k, body.c});
    bodies_.push_back(body);
    kind_of_.push_back(entry->second);
}

Real Oscillators::shortest_period() const {
    Real shortest = std::numeric_limits<Real>::infinity();
    for (const Kind& kind : kinds_)
        if (kind.k > 0) shortest = std::min(shortest, 2 * std::acos(Real(-1)) / std::sqrt(kind.k));
    return shortest;
}

void Oscillators::prepare(std::int64_t rate, std::size_t inside) {
    rate_ = rate;
    for (Kind& kind : kinds_) {
        kind.inside.resize(inside);
        for (std::size_t j = 0; j < inside; ++j)
            kind.inside[j] =
                flow(kind.k, kind.c, share_of(j + 1, inside) / static_cast<Real>(rate));
    }
}

void Oscillators::sample(std::int64_t n, Point* out) {
    const Real t = static_cast<Real>(n) / static_cast<Real>(rate_);
    for (Kind& kind : kinds_) kind.start = flow(kind.k, kind.c, t);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        sample_body(i, out + i * (kinds_[kind_of_[i]].inside.size() + 1));
}

void Oscillators::sample_body(std::size_t i, Point* out) const {
    const OscillatorBody& body = bodies_[i];
    const Kind& kind = kinds_[kind_of_[i]];
    const Flow& start = kind.start;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Real u0 = body.x[axis] - body.centre[axis];
        const Real f = body.f[axis];
        const Real u = start.xx * u0 + start.xv * body.v[axis] + start.xf * f;
        const Real v = start.vx * u0 + start.vv * body.v[axis] + start.xv * f;
        out[0][axis] = body.centre[axis] + u;
        for (std::size_t j = 0; j < kind.inside.size(); ++j) {
            const Flow& on = kind.inside[j];
            out[j + 1][axis] = body.centre[axis] + on.xx * u + on.xv * v + on.xf * f;
        }
    }
}

}  // namespace oiler::trap
