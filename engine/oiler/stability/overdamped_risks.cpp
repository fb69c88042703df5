// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "oiler/stability/modes.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

/// Below this c·dt steps of no method turn an overdamped motion back.
constexpr double certainly_weak = 0.25;

/// The c·dt from which a step ends any motion: the amplitude falls by exp(−c·dt/2).
constexpr double ended = 6;

/// A displacement and a velocity along one motion, in steps.
struct Moving {
    long double x, v;

    [[nodiscard]] Moving after(const StepMatrix& step) const {
        return {step.xx * x + step.xv * v, step.vx * x + step.vv * v};
    }
};

/// Whether a number has another sign than the true one, and is no small part of the largest one.
bool is_turned(long double number, long double truth, long double largest) {
    return number * truth < 0 && std::abs(number) > 0.01L * largest;
}

/// Whether 64 steps turn a velocity or move backwards where the true motion does not: it is
/// overdamped, or damping ends it within a step. It starts with `speed` and `acceleration`, in
/// steps of 1 s.
bool turns_back(const Method& method, Damping damping, const ScaledOscillation& of, double speed,
                double acceleration) {
    if (of.damping_dt < std::min(2 * of.omega_dt, ended)) return false;
    if (!(of.damping_dt > certainly_weak) || !std::isfinite(size(of))) return false;
    const Oscillation at{of.omega_dt * of.omega_dt, of.damping_dt};
    const StepMatrix step = step_matrices(method, damping, {&at, 1}).front();
    const StepMatrix exact = step_matrices(find_method("exact"), damping, {&at, 1}).front();
    // Without a spring the motion tends to a speed, else to a place.
    const long double steady = at.k > 0 ? 0 : acceleration / at.c;
    Moving run{at.k > 0 ? -acceleration / at.k : 0, speed - steady};
    Moving truth = run;
    long double fastest = std::abs(speed);
    long double farthest = 0;
    for (int i = 0; i < 64; ++i) {
        const Moving next = run.after(step);
        const Moving then = truth.after(exact);
        const long double way = then.x - truth.x + steady;
        fastest = std::max(fastest, std::abs(then.v + steady));
        farthest = std::max(farthest, std::abs(way));
        if (is_turned(next.v + steady, then.v + steady, fastest)) return true;
        if (is_turned(next.x - run.x + steady, way, farthest)) return true;
        run = next;
        truth = then;
    }
    return false;
}

/// Whether a step has eigenvalues that let an overdamped motion turn, whatever its start, or lets
/// one oscillate that damping ends.
bool rings(const Method& method, Damping damping, const ScaledOscillation& of) {
    constexpr long double round_off = 1e-12L;
    const Oscillation at{of.omega_dt * of.omega_dt, of.damping_dt};
    const StepMatrix step = step_matrices(method, damping, {&at, 1}).front();
    if (of.damping_dt < 2 * of.omega_dt)
        return of.damping_dt > ended && spectral_radius(step) > 0.5L;
    return std::min({step.xv, step.determinant(), step.trace()}) < -round_off;
}

double norm(const WeightedVectors& u) { return std::sqrt(inner(u, u)); }

/// The motion of a component that is damped most. Its rate is at most 1 % too high.
RitzPair most_damped(const Component& component) {
    constexpr std::size_t most_dense = 100;
    if (component.freedoms() > most_dense) return highest_ritz_pair(component, {0, 1, false});
    const Mode mode = fastest_damping(component, false);
    return {mode.value, 0, to_vectors(mode.vector, component)};
}

/// Whether steps of dt·`factor` do not turn the motion of a risk back.
bool overdamped_holds(const Risk& risk, const Method& method, const Steps& steps, double factor) {
    const double dt = steps.rate.dt() * factor;
    return !turns_back(method, steps.damping.value_or(method.damping),
                       {risk.omega_dt * factor, risk.damping_dt * factor}, risk.at * dt,
                       risk.effect * dt * dt);
}

class OverdampedTest {
public:
    OverdampedTest(const Bodies& bodies, const Method& method, const Steps& steps)
        : bodies_(bodies), method_(method), steps_(steps) {}

    [[nodiscard]] std::optional<Risk> find_risk(const Component& component) {
        const double dt = steps_.rate.dt();
        const bool has_dampers = !component.dampers.empty();
        if (!has_dampers && std::ranges::max(component.drag) * dt < certainly_weak)
            return std::nullopt;
        if (has_dampers && splits_dampers(method_, steps_.damping.value_or(method_.damping)))
            return std::nullopt;
        const auto [rate, residual, vector] = most_damped(component);
        const double k = std::max(quotient(component, {1, 0, false}, vector), 0.0);
        Risk risk{.row = component.rows.front(),
                  .omega_dt = std::sqrt(k) * dt,
                  .damping_dt = (rate + residual) * dt,
                  .of = Risk::Of::overdamped};
        if (!set_start(component, rate, risk) || overdamped_holds(risk, method_, steps_, 1))
            return std::nullopt;
        if (const Coupling* const most = component.most_strained(vector)) {
            risk.row = component.rows[most->a];
            risk.is_rope = most->is_rope;
            if (most->b != Coupling::ground) risk.linked = component.rows[most->b];
        }
        return risk;
    }

private:
    /// Sets the speed and the acceleration of the motion that is damped at `rate`, 1/s. Returns
    /// whether the speeds that the damping would end at once are 2 % of those of the whole motion:
    /// at the start, or a/c by the forces at rest.
    [[nodiscard]] bool set_start(const Component& component, double rate, Risk& risk) {
        constexpr double part = 0.02;
        constexpr double hidden = 1e-6;  // of the coordinates, per step
        if (!accelerations_) accelerations_ = accelerations_at_rest(bodies_);
        WeightedVectors v, a;
        double coordinates = 0;
        for (std::size_t i = 0; i < component.rows.size(); ++i) {
            const std::size_t row = component.rows[i];
            const double root = 1 / component.inverse_root_mass[i];
            v.push_back(bodies_.velocity(row) * root);
            a.push_back(accelerations_->empty() ? Vec3{} : (*accelerations_)[row] * root);
            coordinates = std::max(coordinates, largest(bodies_.position(row)) * root);
        }
        const MatrixSum damping{0, 1 / rate, false};
        const WeightedVectors damped_v = product(component, damping, v);
        const WeightedVectors damped_a = product(component, damping, a);
        risk.at = std::copysign(norm(damped_v), inner(damped_v, damped_a));
        risk.effect = norm(damped_a);
        for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] - damped_a[i];
        const double fast = norm(damped_v) + risk.effect / rate;
        return fast > hidden * coordinates / steps_.rate.dt() &&
               fast > part * (norm(v) + speed_soon(component, a));
    }
    /// The speed to which accelerations lead within 0.1 s, or in balance with the damping.
    [[nodiscard]] static double speed_soon(const Component& component, const WeightedVectors& a) {
        const double size = norm(a);
        if (size == 0) return 0;
        return size / (10 + quotient(component, {0, 1, false}, a) / (size * size));
    }

    const Bodies& bodies_;
    const Method& method_;
    Steps steps_;
    std::optional<std::vector<Vec3>> accelerations_{};
};

/// Whether add_drag_risks tries the body: drag alone, and gravity, move it.
bool has_drag_alone(const Bodies& bodies, std::size_t row) {
    bool alone = true;
    for_each_force_on(bodies, row, [&]<class Force>(const Force& force) {
        if constexpr (Linear<Force>)
            alone = alone && linear_form(force).stiffness == 0 && !std::is_same_v<Force, Spring>;
        else
            alone = alone && !acts(force);
    });
    return alone;
}

bool may_damp(const Bodies& bodies) {
    return bodies.link_count() > 0 || any_body_has(bodies, []<class Force>() {
               return LineSpring<Force> || (Linear<Force> && !std::is_same_v<Force, Gravity>);
           });
}

}  // namespace

void add_overdamped_risks(const Bodies& bodies, const Method& method, const Steps& steps,
                          std::vector<Risk>& risks) {
    constexpr int most_trials = 10'000;
    if (std::holds_alternative<ExactFlow>(method.rule) || !may_damp(bodies)) return;
    OverdampedTest test(bodies, method, steps);
    const std::vector<std::size_t> labels = component_labels(bodies);
    std::vector<bool> known(bodies.size());
    for (const Risk& risk : risks) known[labels[risk.row]] = true;
    const auto add = [&](const Component& component) {
        if (known[labels[component.rows.front()]]) return;
        if (auto risk = test.find_risk(component)) risks.push_back(std::move(*risk));
    };
    const std::vector<bool> linked = bodies.linked_rows();
    const std::vector<OwnMotion> own = own_motions(bodies);
    int trials = 0;
    for (std::size_t row = 0; row < own.size() && trials < most_trials; ++row) {
        if (linked[row] || !(own[row].all.c * steps.rate.dt() > certainly_weak)) continue;
        if (has_drag_alone(bodies, row)) continue;
        add(component_of_row(bodies, row));
        ++trials;
    }
    if (bodies.link_count() == 0) return;
    for (const Component& component : linked_components(bodies, labels)) add(component);
}

double overdamped_limit(const Risk& risk, const Method& method, const Steps& steps) {
    const Damping damping = steps.damping.value_or(method.damping);
    const auto is_right = [&](double factor) {
        return !rings(method, damping, {risk.omega_dt * factor, risk.damping_dt * factor}) &&
               overdamped_holds(risk, method, steps, factor);
    };
    const Descent descent = descend(0.85, 1e-12, is_right);
    return descent.found ? edge_between(descent.stable, descent.unstable, 1e-9, is_right) : 0;
}

}  // namespace oiler
