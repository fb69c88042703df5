// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "oiler/physics/state.hpp"

namespace oiler::lab {

[[nodiscard]] inline Vec<long double, 3> to_real(const Vec3& v) { return {v[0], v[1], v[2]}; }

/// A ball that a body does not leave.
struct Ball {
    Vec<long double, 3> centre{};                             ///< m
    double radius = std::numeric_limits<double>::infinity();  ///< m
};

/// The true motion of a scene's bodies at any time from 0 s to the end.
class Motion {
public:
    virtual ~Motion() = default;

    [[nodiscard]] virtual std::size_t bodies() const = 0;
    [[nodiscard]] virtual State<long double, 3> at(std::size_t row, long double t) const = 0;
    /// The states of all bodies at one time.
    virtual void all_at(long double t, std::span<State<long double, 3>> states) const {
        for (std::size_t row = 0; row < states.size(); ++row) states[row] = at(row, t);
    }
    /// A function that writes the states of all bodies at the time tick/rate, fastest for
    /// consecutive ticks. It refers to the motion.
    using Walk = std::function<void(std::int64_t tick, std::span<State<long double, 3>> states)>;
    [[nodiscard]] virtual Walk walk(std::int64_t rate) const {
        return [this, rate](std::int64_t tick, std::span<State<long double, 3>> states) {
            all_at(static_cast<long double>(tick) / static_cast<long double>(rate), states);
        };
    }
    /// A bound of the distance (m) of a body, between `from` and `to`, from the cubic through its
    /// states `first` and `last` at both times.
    [[nodiscard]] virtual double bend(std::size_t row, const State<long double, 3>& first,
                                      const State<long double, 3>& last, long double from,
                                      long double to) const = 0;
    /// A bound of the bend over any `h` s of the run, if one is known without the state.
    [[nodiscard]] virtual double bend_of_any(std::size_t, long double) const {
        return std::numeric_limits<double>::infinity();
    }
    /// A ball around the body from a time on at which it has this state.
    [[nodiscard]] virtual Ball enclosure(std::size_t, const State<long double, 3>&) const {
        return {};
    }
};

}  // namespace oiler::lab
