// SPDX-License-Identifier: MIT
#include "oiler/sim/flows.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "oiler/core/error.hpp"
#include "oiler/physics/response.hpp"

namespace oiler {
namespace {

template <class T>
struct Oscillator {
    T k;  // 1/s²
    T c;  // 1/s
    auto operator<=>(const Oscillator&) const = default;
};

/// The oscillator of row `row`; `k` is 0 unless springs belong to the flow.
template <class T, int Axes>
Oscillator<T> oscillator_of(const Columns<T, Axes>& columns, std::size_t row, bool with_springs) {
    const auto forces = forces_of<T>(columns, row);
    Oscillator<T> oscillator{T(0), forces.damping_rate()};
    if (with_springs)
        for (std::size_t index = 0; index < forces.template count<SpringForce>(); ++index)
            oscillator.k = oscillator.k + forces.template get<SpringForce>(index).stiffness;
    return oscillator;
}

/// Whether all rows have the same numbers in all forces with a damping rate, including springs.
template <class T, int Axes>
bool rows_agree(const Columns<T, Axes>& columns) {
    bool agree = true;
    for_each_index<force_count>([&](auto i) {
        using Force = std::tuple_element_t<i, ForceList<T, Axes>>;
        if constexpr (requires(const Force& force) { force.damping_rate(); })
            for (const auto& numbers : std::get<i>(columns.forces))
                for (const Parameter<T>& number : numbers) agree = agree && number.shared();
    });
    return agree;
}

/// The number of rows whose flows must be computed: one if all rows agree.
template <class T, int Axes>
std::size_t distinct_rows(const Columns<T, Axes>& columns) {
    return rows_agree(columns) ? std::min<std::size_t>(columns.size, 1) : columns.size;
}

template <class T>
void require_finite(const Response<T>& response, const Oscillator<T>& of, T duration) {
    if (std::isfinite(response.reach) && std::isfinite(response.decay)) return;
    fail(Exit::usage,
         "damping of {} 1/s overflows over {} s{}; take a higher rate, or implicit_euler", of.c,
         duration, duration < 0 ? ", a backward drift of the method" : "");
}

/// Calls f(response) for each row in order and computes each distinct response once.
template <class T, int Axes, class F>
void for_each_response(const Columns<T, Axes>& columns, T duration, bool with_springs, F f) {
    std::map<Oscillator<T>, Response<T>> known;
    for (std::size_t row = 0; row < distinct_rows(columns); ++row) {
        const Oscillator<T> oscillator = oscillator_of(columns, row, with_springs);
        auto at = known.find(oscillator);
        if (at == known.end()) {
            const auto response = oscillator_response(oscillator.k, oscillator.c, duration);
            require_finite(response, oscillator, duration);
            at = known.emplace(oscillator, response).first;
        }
        f(at->second);
    }
}

template <class T, int Axes>
FlowColumns<T> flow_columns(const Columns<T, Axes>& columns, T duration, bool with_springs) {
    FlowColumns<T> flow;
    for_each_response(columns, duration, with_springs, [&](const Response<T>& response) {
        flow.reach.push(response.reach);
        flow.sway.push(response.sway);
        flow.decay.push(response.decay);
    });
    return flow;
}

/// The losses over `duration` of each coil spring.
template <class T, int Axes>
std::vector<Parameter<T>> coil_losses(const Columns<T, Axes>& columns, T duration) {
    using Coil = CoilSpringForce<T, Axes>;
    const ForcesOfRow<T, T, Axes> first(columns, 0);
    std::vector<Parameter<T>> losses(first.template count<Coil>());
    for (std::size_t index = 0; index < losses.size(); ++index)
        for (std::size_t row = 0; row < columns.size; ++row) {
            const T c = ForcesOfRow<T, T, Axes>(columns, row).template get<Coil>(index).damping;
            losses[index].push(c * oscillator_response(T(0), c, duration).reach);
        }
    return losses;
}

template <class T, int Axes>
bool is_damped(const Columns<T, Axes>& columns) {
    for (std::size_t row = 0; row < distinct_rows(columns); ++row)
        if (forces_of<T>(columns, row).damping_rate() != 0) return true;
    return false;
}

template <class T, int Axes>
void fill(Columns<T, Axes>& columns, std::span<const T> durations, T half_step, bool with_springs) {
    Flows<T>& flows = columns.flows;
    if (flows.valid && std::ranges::equal(flows.durations, durations) &&
        flows.half_step == half_step)
        return;
    Flows<T> filled{.damped = with_springs || is_damped(columns),
                    .durations = {durations.begin(), durations.end()},
                    .of = {},
                    .half_step = half_step,
                    .coil_loss = {}};
    if (filled.damped)
        for (const T duration : durations)
            filled.of.push_back(flow_columns(columns, duration, with_springs));
    if (half_step != 0) filled.coil_loss = coil_losses(columns, half_step);
    filled.valid = true;
    flows = std::move(filled);
}

}  // namespace

template <std::floating_point T, int Axes>
void prepare_flows(Columns<T, Axes>& columns, const Plan<T>& plan) {
    if (const auto* exact = std::get_if<ExactPlan<T>>(&plan)) {
        fill(columns, std::span(&exact->dt, 1), T(0), true);
    } else if (const auto* split = std::get_if<SplittingPlan<T>>(&plan)) {
        if (split->damping == Damping::in_drift)
            fill(columns, std::span(split->drifts.data(), split->drift_count), split->half_step,
                 false);
    }
}

template void prepare_flows(Columns<float, 1>&, const Plan<float>&);
template void prepare_flows(Columns<float, 2>&, const Plan<float>&);
template void prepare_flows(Columns<float, 3>&, const Plan<float>&);
template void prepare_flows(Columns<double, 1>&, const Plan<double>&);
template void prepare_flows(Columns<double, 2>&, const Plan<double>&);
template void prepare_flows(Columns<double, 3>&, const Plan<double>&);
template void prepare_flows(Columns<long double, 1>&, const Plan<long double>&);
template void prepare_flows(Columns<long double, 2>&, const Plan<long double>&);
template void prepare_flows(Columns<long double, 3>&, const Plan<long double>&);

}  // namespace oiler
