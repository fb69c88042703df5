// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "oiler/sim/body.hpp"
#include "support/test.hpp"

namespace oiler::test {

/// The motion of 1 kg, thrown at `velocity` from the height 0 of the anchor of a rope with `length`
/// 2 m: a free flight, the arc of a damped oscillator while the rope is taut, a free flight.
class Fall {
public:
    static constexpr double g = 9.81;

    Fall(const Link& link, long double velocity) : link_(link), velocity_(velocity) {
        const long double below = link.rest_length;
        taut_ = (velocity + std::sqrt(velocity * velocity + 2 * g * below)) / g;
        speed_ = g * taut_ - velocity;
        // The stretch has left 0, and is negative after three quarters of a period.
        long double before = 1e-3L / omega();
        long double after = 4.7L / omega();
        EXPECT_TRUE(stretch(before)[0] > 0 && stretch(after)[0] < 0);
        while (after - before > 1e-17L) {
            const long double middle = (before + after) / 2;
            (stretch(middle)[0] > 0 ? before : after) = middle;
        }
        slack_ = before;
    }
    /// Height and velocity.
    [[nodiscard]] std::array<long double, 2> at(long double t) const {
        if (t < taut_) return {velocity_ * t - g * t * t / 2, velocity_ - g * t};
        const long double below = link_.rest_length;
        const long double later = t - taut_;
        if (later < slack_) {
            const auto [s, v] = stretch(later);
            return {-below - s, -v};
        }
        const long double up = -stretch(slack_)[1];
        const long double free = later - slack_;
        return {-below + up * free - g * free * free / 2, up - g * free};
    }
    /// When the rope becomes taut and slack, s.
    [[nodiscard]] std::array<double, 2> kinks() const {
        return {static_cast<double>(taut_), static_cast<double>(taut_ + slack_)};
    }

private:
    [[nodiscard]] long double decay() const { return link_.damping / 2.0L; }
    [[nodiscard]] long double omega() const {
        return std::sqrt(link_.stiffness - decay() * decay());
    }
    /// The stretch and its rate.
    [[nodiscard]] std::array<long double, 2> stretch(long double t) const {
        const long double hung = g / static_cast<long double>(link_.stiffness);
        const long double a = -hung;
        const long double b = (speed_ + decay() * a) / omega();
        const long double c = std::cos(omega() * t);
        const long double s = std::sin(omega() * t);
        const long double left = std::exp(-decay() * t);
        return {hung + left * (a * c + b * s),
                left * ((b * omega() - a * decay()) * c - (a * omega() + b * decay()) * s)};
    }

    Link link_;
    long double velocity_, taut_, speed_, slack_;
};

}  // namespace oiler::test
