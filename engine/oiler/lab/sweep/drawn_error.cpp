// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/drawn_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace oiler::lab {
namespace {

using Offset = Vec<double, 3>;

/// A part of a step is divided while the cubic through its ends may deviate by more than this
/// fraction of the largest distance.
constexpr double tolerable_cubic_error = 0.01;
constexpr int points_of_line = 16;

Offset narrowed(const Real3& a) {
    return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}

double length(const Offset& a) { return std::sqrt(squared_length(a)); }

/// The point of the drawn line at a time within the step.
Real3 drawn_at(const DrawnStep& step, Real t) {
    const Real share = (t - step.from) / (step.to - step.from);
    return step.run_from.x + (step.run_to.x - step.run_from.x) * share;
}

}  // namespace

void DrawnError::add(const DrawnStep& step, Real until) {
    if (display_ > 0) return add_frames(step, until);
    Part part{step.from,
              step.to,
              step.true_from,
              step.true_to,
              narrowed(step.run_from.x - step.true_from.x),
              narrowed(step.run_to.x - step.true_to.x)};
    if (until < step.to) {
        part.to = until;
        part.true_to = motion_.at(step.row, until);
        part.offset_to = narrowed(drawn_at(step, until) - part.true_to.x);
    }
    add_part(step, part);
}

void DrawnError::add_frames(const DrawnStep& step, Real until) {
    const auto rate = static_cast<Real>(display_);
    auto frame = static_cast<std::int64_t>(std::ceil(step.from * rate));
    for (Real t = static_cast<Real>(frame) / rate; t <= std::min(step.to, until);
         t = static_cast<Real>(++frame) / rate)
        most_ = larger(most_, distance(drawn_at(step, t), motion_.at(step.row, t).x));
}

// The motion's cubic deviates from its chord by s(1 − s)((1 − s)·p − s·q), with p = h·v − Δx at the
// part's start and q = h·v − Δx at its end.
void DrawnError::add_part(const DrawnStep& step, const Part& part) {
    const double ends = std::max(length(part.offset_from), length(part.offset_to));
    most_ = larger(most_, ends);
    const auto h = static_cast<double>(part.to - part.from);
    const Offset chord = narrowed(part.true_to.x - part.true_from.x);
    const Offset p = narrowed(part.true_from.v) * h - chord;
    const Offset q = narrowed(part.true_to.v) * h - chord;
    const double bulge = ends + std::max(length(p), length(q)) / 4;
    if (bulge + motion_.largest_cubic_error(step.row, part.to - part.from) <= most_) return;
    const double cubic_error =
        motion_.cubic_error(step.row, part.true_from, part.true_to, part.from, part.to);
    if (bulge + cubic_error <= most_) return;
    if (cubic_error <= tolerable_cubic_error * std::max(most_, least_)) return sample(part, p, q);
    if (!may_exceed(step, part, most_ * (1 + tolerable_cubic_error))) return;
    const Real middle = (part.from + part.to) / 2;
    if (!(middle > part.from && middle < part.to)) return;
    const State3 there = motion_.at(step.row, middle);
    const Offset offset = narrowed(drawn_at(step, middle) - there.x);
    add_part(step, {part.from, middle, part.true_from, there, part.offset_from, offset});
    add_part(step, {middle, part.to, there, part.true_to, offset, part.offset_to});
}

/// Whether a body that stays in its enclosure can be farther from the part's line than `most`.
bool DrawnError::may_exceed(const DrawnStep& step, const Part& part, double most) const {
    const Ball ball = motion_.enclosure(step.row, part.true_from);
    const double line = std::max(distance(drawn_at(step, part.from), ball.centre),
                                 distance(drawn_at(step, part.to), ball.centre));
    return line + ball.radius > most;
}

void DrawnError::sample(const Part& part, const Offset& p, const Offset& q) {
    for (int point = 1; point < points_of_line; ++point) {
        const double s = static_cast<double>(point) / points_of_line;
        const Offset cubic = (p * (1 - s) - q * s) * (s * (1 - s));
        const Offset offset = part.offset_from * (1 - s) + part.offset_to * s - cubic;
        most_ = larger(most_, length(offset));
    }
}

double least_drawn_error(const Motion& motion, std::int64_t rate, double until, double enough) {
    const Motion::AtTicks at_ticks = motion.at_ticks(2 * rate);
    std::vector<State3> from(motion.bodies());
    std::vector<State3> middle = from;
    std::vector<State3> to = from;
    at_ticks(0, to);
    const auto steps = static_cast<std::int64_t>(std::floor(until * static_cast<double>(rate)));
    double least = 0;
    for (std::int64_t step = 0; step < steps && least <= enough; ++step) {
        from.swap(to);
        at_ticks(2 * step + 1, middle);
        at_ticks(2 * step + 2, to);
        for (std::size_t row = 0; row < from.size(); ++row)
            least =
                std::max(least, distance(middle[row].x, (from[row].x + to[row].x) * Real(0.5)) / 2);
    }
    return least;
}

}  // namespace oiler::lab
