// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/reference.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "oiler/core/error.hpp"
#include "oiler/lab/reference/parts.hpp"

namespace oiler::lab {
namespace {

using Real = long double;
using State3 = State<Real, 3>;

/// A closed form is compared with fine steps of this error, as a fraction of the extent.
constexpr double checked_to = 1e-9;
constexpr double checking_work = 2e7;  ///< limit of the comparison, see ReferenceEffort

bool is_power_of_two(double number) {
    int exponent = 0;
    return std::frexp(number, &exponent) == 0.5;
}

/// Forces per unit mass are rounded to double, unless the mass is a power of two.
double rounding_of(const Bodies& bodies) {
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (!is_power_of_two(bodies.mass(row))) return std::numeric_limits<double>::epsilon();
    return static_cast<double>(std::numeric_limits<Real>::epsilon());
}

Trajectory trajectory_of(const std::vector<ExactMotion>& motions, const SampleTimes& samples,
                         Bodies bodies) {
    Trajectory trajectory{.bodies = motions.size()};
    for (std::int64_t sample = 0; sample < samples.count; ++sample) {
        const Real t = static_cast<Real>(sample) / static_cast<Real>(samples.per_second);
        for (std::size_t row = 0; row < motions.size(); ++row) {
            trajectory.states.push_back(motions[row](t));
            bodies.set_state(row, trajectory.states.back());
        }
        trajectory.energies.push_back(bodies.energy().total());
    }
    return trajectory;
}

/// The round-off of a closed form: a few roundings of the position and of the elapsed time.
std::vector<Uncertainty> uncertainties_of(const Trajectory& trajectory, const SampleTimes& samples,
                                          double rounding) {
    std::vector<Uncertainty> uncertainties;
    Uncertainty most{.energy = 8 * std::numeric_limits<double>::epsilon()};
    double x = 0;
    double v = 0;
    for (std::int64_t sample = 0; sample < samples.count; ++sample) {
        for (std::size_t row = 0; row < trajectory.bodies; ++row) {
            x = std::max(x, static_cast<double>(largest(trajectory.at(sample, row).x)));
            v = std::max(v, static_cast<double>(largest(trajectory.at(sample, row).v)));
        }
        const double turned = x > 0 ? 1 + v * samples.time(sample) / x : 1;
        most.position = rounding * (8 * x + v * samples.time(sample));
        most.velocity = rounding * v * (8 + turned);
        uncertainties.push_back(most);
    }
    return uncertainties;
}

double largest_coordinate(const Trajectory& trajectory) {
    double most = 0;
    for (const State3& state : trajectory.states)
        most = std::max(most, static_cast<double>(largest(state.x)));
    return most;
}

/// The energy at the start. If it is below a hundredth of the largest kinetic energy, because the
/// zero of potential energy is arbitrary: that kinetic energy.
double energy_scale_of(const Trajectory& trajectory, Bodies bodies) {
    const std::size_t samples = trajectory.energies.size();
    double kinetic = 0;
    for (std::size_t sample = 0; sample < samples;
         sample += std::max<std::size_t>(1, samples / 200)) {
        for (std::size_t row = 0; row < trajectory.bodies; ++row)
            bodies.set_state(row, trajectory.at(static_cast<std::int64_t>(sample), row));
        kinetic = std::max(kinetic, bodies.energy().kinetic);
    }
    const double at_start = std::abs(trajectory.energies.front());
    return at_start > kinetic / 100 ? at_start : kinetic;
}

double largest_difference(const Trajectory& a, const Trajectory& b, std::int64_t samples) {
    double most = 0;
    for (std::int64_t sample = 0; sample < samples; ++sample)
        for (std::size_t row = 0; row < a.bodies; ++row)
            most = std::max(most, distance(a.at(sample, row).x, b.at(sample, row).x));
    return most;
}

/// The number of samples before 100 × the uncertainty exceeds `tolerable`.
std::int64_t count_usable(const std::vector<Uncertainty>& uncertainties, double tolerable) {
    const auto bad = std::find_if(uncertainties.begin(), uncertainties.end(),
                                  [&](const Uncertainty& uncertainty) {
                                      return !(margin * uncertainty.position <= tolerable);
                                  });
    return std::max<std::int64_t>(1, bad - uncertainties.begin());
}

class ReferenceBuilder {
public:
    ReferenceBuilder(const Scene& scene, const SampleTimes& samples, const ReferenceEffort& effort)
        : scene_(scene),
          effort_(effort),
          start_(make_world(scene, Settings{{scene.stepping.method, scene.stepping.rate,
                                             Precision::extended}})
                     .bodies()) {
        reference_.samples = samples;
    }

    Reference run(const ClosedForm& closed_form) {
        const auto motions = closed_form(start_);
        if (motions)
            take(*motions);
        else
            take(fine_steps(scene_, reference_.samples, effort_));
        return finish();
    }

private:
    void take(const std::vector<ExactMotion>& motions) {
        reference_.closed_form = true;
        reference_.trajectory = trajectory_of(motions, reference_.samples, start_);
        reference_.uncertainties =
            uncertainties_of(reference_.trajectory, reference_.samples, rounding_of(start_));
        reference_.words = "the closed form of the motion";
        check();
    }
    void take(FineSteps&& fine) {
        reference_.closed_form = false;
        affordable_ = fine.affordable;
        if (!fine.trajectory.states.empty()) followed_ = count_followed(fine);
        reference_.trajectory = std::move(fine.trajectory);
        reference_.uncertainties = std::move(fine.uncertainties);
        reference_.words = std::move(fine.words);
    }

    void check() {
        ReferenceEffort effort = effort_;
        effort.wanted = checked_to * extent_of(reference_.trajectory);
        effort.most_work = std::min(effort.most_work, checking_work);
        FineSteps fine = fine_steps(scene_, reference_.samples, effort);
        if (fine.trajectory.states.empty()) {
            reference_.words += "; not checked by fine steps: too much work";
            return;
        }
        const std::int64_t usable = count_usable(fine.uncertainties, 10 * margin * effort.wanted);
        if (usable < 2) {
            reference_.words += "; not checked by fine steps: too coarse";
            return;
        }
        const double apart = largest_difference(reference_.trajectory, fine.trajectory, usable);
        const auto last = static_cast<std::size_t>(usable - 1);
        const double allowed =
            margin * (fine.uncertainties[last].position + reference_.uncertainties[last].position);
        if (apart <= allowed) {
            reference_.words += fmt::format(", confirmed by fine steps to {:.2g} m",
                                            std::max(apart, fine.uncertainties[last].position));
            if (usable < reference_.samples.count)
                reference_.words +=
                    fmt::format(" for the first {:.3g} s", reference_.samples.time(usable - 1));
            return;
        }
        take(fine_steps(scene_, reference_.samples, effort_));
        reference_.words += fmt::format(
            "; closed form rejected: it differs by {:.3g} m from fine steps, whose own error is "
            "{:.2g} m",
            apart, fine.uncertainties[last].position);
    }

    /// The number of samples before a run of the same steps in double deviates by more than `most`.
    [[nodiscard]] std::int64_t count_followed(const FineSteps& fine) const {
        const double most = std::max(
            resolution * extent_of(fine.trajectory),
            margin * std::numeric_limits<double>::epsilon() * largest_coordinate(fine.trajectory));
        Follower follower(scene_, Settings{{fine.method, {fine.rate}, Precision::double_}},
                          reference_.samples.per_second);
        for (std::int64_t sample = 0; sample < reference_.samples.count && !effort_.stopped();
             ++sample) {
            if (!follower.go_to(sample)) return sample;
            for (std::size_t row = 0; row < fine.trajectory.bodies; ++row)
                if (!(distance(follower.state(row).x, fine.finest_run.at(sample, row).x) <= most))
                    return sample;
        }
        return reference_.samples.count;
    }

    void find_meaningful() {
        // Round-off does not make a scene with little motion chaotic.
        const double most = std::max(resolution * reference_.extent,
                                     margin * std::numeric_limits<double>::epsilon() *
                                         largest_coordinate(reference_.trajectory));
        const std::int64_t usable = count_usable(reference_.uncertainties, most);
        reference_.meaningful = std::max<std::int64_t>(1, std::min(usable, followed_));
        if (reference_.meaningful == reference_.samples.count) return;
        reference_.why_no_longer =
            followed_ < usable
                ? fmt::format(
                      "round-off of double alone then moves bodies by more than {:.2g} m: the "
                      "motion is chaotic",
                      most)
                : fmt::format(
                      "the reference's own error then exceeds {:.2g} m: the motion is chaotic, or "
                      "a finer reference is too much work",
                      most / margin);
    }

    Reference finish() {
        if (effort_.stopped()) return std::move(reference_);
        if (reference_.trajectory.states.empty() && !affordable_)
            fail(Exit::usage,
                 "a reference for {} s takes too much work: shorten it with --duration",
                 scene_.duration);
        if (reference_.trajectory.states.empty())
            fail(Exit::diverged,
                 "no reference stays finite over {} s: the scene is too stiff, or a body hits an "
                 "attractor; shorten it with --duration",
                 scene_.duration);
        reference_.extent = extent_of(reference_.trajectory);
        reference_.energy_scale = energy_scale_of(reference_.trajectory, start_);
        for (Uncertainty& uncertainty : reference_.uncertainties)
            uncertainty.energy = std::max(reference_.share_of_energy(uncertainty.energy),
                                          8 * std::numeric_limits<double>::epsilon());
        find_meaningful();
        reference_.oscillation =
            find_oscillation(reference_.trajectory, reference_.meaningful_samples());
        return std::move(reference_);
    }

    const Scene& scene_;
    const ReferenceEffort& effort_;
    Bodies start_;
    Reference reference_;
    bool affordable_ = true;
    std::int64_t followed_ = std::numeric_limits<std::int64_t>::max();
};

}  // namespace

double Reference::share_of_energy(double joules) const {
    return energy_scale > 0 ? joules / energy_scale : joules;
}

double extent_of(const Trajectory& trajectory) {
    double extent = 0;
    for (std::size_t i = 0; i < trajectory.states.size(); ++i)
        extent = std::max(
            extent, distance(trajectory.states[i].x, trajectory.states[i % trajectory.bodies].x));
    return extent;
}

Uncertainty Reference::floor() const {
    const Uncertainty& last = uncertainties[static_cast<std::size_t>(meaningful - 1)];
    return {margin * last.position, margin * last.velocity, margin * last.energy};
}

Reference make_reference(const Scene& scene, const SampleTimes& samples,
                         const ReferenceEffort& effort, const ClosedForm& closed_form) {
    return ReferenceBuilder(scene, samples, effort).run(closed_form);
}

RunWork::RunWork(const Scene& scene) {
    const Bodies bodies = make_world(scene, Settings{scene.stepping}).bodies();
    const auto size = static_cast<double>(bodies.size());
    const auto links = static_cast<double>(bodies.link_count());
    per_evaluation_ = size + links;
    // A few iterations; each factorises the matrix of a net.
    to_solve_ = 4 * (links > 0 ? std::sqrt(size * scene.axes) : 1);
}

double RunWork::per_step(const Method& method) const {
    return per_evaluation_ * (method.evaluations > 0 ? method.evaluations : to_solve_);
}

}  // namespace oiler::lab
