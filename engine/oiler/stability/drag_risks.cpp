// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

/// The drag of a body and its speeds.
struct Dragged {
    double linear = 0;     ///< 1/s
    double quadratic = 0;  ///< 1/m
    double gravity = 0;    ///< m/s²
    double speed = 0;      ///< m/s
    bool has_springs = false;
    bool has_other_forces = false;

    /// The speed at which drag balances gravity: b·v + c·v² = g.
    [[nodiscard]] double terminal_speed() const {
        const double root = std::sqrt(linear * linear + 4 * quadratic * gravity);
        return root > 0 ? 2 * gravity / (linear + root) : 0;
    }
};

template <class Force>
void include(const Force& force, const Vec3& velocity, Dragged& of) {
    if constexpr (Linear<Force>) {
        const LinearForce<double, 3> linear = linear_form(force);
        of.gravity = std::max(of.gravity, length(linear.constant));
        of.linear += linear.damping;
        of.has_springs = of.has_springs || linear.stiffness != 0;
    } else if constexpr (DragsInAir<Force>) {
        const auto [coefficient, air] = force.air_drag();
        of.quadratic += coefficient;
        of.speed = std::max(of.speed, length(velocity - air));
    } else if constexpr (LineSpring<Force>) {
        of.has_springs = of.has_springs || force.line_spring().stiffness != 0;
    } else {
        // Its speeds are not bounded by springs or gravity.
        of.has_other_forces = of.has_other_forces || acts(force);
    }
}

Dragged drag_of(const Bodies& bodies, std::size_t row) {
    Dragged of{.speed = std::sqrt(squared_length(bodies.velocity(row)))};
    for_each_force_on(bodies, row,
                      [&](const auto& force) { include(force, bodies.velocity(row), of); });
    return of;
}

/// A copy of one body with its forces, without links.
Bodies alone(const Bodies& bodies, std::size_t row) {
    Bodies copy(bodies.axes(), Precision::double_);
    for (std::size_t i = 0; i < std::max<std::size_t>(1, bodies.most_forces_of_a_kind()); ++i) {
        GivenForces forces = bodies.forces_per_mass(row, i);
        auto& gravity = std::get<std::optional<Gravity>>(forces);
        if (gravity) copy.set_gravity(gravity->acceleration);
        gravity.reset();
        if (i == 0)
            copy.add({.position = bodies.position(row), .velocity = bodies.velocity(row)}, forces);
        else
            std::apply(
                [&](const auto& skipped, const auto&... force) {
                    static_cast<void>(skipped);
                    ((force ? copy.attach_at(i, 0, *force) : void()), ...);
                },
                forces);
    }
    return copy;
}

/// Whether a body alone diverges within its first steps of dt·`factor`. Too strong a drag squares
/// the speed every step, so that few steps decide.
bool diverges(Bodies body, const Method& method, const Steps& steps, double factor) {
    constexpr std::int64_t count = 512;
    const Rate rate = factor == 1 ? steps.rate : scaled_rate(steps.rate, factor);
    return body.try_step(method, {rate, 0, count, steps.damping}).has_value();
}

/// The largest speed of a body that only springs hold, from its energy, m/s.
double largest_speed(const Dragged& of, const Bodies& alone) {
    const double start = std::max(of.speed, of.terminal_speed());
    if (!of.has_springs) return start;
    return std::max(of.speed, std::sqrt(2 * std::max(alone.energy().total(), 0.0)));
}

/// Whether a step makes a body of 1 m/s faster, for each c·|v|·dt.
std::vector<bool> speed_up(const Method& method, Damping damping, std::vector<double> drags) {
    Bodies bodies(1, Precision::extended);
    for (const double drag : drags) bodies.add({.velocity = {1}}, QuadraticDrag{drag});
    std::vector<bool> faster(drags.size(), true);
    if (bodies.try_step(method, {.rate = {1}, .damping = damping})) return faster;
    for (std::size_t row = 0; row < drags.size(); ++row)
        faster[row] = !(std::abs(bodies.state(row).v[0]) <= 1 + 1e-14L);
    return faster;
}

}  // namespace

double quadratic_drag_limit(const Method& method, Damping damping) {
    std::vector<double> drags;
    for (double drag = 0.05; drag < 1000; drag *= 1.01) drags.push_back(drag);
    double low = 0;
    double high = std::numeric_limits<double>::infinity();
    const std::vector<bool> faster = speed_up(method, damping, drags);
    for (std::size_t i = 0; i < drags.size() && std::isinf(high); ++i)
        (faster[i] ? high : low) = drags[i];
    if (std::isinf(high)) return high;
    return edge_between(low, high, 1e-14,
                        [&](double drag) { return !speed_up(method, damping, {drag}).front(); });
}

namespace {

class DragTest {
public:
    DragTest(const Bodies& bodies, Region& region, const Steps& steps)
        : bodies_(bodies),
          region_(region),
          steps_(steps),
          limit_(quadratic_drag_limit(region.method(), region.damping())) {}

    void add_risks(std::size_t row, bool linked, std::vector<Risk>& risks) {
        const Dragged of = drag_of(bodies_, row);
        if (!(of.quadratic > 0)) return;
        if (linked || of.has_other_forces || !std::isfinite(of.speed))
            add_by_speed(row, of, risks);
        else
            add_by_trial(row, of, risks);
        if (linked || of.has_other_forces || of.has_springs || of.gravity == 0) return;
        Risk risk{.row = row, .of = Risk::Of::terminal_speed, .at = of.terminal_speed()};
        risk.damping_dt = (of.linear + 2 * of.quadratic * risk.at) * steps_.rate.dt();
        if (!region_.contains({0, risk.damping_dt})) risks.push_back(risk);
    }

private:
    [[nodiscard]] Risk risk_at(std::size_t row, const Dragged& of, double speed) const {
        return {.row = row,
                .damping_dt = (of.linear + of.quadratic * speed) * steps_.rate.dt(),
                .of = Risk::Of::quadratic_drag,
                .at = speed};
    }
    void add_by_speed(std::size_t row, const Dragged& of, std::vector<Risk>& risks) const {
        const Risk risk = risk_at(row, of, of.speed);
        if (!(risk.damping_dt <= limit_)) risks.push_back(risk);
    }
    void add_by_trial(std::size_t row, const Dragged& of, std::vector<Risk>& risks) {
        constexpr int most_trials = 10'000;
        constexpr double certainly_weak = 0.25;
        if (!of.has_springs && of.speed == 0 && of.gravity == 0) return;
        auto body = std::make_shared<const Bodies>(alone(bodies_, row));
        Risk risk = risk_at(row, of, largest_speed(of, *body));
        if (risk.damping_dt < certainly_weak * limit_) return;
        if (++trials_ > most_trials) return add_by_speed(row, of, risks);
        if (!diverges(*body, region_.method(), steps_, 1)) return;
        risk.alone = std::move(body);
        risks.push_back(std::move(risk));
    }

    const Bodies& bodies_;
    Region& region_;
    Steps steps_;
    double limit_;
    int trials_ = 0;
};

}  // namespace

void add_drag_risks(const Bodies& bodies, Region& region, const Steps& steps,
                    std::vector<Risk>& risks) {
    if (is_implicit(region.method()) || splits_dampers(region.method(), region.damping())) return;
    if (!any_body_has(bodies, []<class Force>() { return DragsInAir<Force>; })) return;
    const std::vector<bool> linked = bodies.linked_rows();
    DragTest test(bodies, region, steps);
    for (std::size_t row = 0; row < bodies.size(); ++row) test.add_risks(row, linked[row], risks);
}

double drag_limit(const Risk& risk, const Method& method, const Steps& steps) {
    if (!risk.alone)
        return quadratic_drag_limit(method, steps.damping.value_or(method.damping)) /
               risk.damping_dt;
    const auto is_stable = [&](double factor) {
        return !diverges(*risk.alone, method, steps, factor);
    };
    const Descent descent = descend(0.85, 1e-6, is_stable);
    return edge_between(descent.stable, descent.unstable, 1e-6, is_stable);
}

}  // namespace oiler
