// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "oiler/core/error.hpp"
#include "oiler/stability/oscillations.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

/// Whether a method may not follow a drive of some periods per step. With n steps per period, an
/// error of a frequency by h²/6, h = 2π/n, as rk2_heun has it, shifts a resonance in a trial of 512
/// steps by 512h³/6 rad: 1.5 rad for n = 24, a tenth of the amplitude. Methods of order 1 sample a
/// force at one end of the step, which adds F·sin(φ)·dt/2 to the speed, however slow the drive is.
bool may_miss(const Method& method, double periods) {
    constexpr double enough_steps = 24;
    return periods > 0 && (method.order == 1 || periods * enough_steps > 1);
}
/// Steps per period with which methods of order 2 keep the amplitude to 2.3 %.
constexpr double recommended_steps = 12;
/// Steps per period of the finer run, the most of its steps in one step, and of which it samples
/// each second one.
constexpr double fine_steps = 4 * recommended_steps;
constexpr double most_parts = 1024;
constexpr std::int64_t steps_per_probe = 2;

/// Calls f(index, drive) for each drive on a body, per unit mass.
template <class F>
void for_each_drive_on(const Bodies& bodies, std::size_t row, F f) {
    for (std::size_t index = 0; index < bodies.most_forces_of_a_kind(); ++index)
        if (const auto drive = std::get<std::optional<Drive>>(bodies.forces_per_mass(row, index));
            drive && squared_length(drive->amplitude) > 0)
            f(index, *drive);
}

/// The highest frequency of the drives on a body that are slower than a limit, Hz.
double drive_frequency(const Bodies& bodies, std::size_t row, double limit = INFINITY) {
    double highest = 0;
    for_each_drive_on(bodies, row, [&](std::size_t, const Drive& drive) {
        if (const double frequency = std::abs(drive.frequency); frequency < limit)
            highest = std::max(highest, frequency);
    });
    return highest;
}

double highest_frequency(const Bodies& bodies, double limit) {
    double highest = 0;
    for (std::size_t row = 0; row < bodies.size(); ++row)
        highest = std::max(highest, drive_frequency(bodies, row, limit));
    return highest;
}

/// The same bodies with and without their drives, stepped side by side.
class DrivenPair {
public:
    explicit DrivenPair(const Bodies& bodies)
        : driven_(bodies), free_(bodies), oscillation_(bodies.size()) {
        for (std::size_t row = 0; row < bodies.size(); ++row) free_.detach<Drive>(row);
    }
    /// Replaces the drives from a frequency on by their mean: F·sin(ωt + φ) adds F·cos(φ)/(mω) to
    /// the velocity at the start, and then oscillates by F/(mω²).
    void average_from(double limit, double time) {
        for (std::size_t row = 0; row < driven_.size(); ++row)
            for_each_drive_on(Bodies(driven_), row, [&](std::size_t index, const Drive& drive) {
                if (std::abs(drive.frequency) < limit) return;
                constexpr double turn = 2 * std::numbers::pi;
                const double omega = turn * drive.frequency;
                const double angle = turn * std::fmod(drive.frequency * time, 1) + drive.phase;
                driven_.set_velocity(
                    row, driven_.velocity(row) + drive.amplitude * (std::cos(angle) / omega));
                oscillation_[row] +=
                    length(drive.amplitude) / (omega * omega) * (1 + std::abs(std::sin(angle)));
                driven_.attach_at(index, row, Drive{.frequency = drive.frequency});
            });
    }
    [[nodiscard]] bool step(const Method& method, const Steps& steps) {
        return !driven_.try_step(method, steps) && !free_.try_step(method, steps);
    }
    [[nodiscard]] Vec3 position(std::size_t row) const { return driven_.position(row); }
    /// The way by which the drives have moved a body, m.
    [[nodiscard]] double effect(std::size_t row) const {
        return length(driven_.position(row) - free_.position(row)) + oscillation_[row];
    }

private:
    Bodies driven_;
    Bodies free_;
    std::vector<double> oscillation_;  ///< m
};

/// The largest effects of the drives on a body in a run and in one with finer steps.
struct DriveEffect {
    double run = 0;      ///< m
    double fine = 0;     ///< m, at the same times
    double between = 0;  ///< m, of the run with finer steps at all times
    double extent = 0;   ///< m, the largest distance from the start in the run with finer steps
    double time = 0;     ///< s, of the runs

    /// By a tenth of the effect, and a twentieth of the motion.
    [[nodiscard]] bool is_wrong() const {
        const double error = std::abs(run - fine);
        return error > 0.1 * fine && error > 0.05 * extent;
    }
};

/// A method of order 2 that is as stable: a method of order 1 keeps much of its error at finer
/// steps.
const Method& finer_method(const Method& method) {
    return find_method(is_implicit(method) ? "implicit_midpoint" : "velocity_verlet");
}

/// Runs so many steps or fewer, which take some tens of milliseconds; empty if a run diverges.
std::vector<DriveEffect> drive_effects(const Bodies& bodies, const Method& method,
                                       const Steps& steps) {
    constexpr double most_work = 400'000;
    const double dt = steps.rate.dt();
    const double limit = most_parts / (fine_steps * dt);
    const double per_step = std::ceil(fine_steps * highest_frequency(bodies, limit) * dt);
    const auto parts = steps_per_probe *
                       static_cast<std::int64_t>(std::clamp(std::ceil(per_step / steps_per_probe),
                                                            2.0, most_parts / steps_per_probe));
    const double work = static_cast<double>(parts) * static_cast<double>(bodies.size());
    const std::int64_t count =
        std::min(steps.count, static_cast<std::int64_t>(std::max(most_work / work, 16.0)));
    const Rate fine_rate{steps.rate.steps * parts, steps.rate.seconds};
    const Method& finer = finer_method(method);
    DrivenPair run(bodies);
    DrivenPair fine(bodies);
    fine.average_from(limit, static_cast<double>(steps.first) * dt);
    std::vector<DriveEffect> effects(bodies.size());
    for (std::int64_t tick = steps.first; tick < steps.first + count; ++tick) {
        if (!run.step(method, {steps.rate, tick, 1, steps.damping})) return {};
        for (std::int64_t part = 0; part < parts; part += steps_per_probe) {
            if (!fine.step(finer, {fine_rate, tick * parts + part, steps_per_probe})) return {};
            for (std::size_t row = 0; row < effects.size(); ++row)
                effects[row].between = std::max(effects[row].between, fine.effect(row));
        }
        for (std::size_t row = 0; row < effects.size(); ++row) {
            DriveEffect& one = effects[row];
            one.run = std::max(one.run, run.effect(row));
            one.fine = std::max(one.fine, fine.effect(row));
            one.extent =
                std::max({one.extent, one.fine, length(fine.position(row) - bodies.position(row))});
            one.time = static_cast<double>(tick + 1 - steps.first) * dt;
        }
    }
    return effects;
}

bool follows_drives(const Bodies& bodies, std::size_t row, const Method& method,
                    const Steps& steps) {
    const std::vector<DriveEffect> effects = drive_effects(bodies, method, steps);
    return !effects.empty() && !effects[row].is_wrong();
}

/// A method of order 2 in place of one of order 1, and the lowest rate of at least the recommended
/// steps that is tried with success.
std::string remedy_of(const Bodies& bodies, std::size_t row, double frequency, const Method& method,
                      const Steps& steps) {
    constexpr double longest = 4096;
    const Method& better = method.order == 1 ? finer_method(method) : method;
    const bool changes = &better != &method;
    if (changes && follows_drives(bodies, row, better, {steps.rate, steps.first, steps.count}))
        return fmt::format("take {}", better.name);
    const double least = std::max(recommended_steps * frequency, 1.25 / steps.rate.dt());
    for (double hertz = std::ceil(least); hertz <= highest_rate; hertz = std::ceil(1.25 * hertz)) {
        const auto count = static_cast<std::int64_t>(
            std::min(static_cast<double>(steps.count) * hertz * steps.rate.dt(), longest));
        Steps finer{{std::llround(hertz)}, 0, count};
        if (!changes) finer.damping = steps.damping;
        if (follows_drives(bodies, row, better, finer))
            return changes ? fmt::format("take {} at a rate ≥ {:.0f} Hz", better.name, hertz)
                           : fmt::format("rate ≥ {:.0f} Hz", hertz);
    }
    return fmt::format("no rate up to {:.0f} Hz follows it: lower its frequency", highest_rate);
}

/// The bodies with drives and those that are linked with them, with their rows.
struct Driven {
    Bodies bodies;
    std::vector<std::size_t> rows{};
};

Driven driven_of(const Bodies& bodies) {
    const std::vector<std::size_t> labels = component_labels(bodies);
    std::vector<bool> is_driven(bodies.size());
    Driven driven{bodies};
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        driven.rows.push_back(row);
        if (drive_frequency(bodies, row) > 0) is_driven[labels[row]] = true;
    }
    for (std::size_t i = bodies.size(); i-- > 0;) {
        if (is_driven[labels[i]]) continue;
        driven.bodies.remove(i);
        driven.rows[i] = driven.rows.back();
        driven.rows.pop_back();
    }
    return driven;
}

}  // namespace

void add_drive_risks(const Bodies& bodies, const Method& method, const Steps& steps,
                     std::vector<Risk>& risks) {
    constexpr std::size_t most_bodies = 2000;
    constexpr std::int64_t most_steps = 512;
    if (std::holds_alternative<ExactFlow>(method.rule)) return;
    if (!any_body_has(bodies, []<class Force>() { return std::is_same_v<Force, Drive>; })) return;
    const double dt = steps.rate.dt();
    if (!may_miss(method, highest_frequency(bodies, INFINITY) * dt)) return;
    const auto [driven, rows] = driven_of(bodies);
    if (driven.size() > most_bodies) return;
    const Steps tried{steps.rate, steps.first, most_steps, steps.damping};
    const std::vector<DriveEffect> effects = drive_effects(driven, method, tried);
    for (std::size_t row = 0; row < effects.size(); ++row) {
        const DriveEffect& of = effects[row];
        const double frequency = drive_frequency(driven, row);
        if (!may_miss(method, frequency * dt) || !of.is_wrong()) continue;
        risks.push_back(
            {.row = rows[row],
             .of = Risk::Of::told,
             .message = fmt::format(
                 "drive of body {{}}: {:.4g} Hz has {:.3g} steps per period and moves the body by "
                 "{:.3g} m in {:.3g} s instead of {:.3g} m: {}",
                 frequency, 1 / (frequency * dt), of.run, of.time, of.between,
                 remedy_of(driven, row, frequency, method, tried))});
    }
}

}  // namespace oiler
