// SPDX-License-Identifier: MIT
#pragma once

#include "trap/motion.hpp"

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

}  // namespace oiler::trap
