// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "oiler/lab/reference/motion.hpp"

namespace oiler::lab {

/// One step of a body: its drawn line and its true motion. States are at the step's two ends.
struct DrawnStep {
    std::size_t row = 0;
    Real from = 0;  ///< s
    Real to = 0;    ///< s
    State3 run_from{};
    State3 run_to{};
    State3 true_from{};
    State3 true_to{};
};

/// The largest distance of drawn lines from the true motion. Within a step, the motion is divided
/// until cubics follow it to 1 % of that distance; each cubic is then compared at 17 points. Steps
/// that cannot raise the distance are skipped.
class DrawnError {
public:
    /// `least`: distances below it (m) need not be known. `display`: frames per second at
    /// whose times lines are compared, 0 for all times.
    DrawnError(const Motion& motion, double least, std::int64_t display)
        : motion_(motion), least_(least), display_(display) {}

    /// Includes a step up to the time `until`, s.
    void add(const DrawnStep& step, Real until);
    [[nodiscard]] double error() const { return most_; }

private:
    using Offset = Vec<double, 3>;

    /// A part of a step; offsets are those of the line from the true motion, m.
    struct Part {
        Real from, to;
        State3 true_from, true_to;
        Offset offset_from, offset_to;
    };

    void add_frames(const DrawnStep& step, Real until);
    void add_part(const DrawnStep& step, const Part& part);
    [[nodiscard]] bool may_exceed(const DrawnStep& step, const Part& part, double most) const;
    /// p and q: see add_part.
    void sample(const Part& part, const Offset& p, const Offset& q);

    const Motion& motion_;
    double least_;
    std::int64_t display_;
    double most_ = 0;
};

/// A lower bound of the error as drawn of any method at a rate, m. In each step, the error at an
/// end or at the middle of the line is at least half of the motion's distance from its chord there.
/// The search ends at a bound above `enough`.
[[nodiscard]] double least_drawn_error(const Motion& motion, std::int64_t rate, double until,
                                       double enough);

}  // namespace oiler::lab
