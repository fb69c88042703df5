// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

constexpr std::int64_t steps_per_sample = 32;

/// The energies of a run at its samples, up to a divergence.
struct Course {
    std::vector<Energy> energies{};
    std::optional<Divergence> divergence{};
    std::size_t fastest = 0;  ///< the row with the largest speed at the end
};

std::size_t fastest_row(const Bodies& bodies) {
    std::size_t fastest = 0;
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (squared_length(bodies.velocity(row)) > squared_length(bodies.velocity(fastest)))
            fastest = row;
    return fastest;
}

Course run(Bodies bodies, const Method& method, Steps steps, std::int64_t samples) {
    Course course{{bodies.energy()}};
    for (; samples > 0; --samples, steps.first += steps.count) {
        course.divergence = bodies.try_step(method, steps);
        if (course.divergence) break;
        course.energies.push_back(bodies.energy());
    }
    course.fastest = course.divergence ? course.divergence->row : fastest_row(bodies);
    return course;
}

/// The number of samples that take some tens of milliseconds at most, within the run if its length
/// is known.
std::int64_t samples_of(const Bodies& bodies, const Method& method, const Steps& steps) {
    const double most_steps =
        steps.count > 1 ? std::min(16'384.0, static_cast<double>(steps.count)) : 16'384.0;
    constexpr double most_work = 4e6;
    constexpr std::size_t most_implicit = 64;
    if (is_implicit(method) && bodies.size() > most_implicit) return 0;
    const double work = static_cast<double>(bodies.size() + 2 * bodies.link_count()) *
                        (is_implicit(method) ? 80 : 1);
    return static_cast<std::int64_t>(std::min(most_steps, most_work / work)) / steps_per_sample;
}

/// A trial that explodes.
struct Explosion {
    std::size_t row;
    std::int64_t tick;  ///< since the start of the trial
    double gain;        ///< relative to the energies of finer steps; infinite: it diverges
};

/// Whether attraction holds all potential energy, so that the total energy is that of binding.
bool is_only_attracted(const Bodies& bodies) {
    const auto attracts = []<class Force>() { return std::is_same_v<Force, Attractor>; };
    const auto holds_other = []<class Force>() {
        return LineSpring<Force> || std::is_same_v<Force, Spring> || std::is_same_v<Force, Gravity>;
    };
    return bodies.link_count() == 0 && any_body_has(bodies, attracts) &&
           !any_body_has(bodies, holds_other);
}

/// Whether a rope may keep the energy that a taut phase gains, which no later one takes back: the
/// energy of a symplectic method returns.
bool has_spikes(const Bodies& bodies, const Method& method) {
    if (method.symplectic) return false;
    for (std::size_t i = 0; i < bodies.link_count(); ++i)
        if (bodies.link_at(i).pulls_only) return true;
    return false;
}

/// Compares the energies of a run with those of pefrl at 8 times the rate: they are too large by
/// its largest kinetic energy or its range of potential energy so far, or by half of the energy of
/// binding, for 16 samples or up to the end; with spikes by half of it in one sample. Without
/// sources energy never rises: where that of the finer steps does, after a passage that they do not
/// resolve either, the lowest so far counts.
std::optional<Explosion> explosion_of(const Bodies& bodies, const Course& course,
                                      const Steps& steps, bool spikes) {
    constexpr std::int64_t finer = 8;
    const std::size_t enough = spikes ? 1 : 16;
    Bodies fine = bodies;
    Steps fine_steps{{steps.rate.steps * finer, steps.rate.seconds},
                     steps.first * finer,
                     steps_per_sample * finer};
    const double smallest = 1e-9 * std::abs(course.energies.back().total());
    double lowest = fine.energy().potential;
    double highest = lowest;
    double scale = smallest;
    double total = fine.energy().total();
    const bool is_bound = is_only_attracted(bodies);
    Explosion first{course.fastest, 0, 0};
    std::size_t in_a_row = 0;
    for (std::size_t i = 0; i < course.energies.size() && in_a_row < enough; ++i) {
        const Energy now = fine.energy();
        lowest = std::min(lowest, now.potential);
        highest = std::max(highest, now.potential);
        scale = std::max({scale, now.kinetic, highest - lowest});
        total = std::min(total, now.total());
        const double gain = course.energies[i].total() - total;
        const double size = is_bound ? std::abs(total) : scale;
        const bool is_large = gain > (is_bound || spikes ? size / 2 : size);
        in_a_row = is_large ? in_a_row + 1 : 0;
        if (in_a_row == 1) first.tick = static_cast<std::int64_t>(i) * steps_per_sample;
        first.gain = gain / size;
        if (fine.try_step(find_method("pefrl"), fine_steps)) break;
        fine_steps.first += fine_steps.count;
    }
    return in_a_row > 0 ? std::optional(first) : std::nullopt;
}

/// Whether a run ends with more energy than it began with, or ever has more.
bool gains_energy(const Course& course, bool ever) {
    const double first = course.energies.front().total();
    const auto is_more = [&](const Energy& at) { return at.total() - first > 0.1 * at.kinetic; };
    return ever ? std::ranges::any_of(course.energies, is_more) : is_more(course.energies.back());
}

std::optional<Explosion> explosion_of(const Bodies& bodies, const Method& method,
                                      const Steps& steps, std::int64_t samples) {
    const Course course =
        run(bodies, method, {steps.rate, steps.first, steps_per_sample, steps.damping}, samples);
    if (course.divergence)
        return Explosion{course.fastest, course.divergence->tick - steps.first, INFINITY};
    const bool spikes = has_spikes(bodies, method);
    if (has_sources(bodies) || !gains_energy(course, spikes)) return std::nullopt;
    return explosion_of(bodies, course, steps, spikes);
}

/// The spring risks of the first of eight states up to the explosion that has any.
std::vector<Risk> spring_risks_of(Bodies bodies, Region& region, Steps steps,
                                  std::int64_t explosion) {
    std::vector<Risk> risks;
    steps.count = std::max<std::int64_t>(explosion / 8, 1);
    for (std::int64_t tick = 0; tick < explosion && risks.empty(); tick += steps.count) {
        if (bodies.try_step(region.method(), steps)) break;
        steps.first += steps.count;
        add_spring_risks(bodies, region, steps.rate.dt(), risks);
    }
    return risks;
}

/// Whether bodies whose trial explodes in float, far from the origin, hold in double.
bool is_of_float(const Bodies& bodies, const Method& method, const Steps& steps, std::size_t row) {
    if (bodies.precision() != Precision::single) return false;
    if (coarse_unit(bodies, row, steps.rate.dt()) == 0) return false;
    const Bodies exact = in_double(bodies);
    return !explosion_of(exact, method, steps, samples_of(exact, method, steps));
}

Risk float_risk(const Bodies& bodies, const Explosion& explosion) {
    return {.row = explosion.row,
            .of = Risk::Of::rounded_position,
            .message = fmt::format(
                "position of body {{}}: its last place in float is {:.3g} m, and a trial {} at "
                "step {}, in double it does not: take precision double, or an origin nearer to it",
                last_place(largest(bodies.position(explosion.row)), Precision::single),
                std::isfinite(explosion.gain) ? "gains energy" : "diverges", explosion.tick)};
}

}  // namespace

bool has_sources(const Bodies& bodies) {
    return any_body_has(bodies, []<class Force>() {
        return std::is_same_v<Force, Drive> || std::is_same_v<Force, Wind>;
    });
}

bool meets_obstacles(const Bodies& bodies) {
    if (!bodies.has_obstacles()) return false;
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (bodies.contact(row)) return true;
    return false;
}

bool is_linear(const Bodies& bodies) {
    for (std::size_t i = 0; i < bodies.link_count(); ++i)
        if (bodies.link_at(i).rest_length != 0) return false;
    return !any_body_has(bodies,
                         []<class Force>() { return !Linear<Force> && !DependsOnTime<Force>; });
}

void add_trial_risks(const Bodies& bodies, Region& region, const Steps& steps,
                     std::vector<Risk>& risks) {
    const Method& method = region.method();
    if (std::holds_alternative<ExactFlow>(method.rule) || bodies.size() == 0) return;
    if (is_linear(bodies) || meets_obstacles(bodies)) return;
    const auto explosion = explosion_of(bodies, method, steps, samples_of(bodies, method, steps));
    if (!explosion) return;
    risks = spring_risks_of(bodies, region, steps, explosion->tick);
    if (!risks.empty()) return;
    if (is_of_float(bodies, method, steps, explosion->row)) {
        risks.push_back(float_risk(bodies, *explosion));
        return;
    }
    risks.push_back({.row = explosion->row,
                     .of = Risk::Of::explosion,
                     .at = explosion->gain,
                     .tick = explosion->tick,
                     .tried = std::make_shared<const Bodies>(bodies)});
}

double trial_limit(const Risk& risk, const Method& method, const Steps& steps) {
    const double samples = static_cast<double>(risk.tick) / steps_per_sample + 32;
    const Descent descent = descend(0.85, 0.1, [&](double factor) {
        const Steps shorter{scaled_rate(steps.rate, factor), 0, 1, steps.damping};
        return !explosion_of(*risk.tried, method, shorter,
                             static_cast<std::int64_t>(samples / factor));
    });
    return descent.found ? descent.stable : 0;
}

}  // namespace oiler
