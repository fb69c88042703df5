// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <utility>

#include "trap/motion.hpp"

namespace oiler::trap {

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

}  // namespace oiler::trap
