// SPDX-License-Identifier: MIT
#pragma once

#include <map>

#include "oiler/stability/stability.hpp"

namespace oiler {

/// Whether the method applies damping along a spring or between bodies, and quadratic drag, in
/// half-steps around the step, which are always stable.
[[nodiscard]] bool splits_dampers(const Method& method, Damping damping);

/// Whether steps of the method are stable at any rate.
[[nodiscard]] bool is_implicit(const Method& method);

/// The steps at which stability is tested: a step and four shorter steps.
inline constexpr double tested_steps[] = {1.0, 0.8, 0.6, 0.4, 0.2};

/// An oscillation relative to a step.
struct ScaledOscillation {
    double omega_dt = 0;
    double damping_dt = 0;  ///< c·dt, c = 2ζω
};

/// max(ω, c)·dt.
[[nodiscard]] double size(const ScaledOscillation& of);

/// The oscillation with the same damping ratio and size 1, at a step of 1 s.
[[nodiscard]] Oscillation unit_oscillation(const ScaledOscillation& of);

/// A method's region of stability: the oscillations that are stable at a step of 1 s and at four
/// shorter steps.
class Region {
public:
    Region(const Method& method, Damping damping) : method_(method), damping_(damping) {}

    [[nodiscard]] const Method& method() const { return method_; }
    [[nodiscard]] Damping damping() const { return damping_; }

    bool contains(const ScaledOscillation& of);
    /// Whether all slower and less damped oscillations are in the region too. It samples a grid and
    /// answers only up to ω·dt = 1.5 and c·dt = 1.5, where no region has gaps.
    bool contains_all_up_to(const ScaledOscillation& of);

private:
    [[nodiscard]] bool measure(const Oscillation& of) const;

    const Method& method_;
    Damping damping_;
    std::map<std::pair<double, double>, bool> known_{};
};

}  // namespace oiler
