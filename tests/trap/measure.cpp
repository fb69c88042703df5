// SPDX-License-Identifier: MIT
#include "trap/measure.hpp"
#include "oiler/sim/bodies.hpp"

#include <algorithm>
#include <cmath>

namespace oiler::trap {

Stepped::Stepped(const Scene& scene, const Stepping& stepping)
    : world_(make_world(scene, Settings{stepping})),
      before_(world_.bodies().size()),
      after_(world_.bodies().size()) {
    read(after_);
}

bool Stepped::step(std::int64_t count) {
    if (count > 0) finite_ = finite_ && !world_.try_step(count);
    return finite_;
}

bool Stepped::go_to(std::int64_t n) {
    if (!finite_ || world_.tick() == n + 1) return finite_;
    if (world_.tick() < n) {
        if (!step(n - world_.tick())) return false;
        read(after_);
    }
    std::swap(before_, after_);
    if (!step(1)) return false;
    read(after_);
    return true;
}

void Stepped::read(std::vector<Point>& points) const {
    for (std::size_t row = 0; row < points.size(); ++row) {
        const auto x = world_.bodies().state(row).x;
        points[row] = {x[0], x[1], x[2]};
    }
}

namespace {

constexpr Real infinite = std::numeric_limits<Real>::infinity();

Real distance(const Point& a, const Point& b) {
    Real squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        squared += (a[axis] - b[axis]) * (a[axis] - b[axis]);
    return std::sqrt(squared);
}

Point between(const Point& before, const Point& after, Real share) {
    Point point;
    for (std::size_t axis = 0; axis < 3; ++axis)
        point[axis] = before[axis] + share * (after[axis] - before[axis]);
    return point;
}

/// The steps of a run up to its duration, and how they are sampled.
struct Plan {
    std::int64_t rate = 1;
    std::int64_t whole = 0;  ///< steps within the duration
    std::int64_t total = 0;  ///< steps that begin within the duration
    std::size_t inside = 64;
    std::int64_t stride = 1;
    Real end = 0;  ///< the duration in steps
};

Plan plan_of(const Scene& scene, std::int64_t rate, const Truth& truth, Real samples) {
    Plan plan{.rate = rate};
    plan.end = static_cast<Real>(scene.duration) * static_cast<Real>(rate);
    // A duration such as 0.3 s is whole steps, though its binary number is a little less.
    plan.whole = static_cast<std::int64_t>(std::floor(plan.end * (1 + 1e-12L)));
    plan.total =
        plan.end > static_cast<Real>(plan.whole) * (1 + 1e-12L) ? plan.whole + 1 : plan.whole;
    plan.end = std::max(plan.end, static_cast<Real>(plan.whole));
    const Real cost = truth.cost() * static_cast<Real>(plan.total);
    const Real periods = 1 / (static_cast<Real>(rate) * truth.shortest_period());
    const Real least = std::max(Real(7), std::ceil(64 * periods));
    const Real inside = std::max(least, std::min(Real(64), samples / cost));
    // So many instants of one step meet its errors, however many periods it has.
    const Real most = std::max(Real(7), 4e6L / static_cast<Real>(truth.size()));
    plan.inside = static_cast<std::size_t>(std::min({inside, most, Real(50'000)}));
    plan.stride =
        std::max(std::int64_t{1},
                 static_cast<std::int64_t>(cost * static_cast<Real>(plan.inside) / samples));
    return plan;
}

/// The largest error inside the step that begins at tick n.
Real error_inside(const Plan& plan, std::int64_t n, const Stepped& run,
                  const std::vector<Point>& truth) {
    Real largest = 0;
    for (std::size_t j = 0; j <= plan.inside; ++j) {
        const Real share = share_of(j, plan.inside);
        if (static_cast<Real>(n) + share > plan.end) break;
        for (std::size_t row = 0; row < run.before().size(); ++row)
            largest =
                std::max(largest, distance(between(run.before()[row], run.after()[row], share),
                                           truth[row * (plan.inside + 1) + j]));
    }
    return largest;
}

Real error_at(const std::vector<Point>& points, const std::vector<Point>& truth,
              std::size_t stride) {
    Real largest = 0;
    for (std::size_t row = 0; row < points.size(); ++row)
        largest = std::max(largest, distance(points[row], truth[row * stride]));
    return largest;
}

/// The step to sample after step n: about `stride` later, but neither the last whole step nor the
/// very last is left out.
std::int64_t next_step(const Plan& plan, std::int64_t n) {
    const std::int64_t jitter = plan.stride / 2 > 0 ? (n * 7919 + 104'729) % (plan.stride / 2) : 0;
    const std::int64_t next = n + plan.stride - jitter;
    for (const std::int64_t last : {plan.whole - 1, plan.total - 1})
        if (n < last && next > last) return last;
    return next;
}

}  // namespace

Errors measure(const Scene& scene, const Stepping& stepping, Truth& truth, const Effort& effort) {
    const Plan plan = plan_of(scene, stepping.rate.steps, truth, effort.samples);
    Stepped run(scene, stepping);
    truth.prepare(plan.rate, plan.inside);
    Errors errors;
    for (std::int64_t n = 0; n < plan.total; n = next_step(plan, n)) {
        if (!run.go_to(n)) return {infinite, infinite};
        const std::vector<Point>& points = truth.sample(n);
        errors.at_steps =
            std::max(errors.at_steps, error_at(run.before(), points, plan.inside + 1));
        errors.drawn = std::max(errors.drawn, error_inside(plan, n, run, points));
        if (errors.drawn > effort.enough) return errors;
    }
    if (plan.whole > 0 && plan.whole == plan.total)
        errors.at_steps = std::max(
            errors.at_steps, error_at(run.after(), truth.sample(plan.whole), plan.inside + 1));
    errors.drawn = std::max(errors.drawn, errors.at_steps);
    return errors;
}

Real display_error(const Scene& scene, const Stepping& stepping, Truth& truth) {
    constexpr std::int64_t frames_per_second = 60;
    const std::int64_t rate = stepping.rate.steps;
    const auto frames = static_cast<std::int64_t>(
        std::floor(static_cast<Real>(scene.duration) * frames_per_second * (1 + 1e-12L)));
    Stepped run(scene, stepping);
    truth.prepare(frames_per_second, 0);
    Real largest = 0;
    for (std::int64_t frame = 1; frame <= frames; ++frame) {
        // The end of a step rather than the start of the next, which may be after the duration.
        const std::int64_t n = (frame * rate - 1) / frames_per_second;
        if (!run.go_to(n)) return infinite;
        const Real share =
            static_cast<Real>(frame * rate - n * frames_per_second) / frames_per_second;
        const std::vector<Point>& points = truth.sample(frame);
        for (std::size_t row = 0; row < points.size(); ++row)
            largest = std::max(
                largest,
                distance(between(run.before()[row], run.after()[row], share), points[row]));
    }
    return largest;
}

Real error_of(const Scene& scene, const Stepping& stepping, Truth& truth, Meaning meaning,
              const Effort& effort) {
    if (meaning == Meaning::display) return display_error(scene, stepping, truth);
    if (meaning == Meaning::drawn) return measure(scene, stepping, truth, effort).drawn;
    return measure(scene, stepping, truth, {.samples = effort.samples}).at_steps;
}

}  // namespace oiler::trap
