// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "oiler/stability/oscillations.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

/// The drag of a body and its speeds.
struct Dragged {
    double linear = 0;     ///< 1/s
    double quadratic = 0;  ///< 1/m
    double gravity = 0;    ///< m/s²
    double speed = 0;      ///< m/s, relative to the air
    Vec3 air{};            ///< m/s
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
        if (coefficient > 0) of.air = air;
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

/// Whether a step turned a body alone round or moved it backwards, relative to the air.
bool reverses(const Bodies& before, const Bodies& after, const Vec3& air, const Rate& rate) {
    const Vec3 u = before.velocity(0) - air;
    const Vec3 moved = after.position(0) - before.position(0) - air * rate.dt();
    return dot(after.velocity(0) - air, u) < 0 || dot(moved, u) < 0;
}

/// Whether finer steps with exact drag reverse a body alone, too.
bool truly_reverses(const Bodies& before, const Vec3& air, const Rate& rate) {
    constexpr std::int64_t finer = 64;
    Bodies after = before;
    const Rate fine{rate.steps * finer, rate.seconds};
    return after.try_step(find_method("velocity_verlet"), {fine, 0, finer}) ||
           reverses(before, after, air, rate);
}

/// Whether a body alone diverges or is thrown back within its first steps of dt·`factor`. Too
/// strong a drag squares the speed every step, so that few steps decide.
bool fails(Bodies body, const Dragged& of, const Method& method, const Steps& steps,
           double factor) {
    const std::int64_t count = of.quadratic > 0 ? 512 : 1;
    const Rate rate = factor == 1 ? steps.rate : scaled_rate(steps.rate, factor);
    const Vec3 air = of.linear > 0 ? Vec3{} : of.air;
    for (std::int64_t tick = 0; tick < count; ++tick) {
        const Bodies before = body;
        if (body.try_step(method, {rate, tick, 1, steps.damping})) return true;
        if (reverses(before, body, air, rate) && !truly_reverses(before, air, rate)) return true;
    }
    return false;
}

/// The largest speed of a body that only springs hold, from its energy, m/s.
double largest_speed(const Dragged& of, const Bodies& alone) {
    const double start = std::max(of.speed, of.terminal_speed());
    if (!of.has_springs) return start;
    return std::max(of.speed, std::sqrt(2 * std::max(alone.energy().total(), 0.0)));
}

/// Whether a step makes a body of 1 m/s faster or throws it back, for each c·|v|·dt.
std::vector<bool> mislead(const Method& method, Damping damping, std::vector<double> drags) {
    Bodies bodies(1, Precision::extended);
    for (const double drag : drags) bodies.add({.velocity = {1}}, QuadraticDrag{drag});
    std::vector<bool> misled(drags.size(), true);
    if (bodies.try_step(method, {.rate = {1}, .damping = damping})) return misled;
    for (std::size_t row = 0; row < drags.size(); ++row) {
        const long double v = bodies.state(row).v[0];
        misled[row] = !(v >= -1e-14L && v <= 1 + 1e-14L && bodies.state(row).x[0] >= 0);
    }
    return misled;
}

}  // namespace

double quadratic_drag_limit(const Method& method, Damping damping) {
    std::vector<double> drags;
    for (double drag = 0.05; drag < 1000; drag *= 1.01) drags.push_back(drag);
    double low = 0;
    double high = std::numeric_limits<double>::infinity();
    const std::vector<bool> misled = mislead(method, damping, drags);
    for (std::size_t i = 0; i < drags.size() && std::isinf(high); ++i)
        (misled[i] ? high : low) = drags[i];
    if (std::isinf(high)) return high;
    return edge_between(low, high, 1e-14,
                        [&](double drag) { return !mislead(method, damping, {drag}).front(); });
}

namespace {

/// The largest damping rate of linear drag and dampers on a body, 1/s.
double strongest_drag(const Bodies& bodies) {
    double fastest = 0;
    for (const OwnMotion& own : own_motions(bodies)) fastest = std::max(fastest, own.linear.c);
    return fastest;
}

class DragTest {
public:
    DragTest(const Bodies& bodies, Region& region, const Steps& steps)
        : bodies_(bodies),
          region_(region),
          steps_(steps),
          limit_(quadratic_drag_limit(region.method(), region.damping())) {}

    void add_risks(std::size_t row, bool linked, std::vector<Risk>& risks) {
        const Dragged of = drag_of(bodies_, row);
        if (!(of.quadratic > 0)) return add_linear(row, of, linked, risks);
        if (linked || of.has_other_forces || !std::isfinite(of.speed))
            add_by_speed(row, of, risks);
        else
            add_by_trial(row, of, risks);
        if (linked || of.has_other_forces || of.has_springs || of.gravity == 0) return;
        Risk risk{.row = row, .of = Risk::Of::terminal_speed, .at = of.terminal_speed()};
        risk.damping_dt = (of.linear + 2 * of.quadratic * risk.at) * steps_.rate.dt();
        if (!region_.contains({0, risk.damping_dt})) risks.push_back(risk);
    }

    /// Whether no step of a drag of `rate`, 1/s, is suspicious.
    [[nodiscard]] bool is_weak(double rate) const {
        return rate * steps_.rate.dt() < 0.25 * limit_;
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
    /// Linear drag that is too strong to be stable is a risk of springs.
    void add_linear(std::size_t row, const Dragged& of, bool linked, std::vector<Risk>& risks) {
        const double damping_dt = of.linear * steps_.rate.dt();
        const bool moves = of.speed > 0 && std::isfinite(of.speed);
        if (linked || of.has_other_forces || !moves || is_weak(of.linear)) return;
        if (!region_.contains({0, damping_dt})) return;
        add_by_trial(row, of, risks);
    }
    void add_by_trial(std::size_t row, const Dragged& of, std::vector<Risk>& risks) {
        constexpr int most_trials = 10'000;
        if (!of.has_springs && of.speed == 0 && of.gravity == 0) return;
        auto body = std::make_shared<const Bodies>(alone(bodies_, row, Precision::double_));
        Risk risk = risk_at(row, of, largest_speed(of, *body));
        if (is_weak(of.linear + of.quadratic * risk.at)) return;
        if (++trials_ > most_trials) return add_by_speed(row, of, risks);
        if (!fails(*body, of, region_.method(), steps_, 1)) return;
        risk.tried = std::move(body);
        if (of.quadratic == 0) risk.of = Risk::Of::linear_drag;
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
    if (splits_dampers(region.method(), region.damping())) return;
    if (std::holds_alternative<ExactFlow>(region.method().rule)) return;
    const auto drags = []<class Force>() {
        return DragsInAir<Force> || std::is_same_v<Force, LinearDrag>;
    };
    if (!any_body_has(bodies, drags)) return;
    DragTest test(bodies, region, steps);
    const bool is_linear = !any_body_has(bodies, []<class Force>() { return DragsInAir<Force>; });
    if (is_linear && test.is_weak(strongest_drag(bodies))) return;
    const std::vector<bool> linked = bodies.linked_rows();
    for (std::size_t row = 0; row < bodies.size(); ++row) test.add_risks(row, linked[row], risks);
}

double drag_limit(const Risk& risk, const Method& method, const Steps& steps) {
    if (!risk.tried)
        return quadratic_drag_limit(method, steps.damping.value_or(method.damping)) /
               risk.damping_dt;
    const Dragged of = drag_of(*risk.tried, 0);
    const auto is_stable = [&](double factor) {
        return !fails(*risk.tried, of, method, steps, factor);
    };
    const Descent descent = descend(0.85, 1e-6, is_stable);
    return edge_between(descent.stable, descent.unstable, 1e-6, is_stable);
}

}  // namespace oiler
