// SPDX-License-Identifier: MIT
#include "trap/linear.hpp"

#include <algorithm>
#include <cmath>

namespace oiler::trap {
namespace {

constexpr Eigen::Index axes = 3;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

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
    const Real pi = std::acos(Real(-1));
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
