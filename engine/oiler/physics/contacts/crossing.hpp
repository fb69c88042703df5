// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <optional>

#include "oiler/physics/contacts/root.hpp"

namespace oiler {

/// The gap between a body and an obstacle at an instant of a leg.
template <std::floating_point T>
struct GapAt {
    T tau;    ///< s, since the start of the leg
    T gap;    ///< m
    T speed;  ///< m/s, away from the obstacle
};

/// Finds the first instant at which a body enters a convex obstacle. With accelerations up to A,
/// gap + A·τ²/2 is convex, so that its tangents at the ends of an interval bound the gap between
/// them from below. An interval in which the bound is negative is halved.
///
/// `at(tau)` returns a GapAt: shorter steps of a method. Their places are not those of one motion,
/// because the error of a step depends on its length: the bound therefore takes 2A for A, and
/// speeds of error A·τ.
template <std::floating_point T, class At>
class FirstCrossing {
public:
    using Sample = GapAt<T>;

    FirstCrossing(At at, T acceleration, T noise)
        : at_(at), acceleration_(2 * acceleration), noise_(noise) {}

    /// The bracket of the first crossing between two instants, the first of which is outside.
    [[nodiscard]] std::optional<Bracket<T>> between(const Sample& from, const Sample& to) {
        if (stays_out(from, to)) return std::nullopt;
        if (is_in(to) && is_single(from, to)) return root(from, to);
        const T width = to.tau - from.tau;
        const bool is_short =
            acceleration_ * width * width / 2 < noise_ && (from.speed >= 0 || to.speed <= 0);
        if (is_short || left_ == 0) return is_in(to) ? std::optional(root(from, to)) : std::nullopt;
        --left_;
        const Sample middle = at_(from.tau + width / 2);
        if (const auto found = between(from, middle)) return found;
        return between(middle, to);
    }

private:
    [[nodiscard]] bool is_in(const Sample& sample) const { return sample.gap < -noise_; }
    /// The slopes of the convex function at both ends, less and more than they can be.
    [[nodiscard]] T slope_from(const Sample& from) const {
        return from.speed - acceleration_ / 2 * from.tau;
    }
    [[nodiscard]] T slope_to(const Sample& from, const Sample& to) const {
        return to.speed + acceleration_ / 2 * to.tau + acceleration_ * (to.tau - from.tau);
    }
    [[nodiscard]] bool stays_out(const Sample& from, const Sample& to) const {
        if (is_in(to)) return false;
        const T width = to.tau - from.tau;
        const T end = to.gap + acceleration_ * width * width / 2;
        const T u_from = slope_from(from);
        const T u_to = slope_to(from, to);
        if (!(u_to > u_from)) return true;
        const T lowest = (end - from.gap - u_to * width) / (u_from - u_to);
        if (!(lowest > 0 && lowest < width)) return true;
        return from.gap + u_from * lowest - acceleration_ * lowest * lowest / 2 > -noise_;
    }
    /// Whether the gap falls all the time, so that it has one root.
    [[nodiscard]] bool is_single(const Sample& from, const Sample& to) const {
        return slope_to(from, to) < 0;
    }
    [[nodiscard]] Bracket<T> root(const Sample& from, const Sample& to) const {
        const auto gap = [&](T tau) { return at_(tau).gap; };
        // Without noise, also a bracket that begins at the root is narrowed.
        return narrow_bracket<T>(gap, {from.tau, to.tau}, std::max(from.gap, T(0)), to.gap,
                                 noise_ > 0 ? noise_ / 16 : T(-1));
    }

    At at_;
    T acceleration_;  ///< m/s²
    T noise_;         ///< m
    int left_ = 96;   ///< halvings
};

}  // namespace oiler
