// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/bodies.hpp"
#include "trap/system.hpp"

namespace oiler::trap {

/// Integrates a system by collocation at Chebyshev's nodes, in segments whose length follows the
/// last coefficients of the accelerations. The positions are polynomials in each segment.
class Integration : public Motion {
public:
    /// `tolerance` is relative to the distance travelled in a segment. Throws std::domain_error if
    /// the motion needs more than `most_segments`.
    Integration(const System& system, Real duration, Real tolerance, std::size_t most_segments);

    [[nodiscard]] std::size_t size() const override { return system_.bodies.size(); }
    [[nodiscard]] Real shortest_period() const override { return shortest_; }
    [[nodiscard]] Real cost() const override { return 12; }
    [[nodiscard]] Real uncertainty() const override { return uncertainty_; }
    void prepare(std::int64_t rate, std::size_t inside) override;
    void sample(std::int64_t n, Point* out) override;

    /// `t` must be within the duration.
    void positions(Real t, Point* out, std::size_t stride = 1) const;
    /// Compares with another integration of the system at many times.
    void compare_with(const Integration& other);

private:
    using Numbers = std::vector<Real>;
    struct Segment {
        Real start = 0;       ///< s
        Real length = 0;      ///< s
        Numbers positions{};  ///< Chebyshev coefficients, coordinate by coordinate
    };
    struct Nodes;

    void accelerate(const Real* x, const Real* v, Real* a) const;
    void pull(const CoupledSpring& spring, const Real* x, const Real* v, Real* a) const;
    static void attract(const Attractor& one, const Real* x, Real* a);
    void move(Real h, Nodes& at) const;
    [[nodiscard]] Real update(Nodes& at) const;
    [[nodiscard]] bool converge(Real h, Nodes& at) const;
    [[nodiscard]] Real error_of(Real h, const Nodes& at) const;
    void append(Real h, Nodes& at);

    System system_;
    Real duration_;
    std::vector<Segment> segments_;
    Real shortest_ = 0;
    Real uncertainty_ = 0;
    std::int64_t rate_ = 1;
    std::size_t inside_ = 0;
};

}  // namespace oiler::trap
