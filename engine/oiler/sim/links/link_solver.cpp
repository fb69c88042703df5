// SPDX-License-Identifier: MIT
// Without vectorisation, Eigen sums in the same order on every target.
#define EIGEN_DONT_VECTORIZE

#include "oiler/sim/links/link_solver.hpp"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <limits>
#include <memory>

namespace oiler {

template <class T>
std::function<std::vector<T>(const std::vector<T>&)> factorised(
    std::size_t size, const std::vector<MatrixEntry<T>>& entries) {
    using Matrix = Eigen::SparseMatrix<T, Eigen::ColMajor>;
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    std::vector<Eigen::Triplet<T>> triplets;
    triplets.reserve(entries.size());
    for (const MatrixEntry<T>& entry : entries)
        triplets.emplace_back(static_cast<int>(entry.row), static_cast<int>(entry.column),
                              entry.value);
    const auto side = static_cast<Eigen::Index>(size);
    Matrix matrix(side, side);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    const auto factors = std::make_shared<Eigen::SparseLU<Matrix>>();
    factors->compute(matrix);
    const bool singular = factors->info() != Eigen::Success;
    return [factors, singular](const std::vector<T>& right) {
        if (singular) return std::vector<T>(right.size(), std::numeric_limits<T>::quiet_NaN());
        const Eigen::Map<const Vector> b(right.data(), static_cast<Eigen::Index>(right.size()));
        const Vector x = factors->solve(b);
        return std::vector<T>(x.data(), x.data() + x.size());
    };
}

template <class T>
using Solve = std::function<std::vector<T>(const std::vector<T>&)>;

template Solve<float> factorised(std::size_t, const std::vector<MatrixEntry<float>>&);
template Solve<double> factorised(std::size_t, const std::vector<MatrixEntry<double>>&);
template Solve<long double> factorised(std::size_t, const std::vector<MatrixEntry<long double>>&);

}  // namespace oiler
