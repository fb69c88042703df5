// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <map>

#include "trap/system.hpp"

namespace oiler::trap {

using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// exp(a), by scaling, a Taylor series and squaring.
[[nodiscard]] Matrix exponential(const Matrix& a);

/// Bodies that springs without rest length couple, through the exponential of their matrix.
class LinearSystem : public Motion {
public:
    explicit LinearSystem(const System& system);

    [[nodiscard]] std::size_t size() const override { return bodies_; }
    [[nodiscard]] Real shortest_period() const override { return shortest_period_; }
    [[nodiscard]] Real cost() const override;
    void prepare(std::int64_t rate, std::size_t inside) override;
    void sample(std::int64_t n, Point* out) override;

private:
    void add_springs(const System& system);
    void jump_to(std::int64_t n);
    void write(const Matrix& state, Point* out, std::size_t stride) const;

    std::size_t bodies_;
    Real scale_;            ///< 1/s: positions are stored times it, beside velocities
    Real shortest_period_;  ///< s
    Matrix a_;              ///< of y' = a·y, y = (scale·x, v, 1) with a column per axis
    Matrix start_;
    Matrix state_;  ///< at tick_
    std::int64_t tick_ = 0;
    std::int64_t rate_ = 1;
    std::size_t inside_ = 0;
    std::map<int, Matrix> jumps_;  ///< by 2^key ticks
    Matrix to_first_;              ///< from a tick to its first sample
    Matrix between_;               ///< between samples
};

}  // namespace oiler::trap
