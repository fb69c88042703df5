// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "oiler/lab/sweep/judge.hpp"

namespace oiler::lab {

/// Counts the work of a search: its runs beside the reference, in force evaluations, each on one
/// body or link. It does not depend on the machine.
class WorkMeter {
public:
    /// The work of comparing a body with the reference once.
    static constexpr double comparison = 50;

    WorkMeter(const Scene& scene, double most, const std::function<bool()>& stopped);

    [[nodiscard]] double evaluations_per_step(const Method& method) const {
        return work_.per_step(method);
    }
    /// The work of a step and of its comparison with the reference.
    [[nodiscard]] double per_step(const Method& method) const;
    /// Whether so much more work is within the limit of a search.
    [[nodiscard]] bool affords(double work) const { return done_ + work <= most_; }
    /// Whether work is so little that the limit does not matter.
    [[nodiscard]] bool is_little(double work) const { return work <= most_ / 32; }
    /// For JudgeOptions: a run asks at each step whether to stop, which counts the step.
    [[nodiscard]] std::function<bool()> counting(const Method& method);
    [[nodiscard]] double share_done() const { return done_ / most_; }

private:
    RunWork work_;
    double most_;
    const std::function<bool()>& stopped_;
    bool linked_ = false;
    double per_comparison_ = 0;  ///< work per step beside the evaluations
    double done_ = 0;
};

}  // namespace oiler::lab
