// SPDX-License-Identifier: MIT
#include "trap/integration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

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

namespace {

constexpr std::size_t nodes = Chebyshev::nodes;

Real dot(const Real* a, const Real* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Real length(const Real* d) { return std::sqrt(dot(d, d)); }

}  // namespace

Integration::Integration(const System& system, Real duration, Real tolerance,
                         std::size_t most_segments)
    : system_(system), bearings_(system.bodies.size()), duration_(duration), shortest_(duration) {
    Nodes at(3 * system.bodies.size());
    for (std::size_t i = 0; i < at.width; ++i) {
        at.x[i] = system.bodies[i / 3].x[i % 3];
        at.v[i] = system.bodies[i / 3].v[i % 3];
    }
    if (system.has_contacts())
        for (std::size_t i = 0; i < system.bodies.size(); ++i) start_on_surface(i, at);
    Real h = std::min(duration, system.shortest_spring_period() / 2);
    if (system.has_contacts()) h = std::min(h, duration / 64);
    for (const Surface& one : system.surfaces)
        if (one.omega > 0) h = std::min(h, 1 / one.omega);
    const Real longest = h;
    while (now_ < duration) {
        const bool converged = converge(h, at);
        const Real error = converged ? error_of(h, at) / tolerance : 1e10L;
        const Real factor =
            error > 0 ? std::pow(error, Real(-1) / static_cast<Real>(Chebyshev::degree)) : 2;
        if (error <= 1) {
            append(h, at);
            if (!system.has_contacts() || !meet_first(h, at)) go_on(h, at);
            shortest_ = std::min(shortest_, 1.5L * h);
        }
        // The last segment may end after the duration.
        h *= std::clamp(0.9L * factor, 0.3L, 2.0L);
        if (system.has_contacts()) h = std::min(h, longest);
        if (segments_.size() > most_segments || h < 1e-15L * duration)
            throw std::domain_error("the motion needs too many segments");
    }
}

/// The positions and velocities at the nodes from the accelerations.
void Integration::move(Real h, Nodes& at) const {
    const Chebyshev& rule = Chebyshev::get();
    const Real half = h / 2;
    for (std::size_t i = 1; i < nodes; ++i)
        for (std::size_t c = 0; c < at.width; ++c) {
            Real once = 0;
            Real twice = 0;
            for (std::size_t j = 0; j < nodes; ++j) {
                once += rule.once[i][j] * at.a[j * at.width + c];
                twice += rule.twice[i][j] * at.a[j * at.width + c];
            }
            at.v[i * at.width + c] = at.v[c] + half * once;
            at.x[i * at.width + c] = at.x[c] + half * ((1 + rule.at[i]) * at.v[c] + half * twice);
        }
}

/// The accelerations at the nodes; returns the largest change relative to the largest of them.
Real Integration::update(Real h, Nodes& at) const {
    Real change = 0;
    Real size = 0;
    Numbers a(at.width);
    for (std::size_t i = 1; i < nodes; ++i) {
        const Real t = now_ + h * (1 + Chebyshev::get().at[i]) / 2;
        accelerate_on_surfaces(&at.x[i * at.width], &at.v[i * at.width], t, a.data());
        for (std::size_t c = 0; c < at.width; ++c) {
            change = std::max(change, std::abs(a[c] - at.a[i * at.width + c]));
            size = std::max(size, std::abs(a[c]));
            if (!std::isfinite(a[c])) return std::numeric_limits<Real>::infinity();
        }
        std::ranges::copy(a, &at.a[i * at.width]);
    }
    return size > 0 ? change / size : 0;
}

/// Iterates from the state at the first node to the accelerations at all nodes.
bool Integration::converge(Real h, Nodes& at) const {
    accelerate_on_surfaces(at.x.data(), at.v.data(), now_, at.a.data());
    for (std::size_t i = 1; i < nodes; ++i) std::copy_n(at.a.data(), at.width, &at.a[i * at.width]);
    Real last = std::numeric_limits<Real>::infinity();
    for (int round = 0; round < 60; ++round) {
        move(h, at);
        const Real change = update(h, at);
        if (!std::isfinite(change)) return false;
        // Below the round-off of long double, or no longer decreasing close to it.
        if (change <= 4e-19L || (change <= 1e-16L && change >= last)) return true;
        last = change;
    }
    return false;
}

/// The largest share of the last coefficients in a displacement.
Real Integration::error_of(Real h, const Nodes& at) const {
    const Chebyshev& rule = Chebyshev::get();
    Real tail = 0;
    Real moved = 0;
    for (std::size_t c = 0; c < at.width; ++c) {
        for (const std::size_t n : {Chebyshev::degree - 1, Chebyshev::degree}) {
            Real coefficient = 0;
            for (std::size_t j = 0; j < nodes; ++j)
                coefficient += rule.transform[n][j] * at.a[j * at.width + c];
            tail = std::max(tail, std::abs(coefficient) * h * h / 4);
        }
        for (std::size_t i = 1; i < nodes; ++i)
            moved = std::max(moved, std::abs(at.x[i * at.width + c] - at.x[c]));
    }
    return tail == 0 ? 0 : tail / moved;
}

/// Keeps the segment.
void Integration::append(Real h, const Nodes& at) {
    const Chebyshev& rule = Chebyshev::get();
    const Real half = h / 2;
    Segment segment{now_, h, Numbers(at.width * Chebyshev::coefficients)};
    for (std::size_t c = 0; c < at.width; ++c) {
        Real* const series = &segment.positions[c * Chebyshev::coefficients];
        for (std::size_t n = 0; n < Chebyshev::coefficients; ++n) {
            for (std::size_t j = 0; j < nodes; ++j)
                series[n] += rule.position[n][j] * at.a[j * at.width + c];
            series[n] *= half * half;
        }
        series[0] += at.x[c] + half * at.v[c];
        series[1] += half * at.v[c];
    }
    segments_.push_back(std::move(segment));
}

/// Moves the start to the end of the segment.
void Integration::go_on(Real h, Nodes& at) {
    const std::size_t last = (nodes - 1) * at.width;
    std::copy_n(&at.x[last], at.width, at.x.data());
    std::copy_n(&at.v[last], at.width, at.v.data());
    now_ += h;
}

void Integration::accelerate(const Real* x, const Real* v, Real t, Real* a) const {
    for (std::size_t i = 0; i < system_.bodies.size(); ++i) {
        const CoupledBody& body = system_.bodies[i];
        const Real speed = length(v + 3 * i);
        const Real drag = (body.drag + body.quadratic_drag * speed) / body.mass;
        for (std::size_t axis = 0; axis < 3; ++axis)
            a[3 * i + axis] = system_.gravity[axis] - drag * v[3 * i + axis];
        for (const Attractor& one : system_.attractors) attract(one, x + 3 * i, a + 3 * i);
        for (const Wind& one : body.winds) blow(one, body.mass, v + 3 * i, a + 3 * i);
        for (const Drive& one : body.drives)
            for (std::size_t axis = 0; axis < 3; ++axis)
                a[3 * i + axis] +=
                    one.amplitude[axis] / body.mass * std::sin(one.omega * t + one.phase);
    }
    for (const CoupledSpring& spring : system_.springs) pull(spring, x, v, a);
}

void Integration::blow(const Wind& wind, Real mass, const Real* v, Real* a) {
    Point u;
    for (std::size_t axis = 0; axis < 3; ++axis) u[axis] = v[axis] - wind.velocity[axis];
    const Real speed = length(u.data());
    for (std::size_t axis = 0; axis < 3; ++axis) a[axis] -= wind.drag / mass * speed * u[axis];
}

void Integration::attract(const Attractor& one, const Real* x, Real* a) {
    Point d;
    for (std::size_t axis = 0; axis < 3; ++axis) d[axis] = x[axis] - one.centre[axis];
    const Real r = length(d.data());
    for (std::size_t axis = 0; axis < 3; ++axis) a[axis] -= one.gm / (r * r * r) * d[axis];
}

void Integration::pull(const CoupledSpring& spring, const Real* x, const Real* v, Real* a) const {
    Point d;
    Point speed;
    const std::size_t i = 3 * spring.body;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        d[axis] = x[i + axis] - (spring.to ? x[3 * *spring.to + axis] : spring.anchor[axis]);
        speed[axis] = v[i + axis] - (spring.to ? v[3 * *spring.to + axis] : 0);
    }
    const Real r = length(d.data());
    const Real along = (d[0] * speed[0] + d[1] * speed[1] + d[2] * speed[2]) / (r * r);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Real force = -spring.stiffness * d[axis] - spring.damping * speed[axis];
        if (spring.rest_length > 0)
            force = -spring.stiffness * (d[axis] - spring.rest_length * d[axis] / r) -
                    spring.damping * along * d[axis];
        a[i + axis] += force / system_.bodies[spring.body].mass;
        if (spring.to) a[3 * *spring.to + axis] -= force / system_.bodies[*spring.to].mass;
    }
}

void Integration::positions(Real t, Point* out, std::size_t stride) const {
    const auto after =
        std::upper_bound(segments_.begin() + 1, segments_.end(), t,
                         [](Real time, const Segment& segment) { return time < segment.start; });
    const Segment& segment = *(after - 1);
    const Real at = 2 * (t - segment.start) / segment.length - 1;
    for (std::size_t c = 0; c < 3 * size(); ++c)
        out[c / 3 * stride][c % 3] =
            Chebyshev::sum(&segment.positions[c * Chebyshev::coefficients], at);
}

void Integration::compare_with(const Integration& other) {
    std::vector<Point> mine(size());
    std::vector<Point> others(size());
    for (int k = 0; k <= 200; ++k) {
        const Real t = duration_ * static_cast<Real>(k) / 200;
        positions(t, mine.data());
        other.positions(t, others.data());
        for (std::size_t i = 0; i < size(); ++i)
            for (std::size_t axis = 0; axis < 3; ++axis)
                uncertainty_ = std::max(uncertainty_, std::abs(mine[i][axis] - others[i][axis]));
    }
}

void Integration::prepare(std::int64_t rate, std::size_t inside) {
    rate_ = rate;
    inside_ = inside;
}

void Integration::sample(std::int64_t n, Point* out) {
    const auto rate = static_cast<Real>(rate_);
    for (std::size_t j = 0; j <= inside_; ++j) {
        const Real t = (static_cast<Real>(n) + share_of(j, inside_)) / rate;
        // Samples after the duration are not used.
        positions(std::min(t, duration_), out + j, inside_ + 1);
    }
}

}  // namespace oiler::trap
