// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "oiler/physics/state.hpp"

namespace oiler::lab {

/// The number of references: finer than those of the runs that are compared with them.
using Real = long double;
using Real3 = Vec<Real, 3>;
using State3 = State<Real, 3>;

[[nodiscard]] inline Real3 to_real(const Vec3& v) { return {v[0], v[1], v[2]}; }

[[nodiscard]] inline double distance(const Real3& a, const Real3& b) {
    return static_cast<double>(std::sqrt(squared_length(a - b)));
}

/// A ball that a body does not leave.
struct Ball {
    Real3 centre{};                                           ///< m
    double radius = std::numeric_limits<double>::infinity();  ///< m
};

/// A sudden change of a body's velocity, by an impact.
struct Kink {
    Real time;  ///< s
    State3 before;
    State3 after;
};

/// The true motion of a scene's bodies at any time from 0 s to the end.
class Motion {
public:
    virtual ~Motion() = default;

    [[nodiscard]] virtual std::size_t bodies() const = 0;
    [[nodiscard]] virtual State3 at(std::size_t row, Real t) const = 0;
    /// The states of all bodies at one time.
    virtual void all_at(Real t, std::span<State3> states) const {
        for (std::size_t row = 0; row < states.size(); ++row) states[row] = at(row, t);
    }
    /// A function that writes the states of all bodies at the time tick/rate, fastest for
    /// consecutive ticks. It refers to the motion.
    using AtTicks = std::function<void(std::int64_t tick, std::span<State3> states)>;
    [[nodiscard]] virtual AtTicks at_ticks(std::int64_t rate) const {
        return [this, rate](std::int64_t tick, std::span<State3> states) {
            all_at(static_cast<Real>(tick) / static_cast<Real>(rate), states);
        };
    }
    /// A bound of the distance (m) of a body, between `from` and `to`, from the cubic through its
    /// states `first` and `last` at both times.
    [[nodiscard]] virtual double cubic_error(std::size_t row, const State3& first,
                                             const State3& last, Real from, Real to) const = 0;
    /// A bound of cubic_error over any `h` s of the run, if one is known without the state.
    [[nodiscard]] virtual double largest_cubic_error(std::size_t, Real) const {
        return std::numeric_limits<double>::infinity();
    }
    /// A ball around the body from a time on at which it has this state.
    [[nodiscard]] virtual Ball enclosure(std::size_t, const State3&) const { return {}; }
    /// The impacts of a body, in the order of time.
    [[nodiscard]] virtual std::vector<Kink> kinks(std::size_t) const { return {}; }
};

}  // namespace oiler::lab
