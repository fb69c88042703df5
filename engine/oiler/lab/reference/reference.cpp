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

/// What is held against fine steps before it is believed.
constexpr double checked_to = 1e-9;  ///< of the extent
constexpr double checking_work = 2e7;

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

Track track_of(const std::vector<ExactMotion>& motions, const Looks& looks, Bodies bodies) {
    Track track{.bodies = motions.size()};
    for (std::int64_t look = 0; look < looks.count; ++look) {
        const Real t = static_cast<Real>(look) / static_cast<Real>(looks.per_second);
        for (std::size_t row = 0; row < motions.size(); ++row) {
            track.states.push_back(motions[row](t));
            bodies.set_state(row, track.states.back());
        }
        track.energies.push_back(bodies.energy().total());
    }
    return track;
}

/// Of a closed form: a few roundings of where the body is, and of the time that it took.
std::vector<Doubt> doubts_of(const Track& track, const Looks& looks, double rounding) {
    std::vector<Doubt> doubts;
    Doubt most{.energy = 8 * std::numeric_limits<double>::epsilon()};
    double x = 0;
    double v = 0;
    for (std::int64_t look = 0; look < looks.count; ++look) {
        for (std::size_t row = 0; row < track.bodies; ++row) {
            x = std::max(x, static_cast<double>(largest(track.at(look, row).x)));
            v = std::max(v, static_cast<double>(largest(track.at(look, row).v)));
        }
        const double turned = x > 0 ? 1 + v * looks.time(look) / x : 1;
        most.position = rounding * (8 * x + v * looks.time(look));
        most.velocity = rounding * v * (8 + turned);
        doubts.push_back(most);
    }
    return doubts;
}

double largest_coordinate(const Track& track) {
    double most = 0;
    for (const State3& state : track.states)
        most = std::max(most, static_cast<double>(largest(state.x)));
    return most;
}

/// The energy at the start; where that is next to nothing, because it depends on where nought is,
/// the largest kinetic energy.
double energy_scale_of(const Track& track, Bodies bodies) {
    const std::size_t looks = track.energies.size();
    double kinetic = 0;
    for (std::size_t look = 0; look < looks; look += std::max<std::size_t>(1, looks / 200)) {
        for (std::size_t row = 0; row < track.bodies; ++row)
            bodies.set_state(row, track.at(static_cast<std::int64_t>(look), row));
        kinetic = std::max(kinetic, bodies.energy().kinetic);
    }
    const double at_start = std::abs(track.energies.front());
    return at_start > kinetic / 100 ? at_start : kinetic;
}

double largest_difference(const Track& a, const Track& b, std::int64_t looks) {
    double most = 0;
    for (std::int64_t look = 0; look < looks; ++look)
        for (std::size_t row = 0; row < a.bodies; ++row)
            most = std::max(most, distance(a.at(look, row).x, b.at(look, row).x));
    return most;
}

/// How many looks, until a hundred times the doubt is more than can be put up with.
std::int64_t count_good(const std::vector<Doubt>& doubts, double tolerable) {
    const auto bad = std::find_if(doubts.begin(), doubts.end(), [&](const Doubt& doubt) {
        return !(margin * doubt.position <= tolerable);
    });
    return std::max<std::int64_t>(1, bad - doubts.begin());
}

class Making {
public:
    Making(const Scene& scene, const Looks& looks, const ReferenceEffort& effort)
        : scene_(scene),
          effort_(effort),
          start_(make_world(scene, Settings{{scene.stepping.method, scene.stepping.rate, Precision::extended}})
                     .bodies()) {
        reference_.looks = looks;
    }

    Reference run(const ClosedForm& closed_form) {
        const auto motions = closed_form(start_);
        if (motions)
            take(*motions);
        else
            take(fine_steps(scene_, reference_.looks, effort_));
        return finish();
    }

private:
    void take(const std::vector<ExactMotion>& motions) {
        reference_.closed_form = true;
        reference_.track = track_of(motions, reference_.looks, start_);
        reference_.doubts = doubts_of(reference_.track, reference_.looks, rounding_of(start_));
        reference_.words = "the closed form of the motion";
        check();
    }
    void take(FineSteps&& fine) {
        reference_.closed_form = false;
        affordable_ = fine.affordable;
        if (!fine.track.states.empty()) followed_ = count_followed(fine);
        reference_.track = std::move(fine.track);
        reference_.doubts = std::move(fine.doubts);
        reference_.words = std::move(fine.words);
    }

    void check() {
        ReferenceEffort effort = effort_;
        effort.wanted = checked_to * extent_of(reference_.track);
        effort.most_work = std::min(effort.most_work, checking_work);
        FineSteps fine = fine_steps(scene_, reference_.looks, effort);
        if (fine.track.states.empty()) {
            reference_.words += ", which fine steps were too long to check";
            return;
        }
        const std::int64_t good = count_good(fine.doubts, 10 * margin * effort.wanted);
        if (good < 2) {
            reference_.words += ", which fine steps were too coarse to check";
            return;
        }
        const double apart = largest_difference(reference_.track, fine.track, good);
        const auto last = static_cast<std::size_t>(good - 1);
        const double allowed =
            margin * (fine.doubts[last].position + reference_.doubts[last].position);
        if (apart <= allowed) {
            reference_.words += fmt::format(", which fine steps confirm to {:.2g} m",
                                            std::max(apart, fine.doubts[last].position));
            if (good < reference_.looks.count)
                reference_.words +=
                    fmt::format(" for the first {:.3g} s", reference_.looks.time(good - 1));
            return;
        }
        take(fine_steps(scene_, reference_.looks, effort_));
        reference_.words += fmt::format(
            "; the closed form is not believed: it differs by {:.3g} m, where fine steps are good "
            "to {:.2g} m",
            apart, fine.doubts[last].position);
    }

    /// How many looks until rounding to double alone leads a run of the same steps astray.
    [[nodiscard]] std::int64_t count_followed(const FineSteps& fine) const {
        const double most = std::max(
            resolution * extent_of(fine.track),
            margin * std::numeric_limits<double>::epsilon() * largest_coordinate(fine.track));
        Follower follower(scene_, Settings{{fine.method, {fine.rate}, Precision::double_}},
                          reference_.looks.per_second);
        for (std::int64_t look = 0; look < reference_.looks.count && !effort_.stopped(); ++look) {
            if (!follower.go_to(look)) return look;
            for (std::size_t row = 0; row < fine.track.bodies; ++row)
                if (!(distance(follower.state(row).x, fine.finest_run.at(look, row).x) <= most))
                    return look;
        }
        return reference_.looks.count;
    }

    void find_meaningful() {
        // What hardly moves is not chaotic for being rounded.
        const double most = std::max(
            resolution * reference_.extent,
            margin * std::numeric_limits<double>::epsilon() * largest_coordinate(reference_.track));
        const std::int64_t good = count_good(reference_.doubts, most);
        reference_.meaningful = std::max<std::int64_t>(1, std::min(good, followed_));
        if (reference_.meaningful == reference_.looks.count) return;
        reference_.why_no_longer =
            followed_ < good
                ? fmt::format(
                      "rounding to double alone then moves bodies by more than {:.2g} m: the "
                      "motion is chaotic",
                      most)
                : fmt::format(
                      "the reference itself is then off by more than {:.2g} m: the motion "
                      "is chaotic, or too much work",
                      most / margin);
    }

    Reference finish() {
        if (effort_.stopped()) return std::move(reference_);
        if (reference_.track.states.empty() && !affordable_)
            fail(Exit::usage,
                 "a reference for {} s takes too much work: shorten it with --duration",
                 scene_.duration);
        if (reference_.track.states.empty())
            fail(Exit::diverged,
                 "no reference stays finite over {} s: the scene is too stiff, or meets an "
                 "attractor; shorten it with --duration",
                 scene_.duration);
        reference_.extent = extent_of(reference_.track);
        reference_.energy_scale = energy_scale_of(reference_.track, start_);
        for (Doubt& doubt : reference_.doubts)
            doubt.energy = std::max(reference_.share_of_energy(doubt.energy),
                                    8 * std::numeric_limits<double>::epsilon());
        find_meaningful();
        reference_.swing = find_swing(reference_.track, reference_.meaningful_looks());
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

double extent_of(const Track& track) {
    double extent = 0;
    for (std::size_t i = 0; i < track.states.size(); ++i)
        extent = std::max(extent, distance(track.states[i].x, track.states[i % track.bodies].x));
    return extent;
}

Doubt Reference::floor() const {
    const Doubt& last = doubts[static_cast<std::size_t>(meaningful - 1)];
    return {margin * last.position, margin * last.velocity, margin * last.energy};
}

Reference make_reference(const Scene& scene, const Looks& looks, const ReferenceEffort& effort,
                         const ClosedForm& closed_form) {
    return Making(scene, looks, effort).run(closed_form);
}

Work::Work(const Scene& scene) {
    const Bodies bodies = make_world(scene, Settings{scene.stepping}).bodies();
    const auto size = static_cast<double>(bodies.size());
    const auto links = static_cast<double>(bodies.link_count());
    per_evaluation_ = size + links;
    // A few of them; for a net as many factorisations of its matrix.
    to_solve_ = 4 * (links > 0 ? std::sqrt(size * scene.axes) : 1);
}

double Work::per_step(const Method& method) const {
    return per_evaluation_ * (method.evaluations > 0 ? method.evaluations : to_solve_);
}

}  // namespace oiler::lab
