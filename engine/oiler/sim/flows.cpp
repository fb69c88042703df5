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

/// The oscillator of row `row`, the same along all axes; `k` is 0 unless springs belong to the
/// flow.
template <class T>
Oscillator<T> oscillator_of(const LinearAxis<T>& forces, std::size_t row, bool with_springs) {
    return {with_springs && forces.stiffness ? forces.stiffness.template at<T>(row) : T(0),
            forces.damping ? forces.damping.template at<T>(row) : T(0)};
}

/// Whether all rows have the same oscillator.
template <class T>
bool rows_agree(const LinearAxis<T>& forces, bool with_springs) {
    return (!with_springs || forces.stiffness.is_shared()) && forces.damping.is_shared();
}

template <class T>
void require_finite(const Response<T>& response, const Oscillator<T>& of, T duration) {
    if (std::isfinite(response.reach) && std::isfinite(response.decay)) return;
    fail(Exit::usage,
         "damping of {} 1/s overflows over {} s{}; take a higher rate, or implicit_euler", of.c,
         duration, duration < 0 ? ", a backward drift of the method" : "");
}

template <class T>
Response<T> response_of(const Oscillator<T>& oscillator, T duration) {
    const auto response = oscillator_response(oscillator.k, oscillator.c, duration);
    require_finite(response, oscillator, duration);
    return response;
}

/// The responses of `rows` rows; each distinct one is computed once.
template <class T>
FlowColumns<T> flow_columns(const LinearAxis<T>& forces, std::size_t rows, T duration,
                            bool with_springs) {
    const auto first = oscillator_of(forces, 0, with_springs);
    if (rows_agree(forces, with_springs)) {
        const Response<T> response = response_of(first, duration);
        return {{response.reach, rows}, {response.sway, rows}, {response.decay, rows}};
    }
    FlowColumns<T> flow;
    std::map<Oscillator<T>, Response<T>> known;
    for (std::size_t row = 0; row < rows; ++row) {
        const Oscillator<T> oscillator = oscillator_of(forces, row, with_springs);
        auto at = known.find(oscillator);
        if (at == known.end())
            at = known.emplace(oscillator, response_of(oscillator, duration)).first;
        flow.reach.push(at->second.reach);
        flow.sway.push(at->second.sway);
        flow.decay.push(at->second.decay);
    }
    return flow;
}

/// The numbers of prepare_damping over `duration`, for each kind and force.
template <class T, int Axes>
auto damping_numbers(const Columns<T, Axes>& columns, T duration) {
    std::array<std::vector<Parameter<T>>, force_count> all;
    for_each_index<force_count>([&](auto kind) {
        using Force = std::tuple_element_t<kind, ForceList<T, Axes>>;
        if constexpr (Damps<Force, State<T, Axes>, T>)
            for (std::size_t index = 0; index < std::get<kind>(columns.forces).size(); ++index) {
                Parameter<T>& numbers = all[kind].emplace_back();
                for (std::size_t row = 0; row < columns.size; ++row)
                    numbers.push(force_at<Force, T>(columns, index, row).prepare_damping(duration));
            }
    });
    return all;
}

template <class T, int Axes>
void fill(Columns<T, Axes>& columns, const LinearAxis<T>& forces, std::span<const T> durations,
          T half_step, bool with_springs) {
    Flows<T>& flows = columns.flows;
    if (flows.valid && std::ranges::equal(flows.durations, durations) &&
        flows.half_step == half_step)
        return;
    Flows<T> filled;
    filled.durations = {durations.begin(), durations.end()};
    filled.half_step = half_step;
    if (with_springs || forces.damping)
        for (const T duration : durations)
            filled.of.push_back(flow_columns(forces, columns.size, duration, with_springs));
    if (half_step != 0) filled.damping_numbers = damping_numbers(columns, half_step);
    filled.valid = true;
    flows = std::move(filled);
}

}  // namespace

template <std::floating_point T, int Axes>
void prepare_flows(Columns<T, Axes>& columns, const LinearColumns<T, Axes>& linear,
                   const Plan<T>& plan) {
    if (const auto* exact = std::get_if<ExactPlan<T>>(&plan)) {
        fill(columns, linear.axis[0], std::span(&exact->dt, 1), T(0), true);
    } else if (const auto* split = std::get_if<SplittingPlan<T>>(&plan)) {
        if (split->damping == Damping::in_drift)
            fill(columns, linear.axis[0], std::span(split->drifts.data(), split->drift_count),
                 split->half_step, false);
    }
}

template void prepare_flows(Columns<float, 1>&, const LinearColumns<float, 1>&, const Plan<float>&);
template void prepare_flows(Columns<float, 2>&, const LinearColumns<float, 2>&, const Plan<float>&);
template void prepare_flows(Columns<float, 3>&, const LinearColumns<float, 3>&, const Plan<float>&);
template void prepare_flows(Columns<double, 1>&, const LinearColumns<double, 1>&,
                            const Plan<double>&);
template void prepare_flows(Columns<double, 2>&, const LinearColumns<double, 2>&,
                            const Plan<double>&);
template void prepare_flows(Columns<double, 3>&, const LinearColumns<double, 3>&,
                            const Plan<double>&);
template void prepare_flows(Columns<long double, 1>&, const LinearColumns<long double, 1>&,
                            const Plan<long double>&);
template void prepare_flows(Columns<long double, 2>&, const LinearColumns<long double, 2>&,
                            const Plan<long double>&);
template void prepare_flows(Columns<long double, 3>&, const LinearColumns<long double, 3>&,
                            const Plan<long double>&);

}  // namespace oiler
