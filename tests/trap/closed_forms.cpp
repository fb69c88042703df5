// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "oiler/sim/bodies.hpp"
#include "trap/truth.hpp"

namespace oiler::trap {
namespace {

const Real pi = std::acos(Real(-1));

Real dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

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

constexpr Eigen::Index axes = 3;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

bool System::is_linear() const {
    return attractors.empty() && !has_contacts() &&
           std::ranges::all_of(springs, [](const auto& one) { return one.rest_length == 0; }) &&
           std::ranges::all_of(bodies, [](const auto& one) {
               return one.quadratic_drag == 0 && one.winds.empty() && one.drives.empty();
           });
}

bool System::has_contacts() const {
    return !surfaces.empty() &&
           std::ranges::any_of(bodies, [](const auto& one) { return one.contact.has_value(); });
}

Real System::shortest_spring_period() const {
    std::vector<Real> stiffness(bodies.size(), 0);
    for (const CoupledSpring& spring : springs) {
        stiffness[spring.body] += spring.to ? 2 * spring.stiffness : spring.stiffness;
        if (spring.to) stiffness[*spring.to] += 2 * spring.stiffness;
    }
    // Gershgorin's circles bound the squares of the frequencies.
    Real largest = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        largest = std::max(largest, stiffness[i] / bodies[i].mass);
    if (largest == 0) return std::numeric_limits<Real>::infinity();
    return 2 * std::acos(Real(-1)) / std::sqrt(largest);
}

Orbit::Orbit(const Point& centre, Real gm, const Point& x, const Point& v)
    : centre_(centre), v_(v) {
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

Matrix exponential(const Matrix& a) {
    const Real norm = a.cwiseAbs().rowwise().sum().maxCoeff();
    const int squarings = norm > 0.5L ? std::max(0, std::ilogb(norm) + 2) : 0;
    const Matrix scaled = a * std::ldexp(Real(1), -squarings);
    // exp(a) − 1: squaring it keeps the digits of small motions.
    Matrix term = scaled;
    Matrix sum = scaled;
    for (int n = 2; n <= 18; ++n) {
        term = (term * scaled / static_cast<Real>(n)).eval();
        sum += term;
    }
    for (int i = 0; i < squarings; ++i) sum = (2 * sum + sum * sum).eval();
    return sum + Matrix::Identity(a.rows(), a.cols());
}

LinearSystem::LinearSystem(const System& system)
    : bodies_(system.bodies.size()), shortest_period_(system.shortest_spring_period()) {
    scale_ = std::isfinite(shortest_period_) ? 2 * pi / shortest_period_ : 1;
    const Eigen::Index n = index(bodies_);
    a_ = Matrix::Zero(2 * n + axes, 2 * n + axes);
    start_ = Matrix::Zero(2 * n + axes, axes);
    start_.bottomRows(axes).setIdentity();
    for (Eigen::Index i = 0; i < n; ++i) {
        const CoupledBody& body = system.bodies[static_cast<std::size_t>(i)];
        a_(i, n + i) = scale_;
        a_(n + i, n + i) -= body.drag / body.mass;
        for (Eigen::Index axis = 0; axis < axes; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            start_(i, axis) = scale_ * body.x[k];
            start_(n + i, axis) = body.v[k];
            a_(n + i, 2 * n + axis) += system.gravity[k];
        }
    }
    add_springs(system);
}

void LinearSystem::add_springs(const System& system) {
    const Eigen::Index n = index(bodies_);
    // The pull on row i from the position of row j, or on itself.
    const auto pull = [&](Eigen::Index i, Eigen::Index j, const CoupledSpring& spring, Real sign) {
        const Real mass = system.bodies[static_cast<std::size_t>(i)].mass;
        a_(n + i, j) += sign * spring.stiffness / mass / scale_;
        a_(n + i, n + j) += sign * spring.damping / mass;
    };
    for (const CoupledSpring& spring : system.springs) {
        const Eigen::Index i = index(spring.body);
        pull(i, i, spring, -1);
        if (spring.to) {
            const Eigen::Index j = index(*spring.to);
            pull(j, j, spring, -1);
            pull(i, j, spring, 1);
            pull(j, i, spring, 1);
        } else {
            for (Eigen::Index axis = 0; axis < axes; ++axis)
                a_(n + i, 2 * n + axis) += spring.stiffness / system.bodies[spring.body].mass *
                                           spring.anchor[static_cast<std::size_t>(axis)];
        }
    }
}

Real LinearSystem::cost() const { return static_cast<Real>(bodies_ + 2); }

void LinearSystem::prepare(std::int64_t rate, std::size_t inside) {
    rate_ = rate;
    inside_ = inside;
    state_ = start_;
    tick_ = 0;
    jumps_.clear();
    if (inside == 0) return;
    const Matrix sample_step = a_ / (static_cast<Real>(rate) * static_cast<Real>(inside));
    to_first_ = exponential(sample_step * first_sample);
    between_ = exponential(sample_step);
}

void LinearSystem::jump_to(std::int64_t n) {
    for (int power = 0; tick_ < n; ++power) {
        const std::int64_t size = std::int64_t{1} << power;
        if (((n - tick_) & size) == 0) continue;
        Matrix& jump = jumps_[power];
        if (jump.size() == 0)
            jump = exponential(a_ * (static_cast<Real>(size) / static_cast<Real>(rate_)));
        state_ = (jump * state_).eval();
        tick_ += size;
    }
}

void LinearSystem::write(const Matrix& state, Point* out, std::size_t stride) const {
    for (std::size_t i = 0; i < bodies_; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            out[i * stride][axis] = state(index(i), index(axis)) / scale_;
}

void LinearSystem::sample(std::int64_t n, Point* out) {
    jump_to(n);
    write(state_, out, inside_ + 1);
    Matrix state = state_;
    for (std::size_t j = 0; j < inside_; ++j) {
        state = ((j == 0 ? to_first_ : between_) * state).eval();
        write(state, out + j + 1, inside_ + 1);
    }
}

}  // namespace oiler::trap
