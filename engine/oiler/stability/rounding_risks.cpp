// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

/// The least relative error of a change that is warned of.
constexpr double least_effect = 0.02;

/// The parts of a step's change that a method adds one by one, each with a rounding of its own.
struct AddedParts {
    std::vector<double> drifts{};  ///< of the position
    std::vector<double> kicks{};   ///< of the velocity
};

AddedParts parts_of(const Method& method) {
    AddedParts parts;
    if (const auto* splitting = std::get_if<Splitting>(&method.rule)) {
        for (const Stage& stage : splitting->stages())
            (stage.move == Move::drift ? parts.drifts : parts.kicks)
                .push_back(static_cast<double>(stage.coefficient));
    } else if (const auto* tableau = std::get_if<Tableau>(&method.rule)) {
        for (const long double weight : tableau->b)
            parts.drifts.push_back(static_cast<double>(weight));
        parts.kicks = parts.drifts;
    } else {
        parts.drifts = {1};
        // The change at an implicit stage is rounded, then multiplied by 1/a.
        const auto* implicit = std::get_if<ImplicitStage>(&method.rule);
        const double a = implicit ? static_cast<double>(implicit->a) : 1;
        parts.kicks.assign(static_cast<std::size_t>(std::lround(1 / a)), a);
    }
    return parts;
}

/// The relative error of a sum of changes from `first` to `last` that grow evenly, if their parts
/// are rounded to multiples of a unit; 0 if it is below least_effect.
double effect_of(const std::vector<double>& parts, double first, double last, double unit) {
    const double mean = (first + last) / 2;
    const double most = static_cast<double>(parts.size()) * unit / 2;
    if (mean == 0 || !(most >= least_effect * std::abs(mean))) return 0;
    constexpr int steps = 64;
    double sum = 0;
    for (int step = 0; step < steps; ++step) {
        const double change = first + (last - first) * (step + 0.5) / steps;
        for (const double part : parts) sum += std::nearbyint(part * change / unit) * unit;
    }
    const double effect = sum / (steps * mean) - 1;
    return std::abs(effect) >= least_effect ? effect : 0;  // NaN on an attractor
}

/// The motion of a body at a time, by all forces on it but those of links.
struct MotionOfRow {
    State<double, 3> state;
    Vec3 acceleration;  ///< m/s²
    Vec3 field;         ///< its part that does not depend on the velocity, m/s²
};

MotionOfRow motion_of(const Bodies& bodies, std::size_t row, const State<double, 3>& state,
                      double t) {
    MotionOfRow motion{state, {}, {}};
    for_each_force_on(bodies, row, [&](const auto& force) {
        motion.acceleration += accelerate(force, state, t);
        motion.field += field(force, state.x, t);
    });
    return motion;
}

/// The errors of one body, while its motion changes so little that they add up.
class RowRounding {
public:
    RowRounding(const Bodies& bodies, std::size_t row, const AddedParts& parts, double dt)
        : bodies_(bodies),
          row_(row),
          parts_(parts),
          dt_(dt),
          time_(std::max(1.0, 64 * dt)),
          now_(motion_of(bodies, row, {bodies.position(row), bodies.velocity(row)}, 0)) {}

    [[nodiscard]] std::optional<Risk> find() const {
        for (int axis = 0; axis < bodies_.axes(); ++axis)
            if (const double effect = effect_on_position(axis); effect != 0)
                return risk(Risk::Of::rounded_position, axis, now_.state.x[axis], effect);
        for (int axis = 0; axis < bodies_.axes(); ++axis)
            if (const double effect = effect_on_velocity(axis); effect != 0)
                return risk(Risk::Of::rounded_velocity, axis, now_.state.v[axis], effect);
        return std::nullopt;
    }

private:
    /// The state after some time at the present acceleration.
    [[nodiscard]] State<double, 3> at(double time) const {
        const Vec3 v = now_.state.v + now_.acceleration * time;
        return {now_.state.x + (now_.state.v + v) * (time / 2), v};
    }
    [[nodiscard]] Risk risk(Risk::Of of, int axis, double number, double effect) const {
        return {.row = row_,
                .of = of,
                .at = last_place(number, Precision::single),
                .axis = axis,
                .effect = effect};
    }
    /// The largest of f(motion) over the time in which errors add up.
    template <class F>
    [[nodiscard]] double largest_over_time(F f) const {
        double largest = std::abs(f(now_));
        for (const double part : {0.4, 1.0}) {
            const double time = part * time_;
            largest = std::max(largest, std::abs(f(motion_of(bodies_, row_, at(time), time))));
        }
        return largest;
    }

    [[nodiscard]] double effect_on_position(int axis) const {
        const double unit = last_place(now_.state.x[axis], Precision::single);
        const double v = now_.state.v[axis];
        const double effect = effect_of(parts_.drifts, v * dt_, at(time_).v[axis] * dt_, unit);
        if (effect == 0) return 0;
        const Vec3 mean = at(time_ / 2).v;
        if (std::abs(effect * mean[axis]) < least_effect / 10 * length(mean)) return 0;
        if (v == 0 && is_at_equilibrium(axis, unit)) return 0;
        const double a =
            largest_over_time([&](const MotionOfRow& motion) { return motion.acceleration[axis]; });
        return a * time_ * dt_ > unit / 4 ? 0 : effect;
    }
    /// Whether a motion by some last places changes the acceleration.
    [[nodiscard]] bool is_at_equilibrium(int axis, double unit) const {
        const double a = now_.acceleration[axis];
        State<double, 3> near = now_.state;
        near.x[axis] += std::copysign(8 * unit, a);
        return std::abs(motion_of(bodies_, row_, near, 0).acceleration[axis] - a) > std::abs(a) / 2;
    }
    [[nodiscard]] double effect_on_velocity(int axis) const {
        const double unit = last_place(now_.state.v[axis], Precision::single);
        const double a = now_.field[axis];
        const double effect = effect_of(parts_.kicks, a * dt_, a * dt_, unit);
        if (effect == 0) return 0;
        if (std::abs(effect * a) < least_effect * length(now_.acceleration)) return 0;
        const double change =
            largest_over_time([&](const MotionOfRow& motion) { return motion.field[axis] - a; });
        return change * dt_ > unit / 4 ? 0 : effect;
    }

    const Bodies& bodies_;
    std::size_t row_;
    const AddedParts& parts_;
    double dt_;
    double time_;  ///< s, in which errors add up
    MotionOfRow now_;
};

}  // namespace

void add_rounding_risks(const Bodies& bodies, const Method& method, const Steps& steps,
                        std::vector<Risk>& risks) {
    if (bodies.precision() != Precision::single) return;
    const AddedParts parts = parts_of(method);
    std::vector<bool> is_known(bodies.size());
    for (const Risk& risk : risks)
        if (is_rounding(risk)) is_known[risk.row] = true;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        if (is_known[row]) continue;
        if (const auto risk = RowRounding(bodies, row, parts, steps.rate.dt()).find())
            risks.push_back(*risk);
    }
}

}  // namespace oiler
