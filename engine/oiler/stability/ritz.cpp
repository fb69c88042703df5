// SPDX-License-Identifier: MIT
#include "oiler/stability/ritz.hpp"

#include <cmath>
#include <random>

#include "oiler/stability/dense.hpp"

namespace oiler {
namespace {

constexpr std::size_t fewest_iterations = 32;
constexpr std::size_t most_iterations_of_lanczos = 128;
constexpr double wanted_residual = 0.02;
constexpr double breakdown = 1e-12;

double inner(const WeightedVectors& a, const WeightedVectors& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
    return sum;
}
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
        // The vectors so far are all that the matrix makes of the start.
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
