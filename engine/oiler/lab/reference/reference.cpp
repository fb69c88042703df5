// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/reference.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "oiler/core/error.hpp"
#include "oiler/core/length_text.hpp"
#include "oiler/lab/reference/fine_steps.hpp"
#include "oiler/lab/reference/path.hpp"
#include "oiler/lab/reference/scales.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::lab {
namespace {

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

/// The round-off of a closed form: a few roundings of the position and of the elapsed time.
std::vector<Uncertainty> uncertainties_of(const Scales& scales, const SampleTimes& samples,
                                          double rounding) {
    std::vector<Uncertainty> uncertainties;
    const double x = scales.coordinate;
    const double v = scales.speed;
    for (std::int64_t sample = 0; sample < samples.count; ++sample) {
        const double way = v * samples.time(sample);
        const double turned = x > 0 ? 1 + way / x : 1;
        uncertainties.push_back({.position = rounding * (8 * x + way),
                                 .velocity = rounding * v * (8 + turned),
                                 .energy = 0});
    }
    return uncertainties;
}

/// The largest distance of a motion from the trajectory in its first samples.
double largest_difference(const Motion& motion, const Trajectory& trajectory,
                          std::int64_t per_second, std::int64_t samples) {
    constexpr std::int64_t most_states = 200'000;
    const std::int64_t stride =
        1 + samples * static_cast<std::int64_t>(trajectory.bodies) / most_states;
    double most = 0;
    std::vector<State3> states(trajectory.bodies);
    for (std::int64_t sample = 0; sample < samples; sample += stride) {
        motion.all_at(static_cast<Real>(sample) / static_cast<Real>(per_second), states);
        for (std::size_t row = 0; row < trajectory.bodies; ++row)
            most = std::max(most, distance(states[row].x, trajectory.at(sample, row).x));
    }
    return most;
}

/// The number of samples before 100 × the uncertainty exceeds `tolerable`.
std::int64_t count_usable(const std::vector<Uncertainty>& uncertainties, double tolerable) {
    const auto bad = std::ranges::find_if(uncertainties, [&](const Uncertainty& uncertainty) {
        return !(margin * uncertainty.position <= tolerable);
    });
    return std::max<std::int64_t>(1, bad - uncertainties.begin());
}

/// The times of all samples up to `until`, s.
std::vector<double> times_of(const SampleTimes& samples, double until) {
    std::vector<double> times;
    for (std::int64_t sample = 0; sample < samples.count && samples.time(sample) < until; ++sample)
        times.push_back(samples.time(sample));
    times.push_back(until);
    return times;
}

class ReferenceBuilder {
public:
    ReferenceBuilder(const Scene& scene, const ReferenceEffort& effort, const Perturbation& start)
        : scene_(scene), effort_(effort), start_(make_exact_bodies(scene, start)) {
        require_measurable(scene);
        reference_.start = start;
        reference_.conservative = is_conservative(start_);
    }

    Reference run(const ClosedForm& closed_form) {
        auto motions = closed_form(start_, scene_.duration);
        if (motions)
            take(std::make_shared<ExactMotions>(std::move(*motions)));
        else
            take_fine_steps();
        return finish();
    }

private:
    [[nodiscard]] std::vector<double> probes(double until) const {
        return reference_.closed_form ? probe_times(until, fastest_motion(start_), start_.size())
                                      : times_of(reference_.samples, until);
    }

    /// The density of samples that leaves work for the fewest runs.
    [[nodiscard]] Density density(double per_period, const ReferenceEffort& effort) const {
        return {.per_period = per_period,
                .bodies = static_cast<std::int64_t>(start_.size()),
                .most_per_second = most_samples(scene_, effort) / scene_.duration};
    }

    void take(std::shared_ptr<const Motion> motion) {
        reference_.closed_form = true;
        reference_.motion = std::move(motion);
        reference_.samples = sample_times_of(scene_, start_);
        reference_.uncertainties =
            uncertainties_of(scales_of(*reference_.motion, probes(scene_.duration), start_),
                             reference_.samples, rounding_of(start_));
        reference_.words = "the closed form of the motion";
        // A perturbed start has the same forces as the scene's start, which is checked.
        if (reference_.start.seed == 0) check();
    }
    void take_fine_steps() {
        reference_.closed_form = false;
        reference_.samples = sample_times_of(scene_, start_, density(48, effort_));
        FineSteps fine = fine_steps(scene_, reference_.start, reference_.samples, effort_);
        require_finite(fine);
        std::vector<double> between =
            interpolation_errors(fine.trajectory, reference_.samples.per_second, jumps());
        if (const auto samples = finer_samples(fine, between)) {
            FineSteps again = fine_steps(scene_, reference_.start, *samples, effort_);
            if (again.sufficient) {
                fine = std::move(again);
                reference_.samples = *samples;
                between = interpolation_errors(fine.trajectory, samples->per_second, jumps());
            }
        }
        if (effort_.stopped()) return;
        first_order_ = fine.first_order;
        follow(fine);
        reference_.uncertainties = std::move(fine.uncertainties);
        for (std::size_t sample = 0; sample < between.size(); ++sample) {
            reference_.uncertainties[sample].position += between[sample];
            reference_.uncertainties[sample].velocity +=
                between[sample] * static_cast<double>(reference_.samples.per_second);
        }
        reference_.words = std::move(fine.words);
        reference_.motion = std::make_shared<SampledMotion>(
            std::move(fine.trajectory), reference_.samples.per_second, fastest_motion(start_));
    }

    /// Whether accelerations may jump within an interval, where a body stops, slips or leaves a
    /// face.
    [[nodiscard]] bool jumps() const { return scene_.has_obstacles(); }
    /// Samples by which the error between them falls below the wanted error, if that is within
    /// reach and the steps themselves meet it.
    [[nodiscard]] std::optional<SampleTimes> finer_samples(
        const FineSteps& fine, const std::vector<double>& between) const {
        // Of polynomials of degree 7; less where a linked body lands and changes the forces on
        // others.
        const double order = fine.first_order || jumps() ? 2 : 8;
        const double most_times = jumps() ? 32 : 8;
        const double own = fine.sufficient_error;
        const double wanted = fine.first_order ? own / 2 : own;
        const bool may_refine = effort_.wanted > 0 || fine.first_order;
        if (effort_.stopped() || !may_refine || between.empty() || between.back() <= wanted ||
            fine.uncertainties.back().position > own)
            return std::nullopt;
        const double times = std::ceil(2 * std::pow(between.back() / wanted, 1 / order));
        if (!(times <= most_times)) return std::nullopt;
        Density more = density(48, effort_);
        more.times = times;
        const SampleTimes samples = sample_times_of(scene_, start_, more);
        if (samples.per_second <= reference_.samples.per_second) return std::nullopt;
        return samples;
    }

    void check() {
        ReferenceEffort effort = effort_;
        const Scales scales = scales_of(*reference_.motion, probes(scene_.duration), start_);
        effort.wanted = checked_to * scales.extent;
        effort.most_work = std::min(effort.most_work, checking_work);
        const SampleTimes samples = sample_times_of(scene_, start_, density(12, effort));
        FineSteps fine = fine_steps(scene_, reference_.start, samples, effort);
        if (fine.trajectory.states.empty()) {
            reference_.words += "; not checked by fine steps: too much work";
            return;
        }
        const std::int64_t usable = count_usable(fine.uncertainties, 10 * margin * effort.wanted);
        if (usable < 2) {
            reference_.words += "; not checked by fine steps: too coarse";
            return;
        }
        const double apart =
            largest_difference(*reference_.motion, fine.trajectory, samples.per_second, usable);
        const auto last = static_cast<std::size_t>(usable - 1);
        const double own = reference_.uncertainties.back().position;
        const double allowed = margin * (fine.uncertainties[last].position + own);
        if (apart <= allowed) {
            reference_.words +=
                fmt::format(", confirmed by fine steps to {}",
                            length_text(std::max(apart, fine.uncertainties[last].position)));
            if (usable < samples.count)
                reference_.words +=
                    fmt::format(" for the first {:.3g} s", samples.time(usable - 1));
            return;
        }
        take_fine_steps();
        reference_.words += fmt::format(
            "; closed form rejected: it differs by {} from fine steps, whose own error is {}",
            length_text(apart), length_text(fine.uncertainties[last].position));
    }

    /// Measures the distances of a run of the same steps in double, sample by sample. Fine steps in
    /// double have that round-off in their own error.
    void follow(const FineSteps& fine) {
        if (fine.stepping.precision != Precision::extended) {
            round_off_.assign(static_cast<std::size_t>(reference_.samples.count), 0);
            return;
        }
        Stepping in_double = fine.stepping;
        in_double.precision = Precision::double_;
        Follower follower(scene_, Settings{in_double}, reference_.start,
                          reference_.samples.per_second);
        double most = 0;
        for (std::int64_t sample = 0; sample < reference_.samples.count && !effort_.stopped();
             ++sample) {
            if (!follower.go_to(sample)) break;
            for (std::size_t row = 0; row < fine.trajectory.bodies; ++row)
                most = larger(most, distance(follower.bodies().state(row).x,
                                             fine.finest_run.at(sample, row).x));
            round_off_.push_back(most);
        }
    }
    [[nodiscard]] std::int64_t count_followed(double most) const {
        if (reference_.closed_form) return reference_.samples.count;
        return std::ranges::count_if(round_off_, [&](double error) { return error <= most; });
    }

    /// Shortens the meaningful time until the scales of the remaining time shorten it no further.
    void find_meaningful() {
        std::int64_t count = reference_.samples.count;
        reference_.meaningful_until = scene_.duration;
        for (;;) {
            const Scales scales =
                scales_of(*reference_.motion, probes(reference_.meaningful_until), start_);
            reference_.extent = scales.extent;
            reference_.coordinate = scales.coordinate;
            reference_.speed = scales.speed;
            reference_.energy_scale = scales.energy;
            // Round-off does not make a scene with little motion chaotic.
            const double most =
                std::max(resolution * scales.extent,
                         margin * std::numeric_limits<double>::epsilon() * scales.coordinate);
            const std::int64_t usable = count_usable(reference_.uncertainties, most);
            const std::int64_t followed = count_followed(most);
            const std::int64_t left = std::max<std::int64_t>(2, std::min(usable, followed));
            if (left >= count) return;
            count = left;
            reference_.meaningful_until =
                std::min(scene_.duration, reference_.samples.time(count - 1));
            reference_.why_no_longer = explain(most, followed < usable);
        }
    }
    [[nodiscard]] std::string explain(double most, bool by_round_off) const {
        if (first_order_)
            return fmt::format(
                "the reference's own error then exceeds {}: {} by every method, which takes too "
                "fine steps",
                length_text(most / margin),
                scene_.has_ropes() ? "ropes become taut with order 1 or 2"
                                   : "linked bodies land with order 1");
        return by_round_off
                   ? fmt::format(
                         "round-off of double alone then moves bodies by more than {}: the motion "
                         "is chaotic",
                         length_text(most))
                   : fmt::format(
                         "the reference's own error then exceeds {}: the motion is chaotic, or a "
                         "finer reference is too much work",
                         length_text(most / margin));
    }

    void require_finite(const FineSteps& fine) const {
        if (effort_.stopped() || !fine.trajectory.states.empty()) return;
        if (fine.has_too_many_impacts)
            fail(
                Exit::usage,
                "a body meets planes more than {} times, which is too much work: shorten the scene "
                "with --duration",
                most_impacts);
        if (!fine.affordable)
            fail(Exit::usage,
                 "a reference for {} s takes too much work: shorten it with --duration",
                 scene_.duration);
        fail(Exit::diverged,
             "no reference stays finite over {} s: the scene is too stiff, or a body hits an "
             "attractor; shorten it with --duration",
             scene_.duration);
    }

    Reference finish() {
        if (effort_.stopped()) return std::move(reference_);
        find_meaningful();
        for (Uncertainty& uncertainty : reference_.uncertainties)
            uncertainty.energy = std::max(reference_.share_of_energy(uncertainty.energy),
                                          8 * std::numeric_limits<double>::epsilon());
        reference_.oscillation = find_oscillation(reference_);
        return std::move(reference_);
    }

    const Scene& scene_;
    const ReferenceEffort& effort_;
    Bodies start_;
    Reference reference_;
    bool first_order_ = false;
    std::vector<double> round_off_;  ///< m, of a run of the fine steps in double, up to each sample
};

}  // namespace

double Reference::share_of_energy(double joules) const {
    return energy_scale > 0 ? joules / energy_scale : joules;
}

bool rests(const Reference& reference) {
    constexpr double at_rest = 1e-9;
    return reference.extent <= at_rest * reference.coordinate;
}

Uncertainty Reference::floor() const {
    const auto last = static_cast<std::size_t>(std::min(
        samples.count - 1,
        static_cast<std::int64_t>(
            std::ceil(meaningful_until * static_cast<double>(samples.per_second) * (1 - 1e-12)))));
    const Uncertainty& most = uncertainties[last];
    return {margin * most.position, margin * most.velocity, margin * most.energy};
}

Reference make_reference(const Scene& scene, const ReferenceEffort& effort,
                         const Perturbation& start, const ClosedForm& closed_form) {
    return ReferenceBuilder(scene, effort, start).run(closed_form);
}

TrueEnergy::TrueEnergy(const Scene& scene, const Reference& reference)
    : reference_(reference),
      bodies_(std::make_unique<Bodies>(make_exact_bodies(scene, reference.start))),
      states_(bodies_->size()),
      at_start_(bodies_->energy().total()) {}

TrueEnergy::~TrueEnergy() = default;

double TrueEnergy::at(Real t) {
    if (reference_.conservative) return at_start_;
    reference_.motion->all_at(t, states_);
    return of(states_);
}

double TrueEnergy::of(std::span<const State3> states) {
    if (reference_.conservative) return at_start_;
    for (std::size_t row = 0; row < states.size(); ++row) bodies_->set_state(row, states[row]);
    return bodies_->energy().total();
}

}  // namespace oiler::lab
