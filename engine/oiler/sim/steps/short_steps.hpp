// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <variant>
#include <vector>

#include "oiler/physics/advance.hpp"
#include "oiler/physics/contacts/friction.hpp"
#include "oiler/physics/response.hpp"
#include "oiler/sim/rows/row_physics.hpp"
#include "oiler/sim/steps/step_rows.hpp"

namespace oiler {

/// How friction acts in a step.
template <std::floating_point T>
struct Braking {
    T half_step;                   ///< s; 0 if friction is a force, as in stages
    double t;                      ///< s, at the start of the step
    bool damps_apart;              ///< whether friction of damping needs a flow of its own
    bool damping_presses = false;  ///< whether such damping changes what holds the body
};

/// The physics of one row that slides on planes. Accelerations have no part into the planes, and
/// friction brakes. Friction that turns with the velocity, or is due to damping outside the kicks,
/// has a flow of its own in the first and the last half of the step, except in Runge–Kutta methods.
/// As a force in kicks it would have order 1; near a stop, where it turns at any rate, an implicit
/// method would find no solution.
template <std::floating_point T, int Axes, class Physics>
class SlidingPhysics {
public:
    using Vector = Vec<T, Axes>;
    using Motion = State<T, Axes>;
    static constexpr bool is_linear = false;

    SlidingPhysics(Physics& physics, const Support<T, Axes>& support,
                   const Friction<T, Axes>& friction, const Braking<T>& braking)
        : physics_(physics),
          support_(support),
          friction_(friction),
          braking_(braking),
          by_flow_(braking.half_step > 0 && (friction.turns || braking.damping_presses)) {}

    [[nodiscard]] Vector accelerate(const Motion& state, double t) {
        return along(physics_.accelerate(state, t), state.v, t);
    }
    [[nodiscard]] Vector kick(const Motion& state, double t) {
        return along(physics_.kick(state, t), state.v, t);
    }
    void drift(Motion& state, std::size_t flow, T tau) { physics_.drift(state, flow, tau); }
    void brake_before(Motion& state) { brake(state, braking_.t); }
    void brake_after(Motion& state) { brake(state, end()); }
    void damp_before(Motion& state) {
        brake_before(state);
        hold_against_damping(state, braking_.t);
        physics_.damp_before(state);
        follow(state, braking_.t);
    }
    void damp_after(Motion& state) {
        hold_against_damping(state, end());
        physics_.damp_after(state);
        follow(state, end());
        brake_after(state);
    }
    [[nodiscard]] Vector solve(const Motion& at, T tau, const Vector& residual) {
        const Jacobian<T, Axes> jacobian = physics_.forces().jacobian(at);
        const Matrix<T, Axes> rates = (jacobian.dx * tau + jacobian.dv) * tau;
        auto matrix = Matrix<T, Axes>::scalar(T(1));
        for (std::size_t j = 0; j < Axes; ++j) {
            Vector column;
            for (std::size_t i = 0; i < Axes; ++i) column.axis[i] = rates.row[i].axis[j];
            const T grip = by_flow_ ? T(0) : support_.change_of_grip(column);
            column = support_.change_without_push(column) + friction_.against(at.v) * grip;
            for (std::size_t i = 0; i < Axes; ++i) matrix.row[i].axis[j] -= column.axis[i];
        }
        return oiler::solve(matrix, residual);
    }
    void respond(Motion& state, double t) {
        brake_before(state);
        const double middle = t + static_cast<double>(braking_.half_step);
        physics_.respond_to(state, along(physics_.field(state.x, t), state.v, middle));
        if (braking_.damping_presses) follow(state, end());
        brake_after(state);
    }

private:
    [[nodiscard]] double end() const {
        return braking_.t + 2 * static_cast<double>(braking_.half_step);
    }
    /// Half of what holds the body against a half-step of damping, so that its normal speed is
    /// right in the middle of it.
    void hold_against_damping(Motion& state, double t) {
        if (!braking_.damping_presses) return;
        const Vector whole = physics_.accelerate(state, t);
        const Vector kick = physics_.field(state.x, t);
        const Vector held = support_.without_push(whole) - support_.without_push(kick);
        state.v += (held - (whole - kick)) * (braking_.half_step / 2);
    }
    /// The flow of friction over half a step: exact if the grip does not depend on the velocity,
    /// else of order 2.
    void brake(Motion& state, double t) {
        if (!by_flow_) return;
        Motion middle = state;
        if (braking_.damping_presses) brake(middle, state, braking_.half_step / 2, t);
        brake(state, middle, braking_.half_step, t);
    }
    /// Brakes for `tau` s with the grip at `at`.
    void brake(Motion& state, const Motion& at, T tau, double t) {
        const T lost = friction_.grip(support_, physics_.accelerate(at, t), since(t)) * tau;
        if (!friction_.turns) {
            state.v -= friction_.direction * lost;
            return;
        }
        const Vector slip = state.v - friction_.surface;
        const T speed = length(slip);
        state.v = lost < speed ? slip * (1 - lost / speed) : Vector{};
        if (friction_.surface != Vector{}) state.v += friction_.surface;
    }
    /// s, since the start of the step
    [[nodiscard]] T since(double t) const { return static_cast<T>(t - braking_.t); }
    void follow(Motion& state, double t) const {
        state.v = friction_.following(support_, state.v, since(t));
    }
    [[nodiscard]] Vector along(const Vector& a, const Vector& v, double t) const {
        return by_flow_ ? friction_.borne(support_, a, since(t))
                        : friction_.braked(support_, a, v, since(t));
    }

    Physics& physics_;
    const Support<T, Axes>& support_;
    const Friction<T, Axes>& friction_;
    Braking<T> braking_;
    bool by_flow_;
};

/// The forces on one row that are not linear, with damping over half of a shorter step.
template <std::floating_point T, int Axes>
class ShortStepOthers : public OtherForces<T, Axes> {
public:
    ShortStepOthers(const OtherForces<T, Axes>& others, T half_step)
        : OtherForces<T, Axes>(others), half_step_(half_step) {}

    template <class Force>
    [[nodiscard]] T damping_number(std::size_t index) const {
        return this->template get<Force>(index).prepare_damping(half_step_);
    }

private:
    T half_step_;
};

/// A plan for steps shorter than dt, with the flows of a row. It is large and kept from row to row.
template <std::floating_point T>
struct ShorterPlan {
    T tau = 0;  ///< s
    Plan<T> plan = ExactPlan<T>{0};
    std::vector<Response<T>> responses;
    std::vector<FlowView<T>> flows;

    void set_flows(std::size_t count, const auto& response_of) {
        responses.resize(count);
        flows.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const Response<T>& kept = responses[i] = response_of(i);
            flows[i] = {NumberView<T>(kept.reach), NumberView<T>(kept.sway),
                        NumberView<T>(kept.decay)};
        }
    }
};

/// Steps of one row that are not longer than dt, within the step that begins at `t` s.
template <std::floating_point T, int Axes>
class ShortSteps {
public:
    using Vector = Vec<T, Axes>;
    using Motion = State<T, Axes>;

    ShortSteps(const StepCall<T, Axes>& call, ShorterPlan<T>& shorter, std::size_t row, double t)
        : call_(call),
          shorter_(shorter),
          row_(row),
          others_(call.columns.views, row, call.columns.kinds[row]),
          parts_(call.columns.views.parts(call.columns.kinds[row])),
          linear_(call.columns.views.template load_at<T>(row, parts_)),
          t_(t) {
        shorter_.tau = 0;
    }

    [[nodiscard]] Motion fly(const Motion& from, T start, T tau) {
        return step(from, start, tau,
                    [](auto& physics, const Braking<T>&, auto take) { take(physics); });
    }
    [[nodiscard]] Motion slide(const Motion& from, T start, T tau, const Support<T, Axes>& support,
                               const Friction<T, Axes>& friction) {
        return step(
            from, start, tau, [&]<class Physics>(Physics& physics, Braking<T> braking, auto take) {
                braking.damping_presses =
                    braking.damps_apart && presses(physics, from, braking.t, support);
                SlidingPhysics<T, Axes, Physics> sliding(physics, support, friction, braking);
                take(sliding);
            });
    }
    [[nodiscard]] Vector accelerate(const Motion& at, T start) {
        ++evaluations_;
        return forces(T(0)).accelerate(at, t_ + static_cast<double>(start));
    }
    [[nodiscard]] bool forces_change() const { return forces(T(0)).depend_on_time(); }

    [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }
    /// Whether an implicit method found the solution of every step.
    [[nodiscard]] bool solved() const { return solved_; }

private:
    using ForcesOfRow = Forces<T, Axes, LinearParts, ShortStepOthers<T, Axes>>;

    [[nodiscard]] ForcesOfRow forces(T half_step) const {
        return {linear_, parts_, ShortStepOthers<T, Axes>(others_, half_step)};
    }

    /// Whether damping that is no part of the kicks presses the body onto the obstacles or off
    /// them.
    template <class Physics>
    [[nodiscard]] static bool presses(Physics& physics, const Motion& at, double t,
                                      const Support<T, Axes>& support) {
        const Vector whole = physics.forces().accelerate(at, t);
        const Vector kick = physics.forces().field(at.x, t);
        if (whole == kick) return false;
        const T noise = 64 * std::numeric_limits<T>::epsilon() * (largest(whole) + largest(kick));
        return largest(support.reactions(whole) - support.reactions(kick)) > noise;
    }

    /// One step of `tau` s; `with(physics, braking, take)` calls take with the physics to step.
    template <class With>
    Motion step(const Motion& from, T start, T tau, With with) {
        Motion state = from;
        if (tau == 0) return state;
        if (tau == call_.steps.rate.template dt<T>()) {
            step_by(call_.plan(), call_.columns.views.flows.data(), row_, state, start, tau, with);
        } else {
            if (tau != shorter_.tau) prepare(tau);
            step_by(shorter_.plan, shorter_.flows.data(), 0, state, start, tau, with);
        }
        return state;
    }
    template <class With>
    void step_by(const Plan<T>& plan, const FlowView<T>* flows, std::size_t row, Motion& state,
                 T start, T tau, With with) {
        const double t = t_ + static_cast<double>(start);
        const auto by = [&]<class Rule>(const Rule& rule) {
            RowPhysics<T, Axes, ForcesOfRow> physics([&] { return forces(tau / 2); }, flows, row,
                                                     damping_of_rule(rule));
            constexpr bool by_flows = !std::is_same_v<Rule, TableauPlan<T>>;
            // Friction that grows with the speed may leave an implicit method no solution.
            const bool damps_apart =
                by_flows && (!SplitsSteps<Rule> || damping_of_rule(rule) == Damping::in_drift);
            with(physics, Braking<T>{by_flows ? tau / 2 : T(0), t, damps_apart},
                 [&](auto& stepped) {
                     constexpr bool brakes = std::is_same_v<Rule, ImplicitPlan<T>> && requires {
                         stepped.brake_before(state);
                     };
                     if constexpr (brakes) stepped.brake_before(state);
                     solved_ &= advance(rule, state, stepped, t);
                     if constexpr (brakes) stepped.brake_after(state);
                 });
            evaluations_ += physics.evaluations();
        };
        std::visit(by, plan);
    }

    void prepare(T tau) {
        const Damping damping = call_.steps.damping.value_or(call_.method.damping);
        replace_plan(shorter_.plan, call_.method, tau, damping);
        shorter_.tau = tau;
        if (std::holds_alternative<ExactPlan<T>>(shorter_.plan)) {
            shorter_.set_flows(1, [&](std::size_t) {
                return oscillator_response(linear_.stiffness, linear_.damping, tau);
            });
        } else if (const auto* split = std::get_if<SplittingPlan<T>>(&shorter_.plan)) {
            if (split->damping == Damping::in_kick || !parts_.damping) return;
            shorter_.set_flows(split->drift_count, [&](std::size_t i) {
                return oscillator_response(T(0), linear_.damping, split->drifts[i]);
            });
        }
    }

    const StepCall<T, Axes>& call_;
    ShorterPlan<T>& shorter_;
    std::size_t row_;
    OtherForces<T, Axes> others_;
    LinearParts parts_;
    LinearForce<T, Axes> linear_;
    double t_;
    std::int64_t evaluations_ = 0;
    bool solved_ = true;
};

}  // namespace oiler
