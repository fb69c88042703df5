// SPDX-License-Identifier: MIT
// Without vectorisation, Eigen sums in the same order on every target.
#define EIGEN_DONT_VECTORIZE

#include "oiler/sim/links/link_solver.hpp"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <limits>

namespace oiler {

template <class T>
struct LinkSolver<T>::Impl {
    using Matrix = Eigen::SparseMatrix<T, Eigen::ColMajor>;
    Eigen::SparseLU<Matrix> factors;
    bool singular = false;
};

template <class T>
LinkSolver<T>::LinkSolver(std::size_t size, const std::vector<MatrixEntry<T>>& entries)
    : impl_(std::make_unique<Impl>()) {
    std::vector<Eigen::Triplet<T>> triplets;
    triplets.reserve(entries.size());
    for (const MatrixEntry<T>& entry : entries)
        triplets.emplace_back(static_cast<int>(entry.row), static_cast<int>(entry.column),
                              entry.value);
    const auto side = static_cast<Eigen::Index>(size);
    typename Impl::Matrix matrix(side, side);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    impl_->factors.compute(matrix);
    impl_->singular = impl_->factors.info() != Eigen::Success;
}

template <class T>
LinkSolver<T>::~LinkSolver() = default;

template <class T>
std::vector<T> LinkSolver<T>::solve(const std::vector<T>& right) const {
    if (impl_->singular) return std::vector<T>(right.size(), std::numeric_limits<T>::quiet_NaN());
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    const Eigen::Map<const Vector> b(right.data(), static_cast<Eigen::Index>(right.size()));
    const Vector x = impl_->factors.solve(b);
    return {x.data(), x.data() + x.size()};
}

template class LinkSolver<float>;
template class LinkSolver<double>;
template class LinkSolver<long double>;

}  // namespace oiler
