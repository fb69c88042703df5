// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>

#include "oiler/sim/bodies.hpp"
#include "trap/system.hpp"

namespace oiler::trap {

/// A body on an ellipse around one attractor, in closed form.
class Orbit : public Motion {
public:
    /// Throws std::domain_error if the orbit is not an ellipse.
    Orbit(const Point& centre, Real gm, const Point& x, const Point& v);

    [[nodiscard]] std::size_t size() const override { return 1; }
    [[nodiscard]] Real shortest_period() const override;
    [[nodiscard]] Real cost() const override { return 20; }
    void prepare(std::int64_t rate, std::size_t inside) override;
    void sample(std::int64_t n, Point* out) override;

    [[nodiscard]] Point at(Real t) const;
    [[nodiscard]] Real period() const { return period_; }

private:
    [[nodiscard]] Real turned(Real mean) const;

    Point centre_;
    Point d_;  ///< from the centre to the start
    Point v_;
    Real gm_;
    Real a_ = 0;       ///< semi-major axis, m
    Real e_ = 0;       ///< eccentricity
    Real e_cos_ = 0;   ///< e·cos E of the start
    Real e_sin_ = 0;   ///< e·sin E of the start
    Real period_ = 0;  ///< s
    std::int64_t rate_ = 1;
    std::size_t inside_ = 0;
};

/// The solution of u'' = f − c·u' − k·u: u(t) = xx·u(0) + xv·u'(0) + xf·f, and
/// u'(t) = vx·u(0) + vv·u'(0) + xv·f.
struct Flow {
    Real xx = 1;
    Real xv = 0;
    Real xf = 0;
    Real vx = 0;
    Real vv = 1;
};

/// k ≥ 0 in 1/s², c ≥ 0 in 1/s, t ≥ 0 in s: free, drag, under-, over- and critically damped.
[[nodiscard]] Flow flow(Real k, Real c, Real t);

/// A body on springs without rest length, with linear drag and gravity.
struct OscillatorBody {
    Real k = 0;      ///< 1/s², of all springs
    Real c = 0;      ///< 1/s, of dampers and drag
    Point centre{};  ///< m, where the springs balance
    Point f{};       ///< m/s²
    Point x{};       ///< m, at the start
    Point v{};       ///< m/s, at the start
};

/// Bodies that do not act on one another, each in closed form.
class Oscillators : public Motion {
public:
    void add(const OscillatorBody& body);

    [[nodiscard]] std::size_t size() const override { return bodies_.size(); }
    [[nodiscard]] Real shortest_period() const override;
    [[nodiscard]] Real cost() const override { return 1; }
    void prepare(std::int64_t rate, std::size_t inside) override;
    void sample(std::int64_t n, Point* out) override;

private:
    /// Bodies with equal k and c share their flows.
    struct Kind {
        Real k = 0;
        Real c = 0;
        Flow start{};                ///< from the start to the tick
        std::vector<Flow> inside{};  ///< from the tick to each sample
    };
    void sample_body(std::size_t i, Point* out) const;

    std::vector<OscillatorBody> bodies_;
    std::vector<std::size_t> kind_of_;
    std::vector<Kind> kinds_;
    std::map<std::pair<Real, Real>, std::size_t> known_;
    std::int64_t rate_ = 1;
};

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
