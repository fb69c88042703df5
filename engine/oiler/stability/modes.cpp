// SPDX-License-Identifier: MIT
// Without vectorisation, Eigen sums in the same order on every target.
#define EIGEN_DONT_VECTORIZE

#include "oiler/stability/modes.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>

#include "oiler/physics/advance.hpp"
#include "oiler/physics/response.hpp"

namespace oiler {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// UnitColumns of positions or velocities, one for each unit state.
struct UnitColumns {
    MatrixXd of;
};

/// The overload that the methods call.
void add_scaled(UnitColumns& to, const UnitColumns& what, double s) { to.of += what.of * s; }

struct UnitStates {
    UnitColumns x;
    UnitColumns v;
};

VectorXd flat(const WeightedVectors& vectors, int axes) {
    VectorXd all(static_cast<Index>(vectors.size()) * axes);
    for (Index i = 0; i < all.size(); ++i)
        all[i] = vectors[static_cast<std::size_t>(i / axes)][static_cast<int>(i % axes)];
    return all;
}

/// The mass-weighted matrix of some couplings, times `scale`.
MatrixXd matrix_of(const Component& component, std::span<const Coupling> couplings, double scale) {
    const auto side = static_cast<Index>(component.freedoms());
    MatrixXd matrix = MatrixXd::Zero(side, side);
    for (Index i = 0; i < side; ++i) {
        WeightedVectors unit(component.rows.size());
        WeightedVectors product(component.rows.size());
        unit[static_cast<std::size_t>(i / component.axes)][static_cast<int>(i % component.axes)] =
            1;
        for (const Coupling& coupling : couplings)
            component.add_product(coupling, unit, scale, product);
        matrix.col(i) = flat(product, component.axes);
    }
    return matrix;
}

VectorXd drag_of(const Component& component, double scale) {
    VectorXd drag(static_cast<Index>(component.freedoms()));
    for (Index i = 0; i < drag.size(); ++i)
        drag[i] = component.drag[static_cast<std::size_t>(i / component.axes)] * scale;
    return drag;
}

/// The exact half-step of one damper is 1 − loss·Q, with a projection Q on its directions.
struct Damp {
    MatrixXd loss;
};

Damp half_step_of(const Component& component, const Coupling& damper, double dt) {
    const MatrixXd rates = matrix_of(component, std::span(&damper, 1), dt);
    double inverse_mass = 0;
    for (const std::size_t end : {damper.a, damper.b})
        if (end != Coupling::ground)
            inverse_mass += component.inverse_root_mass[end] * component.inverse_root_mass[end];
    const double rate = (damper.along + damper.all) * inverse_mass * dt;
    return {rates * (-std::expm1(-rate / 2) / rate)};
}

/// The linear motion that a method steps, with dt = 1.
class LinearPhysics {
public:
    LinearPhysics(const Component& component, Damping damping, double dt)
        : stiffness_(matrix_of(component, component.springs, dt * dt)),
          rates_(matrix_of(component, component.dampers, dt)),
          drag_(drag_of(component, dt)),
          damping_(damping) {
        rates_ += drag_.asDiagonal().toDenseMatrix();
        if (damping == Damping::in_kick) return;
        for (const Coupling& damper : component.dampers)
            damps_.push_back(half_step_of(component, damper, dt));
    }

    [[nodiscard]] UnitColumns accelerate(const UnitStates& state, double) const {
        return {-(stiffness_ * state.x.of) - rates_ * state.v.of};
    }
    [[nodiscard]] UnitColumns kick(const UnitStates& state, double t) const {
        if (damping_ == Damping::in_kick) return accelerate(state, t);
        return {-(stiffness_ * state.x.of)};
    }
    void drift(UnitStates& state, std::size_t, double tau) const {
        if (damping_ == Damping::in_kick) return add_scaled(state.x, state.v, tau);
        for (Index i = 0; i < drag_.size(); ++i) {
            const auto response = oscillator_response<double>(0, drag_[i], tau);
            state.x.of.row(i) += state.v.of.row(i) * response.reach;
            state.v.of.row(i) *= response.decay;
        }
    }
    void damp_before(UnitStates& state) const {
        for (const Damp& damp : damps_) state.v.of -= (damp.loss * state.v.of).eval();
    }
    void damp_after(UnitStates& state) const {
        for (std::size_t i = damps_.size(); i-- > 0;)
            state.v.of -= (damps_[i].loss * state.v.of).eval();
    }

private:
    MatrixXd stiffness_;
    MatrixXd rates_;
    VectorXd drag_;
    Damping damping_;
    std::vector<Damp> damps_;
};

Mode mode_of(const Eigen::SelfAdjointEigenSolver<MatrixXd>& solver, Index i) {
    const VectorXd vector = solver.eigenvectors().col(i);
    return {solver.eigenvalues()[i], {vector.begin(), vector.end()}};
}

constexpr std::size_t fewest_iterations = 32;
constexpr std::size_t most_iterations_of_lanczos = 128;
constexpr double wanted_residual = 0.02;
constexpr double breakdown = 1e-12;

void add_multiple(WeightedVectors& to, const WeightedVectors& what, double s) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = to[i] + what[i] * s;
}
void scale(WeightedVectors& vectors, double s) {
    for (Vec3& vector : vectors) vector = vector * s;
}

/// Lanczos' three-term recurrence. It repeats to the bit, so that a second pass sums the vector
/// without storing the basis.
class Recurrence {
public:
    Recurrence(const Component& component, const MatrixSum& sum)
        : component_(component), sum_(sum), before_(component.rows.size()) {
        std::mt19937_64 random(1);
        for (std::size_t i = 0; i < before_.size(); ++i) {
            Vec3 start{};
            for (int axis = 0; axis < component.axes; ++axis)
                start[axis] = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
            basis_.push_back(start);
        }
        scale(basis_, 1 / std::sqrt(inner(basis_, basis_)));
    }

    [[nodiscard]] const WeightedVectors& basis() const { return basis_; }
    [[nodiscard]] double diagonal() const { return diagonal_; }
    [[nodiscard]] double beside() const { return beside_; }

    /// Computes the next coefficients; `advance` then moves to the next vector.
    void multiply() {
        next_ = product(component_, sum_, basis_);
        diagonal_ = inner(next_, basis_);
        add_multiple(next_, basis_, -diagonal_);
        add_multiple(next_, before_, -beside_);
        beside_ = std::sqrt(inner(next_, next_));
    }
    void advance() {
        before_.swap(basis_);
        basis_.swap(next_);
        scale(basis_, 1 / beside_);
    }

private:
    const Component& component_;
    MatrixSum sum_;
    WeightedVectors before_;
    WeightedVectors basis_{};
    WeightedVectors next_{};
    double diagonal_ = 0;
    double beside_ = 0;
};

WeightedVectors vector_of(const Component& component, const MatrixSum& sum,
                          const std::vector<double>& weights) {
    WeightedVectors vector(component.rows.size());
    Recurrence recurrence(component, sum);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (i > 0) recurrence.advance();
        add_multiple(vector, recurrence.basis(), weights[i]);
        recurrence.multiply();
    }
    scale(vector, 1 / std::sqrt(inner(vector, vector)));
    return vector;
}

}  // namespace

double inner(const WeightedVectors& a, const WeightedVectors& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
    return sum;
}

WeightedVectors to_vectors(const std::vector<double>& numbers, const Component& component) {
    WeightedVectors vectors(component.rows.size());
    const auto axes = static_cast<std::size_t>(component.axes);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        vectors[i / axes][static_cast<int>(i % axes)] = numbers[i];
    return vectors;
}

std::vector<Mode> stiffness_modes(const Component& component) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(
        matrix_of(component, component.springs, 1));
    std::vector<Mode> modes;
    for (Index i = 0; i < solver.eigenvalues().size(); ++i) modes.push_back(mode_of(solver, i));
    return modes;
}

Mode fastest_damping(const Component& component, bool dampers_split) {
    MatrixXd rates = drag_of(component, 1).asDiagonal();
    if (!dampers_split) rates += matrix_of(component, component.dampers, 1);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(rates);
    return mode_of(solver, rates.rows() - 1);
}

Mode highest_mode(const std::vector<double>& diagonal, const std::vector<double>& beside) {
    const auto size = static_cast<Index>(diagonal.size());
    MatrixXd matrix = MatrixXd::Zero(size, size);
    matrix.diagonal() = Eigen::Map<const VectorXd>(diagonal.data(), size);
    matrix.diagonal(-1) = Eigen::Map<const VectorXd>(beside.data(), size - 1);
    // computeFromTridiagonal does not converge, and does not sort, if a number beside the diagonal
    // is of the size of round-off.
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(matrix);
    return mode_of(solver, size - 1);
}

double spectral_radius_of_step(const Component& component, const Method& method, Damping damping,
                               double dt) {
    LinearPhysics physics(component, damping, dt);
    const auto side = static_cast<Index>(component.freedoms());
    UnitStates state{{MatrixXd::Identity(side, 2 * side)}, {MatrixXd::Zero(side, 2 * side)}};
    state.v.of.rightCols(side).setIdentity();
    std::visit(
        [&]<class Rule>(const Rule& rule) {
            if constexpr (SplitsSteps<Rule> || IsTableau<Rule>) advance(rule, state, physics, 0);
        },
        make_plan<double>(method, 1, damping));
    MatrixXd step(2 * side, 2 * side);
    step << state.x.of, state.v.of;
    if (!step.allFinite()) return std::numeric_limits<double>::infinity();
    return Eigen::EigenSolver<MatrixXd>(step, false).eigenvalues().cwiseAbs().maxCoeff();
}

WeightedVectors product(const Component& component, const MatrixSum& sum,
                        const WeightedVectors& u) {
    WeightedVectors result(u.size());
    if (sum.stiffness != 0)
        for (const Coupling& spring : component.springs)
            component.add_product(spring, u, sum.stiffness, result);
    if (sum.damping == 0) return result;
    for (std::size_t i = 0; i < u.size(); ++i)
        result[i] = result[i] + u[i] * (component.drag[i] * sum.damping);
    if (!sum.dampers_split)
        for (const Coupling& damper : component.dampers)
            component.add_product(damper, u, sum.damping, result);
    return result;
}

double quotient(const Component& component, const MatrixSum& sum, const WeightedVectors& u) {
    return inner(u, product(component, sum, u));
}

RitzPair highest_ritz_pair(const Component& component, const MatrixSum& sum) {
    Recurrence recurrence(component, sum);
    std::vector<double> diagonal;
    std::vector<double> beside;
    const std::size_t most = std::min(most_iterations_of_lanczos, component.freedoms());
    Mode highest{};
    double residual = 0;
    while (diagonal.size() < most) {
        if (!diagonal.empty()) recurrence.advance();
        recurrence.multiply();
        diagonal.push_back(recurrence.diagonal());
        beside.push_back(recurrence.beside());
        // The vectors so far span all that the matrix can reach from the start.
        const bool is_whole = !(beside.back() > breakdown * std::abs(diagonal.front()));
        const bool is_last = diagonal.size() == most || is_whole;
        if (!is_last && diagonal.size() % fewest_iterations != 0) continue;
        highest = highest_mode(diagonal, beside);
        residual = std::abs(beside.back() * highest.vector.back());
        if (is_last || residual <= wanted_residual * std::abs(highest.value)) break;
    }
    return {highest.value, residual, vector_of(component, sum, highest.vector)};
}

}  // namespace oiler
