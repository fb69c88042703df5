// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "oiler/lab/reference/motion.hpp"
#include "oiler/lab/reference/samples.hpp"

namespace oiler::lab {

/// Positions and velocities of all bodies at every sample.
struct Trajectory {
    std::size_t bodies = 0;
    /// All bodies at the first sample, then at the next.
    std::vector<State3> states{};
    /// For each body, in the order of time; empty if no body has any.
    std::vector<std::vector<Kink>> kinks{};

    [[nodiscard]] const State3& at(std::int64_t sample, std::size_t row) const {
        return states[static_cast<std::size_t>(sample) * bodies + row];
    }
    /// The kinks of a body after `from` and before `to`, s.
    [[nodiscard]] std::span<const Kink> kinks_between(std::size_t row, Real from, Real to) const;
    [[nodiscard]] std::int64_t samples() const {
        return bodies == 0 ? 0 : static_cast<std::int64_t>(states.size() / bodies);
    }
};

/// A motion between samples: the polynomial of degree 7 through the positions and velocities of the
/// four nearest samples; beside a kink, of the kink and of samples on the same side.
class SampledMotion : public Motion {
public:
    /// `fastest` is an upper bound of the motion's angular frequencies, 1/s.
    SampledMotion(Trajectory trajectory, std::int64_t per_second, double fastest);

    [[nodiscard]] std::size_t bodies() const override { return trajectory_.bodies; }
    [[nodiscard]] State3 at(std::size_t row, Real t) const override;
    void all_at(Real t, std::span<State3> states) const override;
    /// A cubic over 1/8 of the shortest period, or between two samples, follows a motion without
    /// kinks.
    [[nodiscard]] double cubic_error(std::size_t row, const State3&, const State3&, Real from,
                                     Real to) const override;
    [[nodiscard]] std::vector<Kink> kinks(std::size_t row) const override {
        return trajectory_.kinks.empty() ? std::vector<Kink>{} : trajectory_.kinks[row];
    }
    [[nodiscard]] const Trajectory& trajectory() const { return trajectory_; }

private:
    /// The sample at exactly that time.
    [[nodiscard]] std::optional<std::int64_t> sample_at(Real t) const;

    Trajectory trajectory_;
    std::int64_t per_second_;
    Real longest_cubic_;  ///< s
    double fastest_ = 0;  ///< m/s, if there are kinks
};

/// The estimated largest error of a SampledMotion between its samples, m, up to each sample. It
/// compares samples with interpolations that leave them out, at two spacings, and extrapolates to
/// the spacing of all samples. Samples near kinks are left out. `may_jump` tells whether
/// accelerations may jump, where a body stops or slips; the error near the ends is then that of an
/// extrapolation.
[[nodiscard]] std::vector<double> interpolation_errors(const Trajectory& trajectory,
                                                       std::int64_t per_second, bool may_jump);

}  // namespace oiler::lab
