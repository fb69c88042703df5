// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

/// Drives with more steps per period than this are followed by all methods.
constexpr double enough_steps = 8;
/// Steps per period with which methods of order 2 keep the amplitude to 2.3 %.
constexpr double recommended_steps = 12;

/// The highest frequency of the drives on a body, Hz.
double drive_frequency(const Bodies& bodies, std::size_t row) {
    double highest = 0;
    for_each_force_on(bodies, row, [&]<class Force>(const Force& force) {
        if constexpr (std::is_same_v<Force, Drive>)
            if (squared_length(force.amplitude) > 0)
                highest = std::max(highest, std::abs(force.frequency));
    });
    return highest;
}

/// The same bodies with and without their drives, stepped side by side.
class DrivenPair {
public:
    explicit DrivenPair(const Bodies& bodies) : driven_(bodies), free_(bodies) {
        for (std::size_t row = 0; row < bodies.size(); ++row) free_.detach<Drive>(row);
    }
    [[nodiscard]] bool step(const Method& method, const Steps& steps) {
        return !driven_.try_step(method, steps) && !free_.try_step(method, steps);
    }
    [[nodiscard]] Vec3 position(std::size_t row) const { return driven_.position(row); }
    /// The way by which the drives have moved a body, m.
    [[nodiscard]] double effect(std::size_t row) const {
        return std::sqrt(squared_length(driven_.position(row) - free_.position(row)));
    }

private:
    Bodies driven_;
    Bodies free_;
};

/// The largest effects of the drives on a body in a run and in one with finer steps.
struct DriveEffect {
    double run = 0;     ///< m
    double fine = 0;    ///< m
    double extent = 0;  ///< m, the largest distance from the start in the run with finer steps

    /// By a tenth of the effect, and a twentieth of the motion.
    [[nodiscard]] bool is_wrong() const {
        const double error = std::abs(run - fine);
        return error > 0.1 * fine && error > 0.05 * extent;
    }
};

/// Runs a few hundred steps; empty if a run diverges.
std::vector<DriveEffect> drive_effects(const Bodies& bodies, const Method& method,
                                       const Steps& steps, double frequency) {
    constexpr std::int64_t most_steps = 512;
    constexpr double most_work = 400'000;
    const auto parts = static_cast<std::int64_t>(
        std::clamp(std::ceil(4 * recommended_steps * frequency * steps.rate.dt()), 4.0, 1024.0));
    const double work = static_cast<double>(parts) * static_cast<double>(bodies.size());
    const std::int64_t count =
        std::min(most_steps, static_cast<std::int64_t>(std::max(most_work / work, 16.0)));
    const Rate fine_rate{steps.rate.steps * parts, steps.rate.seconds};
    DrivenPair run(bodies);
    DrivenPair fine(bodies);
    std::vector<DriveEffect> effects(bodies.size());
    for (std::int64_t tick = steps.first; tick < steps.first + count; ++tick) {
        if (!run.step(method, {steps.rate, tick, 1, steps.damping}) ||
            !fine.step(method, {fine_rate, tick * parts, parts, steps.damping}))
            return {};
        for (std::size_t row = 0; row < effects.size(); ++row) {
            DriveEffect& one = effects[row];
            const Vec3 moved = fine.position(row) - bodies.position(row);
            one.run = std::max(one.run, run.effect(row));
            one.fine = std::max(one.fine, fine.effect(row));
            one.extent = std::max(one.extent, std::sqrt(squared_length(moved)));
        }
    }
    return effects;
}

Risk risk_of(std::size_t row, double frequency, const DriveEffect& effect, const Rate& rate) {
    return {.row = row,
            .of = Risk::Of::told,
            .message = fmt::format(
                "drive of body {{}}: {:.4g} Hz has {:.3g} steps per period and moves the body by "
                "{:.3g} m instead of {:.3g} m: rate ≥ {:.0f} Hz",
                frequency, 1 / (frequency * rate.dt()), effect.run, effect.fine,
                std::ceil(recommended_steps * frequency))};
}

}  // namespace

void add_drive_risks(const Bodies& bodies, const Method& method, const Steps& steps,
                     std::vector<Risk>& risks) {
    constexpr std::size_t most_bodies = 2000;
    if (std::holds_alternative<ExactFlow>(method.rule) || bodies.size() > most_bodies) return;
    if (!any_body_has(bodies, []<class Force>() { return std::is_same_v<Force, Drive>; })) return;
    std::vector<double> frequencies;
    for (std::size_t row = 0; row < bodies.size(); ++row)
        frequencies.push_back(drive_frequency(bodies, row));
    const double highest = std::ranges::max(frequencies);
    if (highest * steps.rate.dt() * enough_steps <= 1) return;
    const std::vector<DriveEffect> effects = drive_effects(bodies, method, steps, highest);
    for (std::size_t row = 0; row < effects.size(); ++row)
        if (frequencies[row] * steps.rate.dt() * enough_steps > 1 && effects[row].is_wrong())
            risks.push_back(risk_of(row, frequencies[row], effects[row], steps.rate));
}

}  // namespace oiler
