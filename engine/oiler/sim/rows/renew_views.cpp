// SPDX-License-Identifier: MIT
#include "oiler/sim/rows/renew_views.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "oiler/core/error.hpp"
#include "oiler/physics/response.hpp"

namespace oiler {
namespace {

/// The index of a field's first number among the numbers of its force.
template <class Force, class Field>
std::size_t offset_of(Field field) {
    Force force{};
    const void* first = &(force.*field);
    std::size_t offset = 0;
    std::size_t index = 0;
    for_each_number(force, [&](auto& number) {
        if (&number == first) offset = index;
        ++index;
    });
    return offset;
}

template <class T>
bool is_zero(const Parameter<T>& number) {
    return number.shared() && number[0] == 0;
}

template <class T>
NumberView<T> view_of(const Parameter<T>& number) {
    return is_zero(number) ? NumberView<T>() : NumberView<T>(number);
}

template <class T, int Axes>
using LinearAxes = std::array<LinearAxis<T>, Axes>;

/// Views a number that is not 0 for all rows. Returns whether `view` had another number before.
template <class T>
bool replace_view(NumberView<T>& view, const Parameter<T>& number) {
    if (is_zero(number)) return false;
    const bool replaced{view};
    view = NumberView<T>(number);
    return replaced;
}

/// Views the numbers of a linear force. Returns whether another force has one of them, too.
template <class Force, class T, int Axes>
bool view_force(const ForceColumns<T>& numbers, LinearAxes<T, Axes>& axes) {
    constexpr auto fields = Force::linear_fields();
    using Parts = typename decltype(fields)::Parts;
    constexpr Kinds kind = kind_bit<Force, T, Axes>;
    bool shares = false;
    for (std::size_t i = 0; i < Axes; ++i) {
        LinearAxis<T>& axis = axes[i];
        if constexpr (Parts::constant)
            shares |= replace_view(axis.constant, numbers[offset_of<Force>(fields.constant) + i]);
        if constexpr (Parts::spring) {
            const Parameter<T>& stiffness = numbers[offset_of<Force>(fields.stiffness)];
            shares |= replace_view(axis.stiffness, stiffness);
            if (!is_zero(stiffness))
                axis.centre = NumberView<T>(numbers[offset_of<Force>(fields.centre) + i]);
            axis.spring_kinds |= kind;
        }
        if constexpr (Parts::damping) {
            shares |= replace_view(axis.damping, numbers[offset_of<Force>(fields.damping)]);
            axis.damping_kinds |= kind;
        }
    }
    return shares;
}

/// Sums are rounded to T once.
template <class T>
using SumOf = std::conditional_t<std::is_same_v<T, float>, double, T>;

template <class T, int Axes>
void fill_sums(LinearSums<T, Axes>& sums, const Columns<T, Axes>& columns) {
    using Sum = SumOf<T>;
    sums = {};
    for (std::size_t row = 0; row < columns.size; ++row) {
        LinearForce<Sum, Axes> sum;
        for_each_force<Sum>(columns, row, [&]<class Force>(const Force& force) {
            if constexpr (Linear<Force>) sum = sum + linear_form(force);
        });
        for (std::size_t i = 0; i < Axes; ++i) {
            sums.constant[i].push(static_cast<T>(sum.constant.axis[i]));
            sums.centre[i].push(static_cast<T>(sum.centre.axis[i]));
        }
        sums.stiffness.push(static_cast<T>(sum.stiffness));
        sums.damping.push(static_cast<T>(sum.damping));
    }
    sums.valid = true;
}

/// The linear forces of the columns. Numbers that several forces share are viewed in the sums of
/// the columns or, if those are not valid, in `sums`, which are then filled.
template <class T, int Axes>
LinearAxes<T, Axes> linear_axes(const Columns<T, Axes>& columns, LinearSums<T, Axes>& sums) {
    LinearAxes<T, Axes> axes{};
    bool needs_sums = false;
    for_each_index<force_count>([&](auto kind) {
        using Force = std::tuple_element_t<kind, ForceList<T, Axes>>;
        if constexpr (Linear<Force>)
            for (const ForceColumns<T>& numbers : columns.forces[kind])
                needs_sums |= view_force<Force, T, Axes>(numbers, axes);
    });
    const bool valid = columns.linear_sums.valid;
    if (needs_sums && !valid) fill_sums(sums, columns);
    const LinearSums<T, Axes>& of = valid ? columns.linear_sums : sums;
    for (std::size_t i = 0; i < Axes; ++i) {
        LinearAxis<T>& axis = axes[i];
        if (needs_sums) {
            axis.constant = view_of(of.constant[i]);
            axis.centre = NumberView<T>(of.centre[i]);
            axis.stiffness = view_of(of.stiffness);
            axis.damping = view_of(of.damping);
        }
        if (!columns.applied.empty()) axis.applied = NumberView<T>(columns.applied.acceleration[i]);
    }
    return axes;
}

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
Response<T> response_of(const Oscillator<T>& oscillator, T duration) {
    const auto response = oscillator_response(oscillator.k, oscillator.c, duration);
    if (std::isfinite(response.reach) && std::isfinite(response.decay)) return response;
    fail(Exit::usage,
         "damping of {} 1/s overflows over {} s{}; take a higher rate, or implicit_euler",
         oscillator.c, duration, duration < 0 ? ", a backward drift of the method" : "");
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
            for (std::size_t index = 0; index < columns.forces[kind].size(); ++index) {
                Parameter<T>& numbers = all[kind].emplace_back();
                for (std::size_t row = 0; row < columns.size; ++row)
                    numbers.push(force_at<Force, T>(columns, index, row).prepare_damping(duration));
            }
    });
    return all;
}

/// The durations (s) over which steps with a plan use exact flows; empty for plans that use none.
template <class T>
std::span<const T> durations_of(const Plan<T>& plan) {
    if (const auto* exact = std::get_if<ExactPlan<T>>(&plan)) return {&exact->dt, 1};
    const auto* split = std::get_if<SplittingPlan<T>>(&plan);
    if (!split || split->damping == Damping::in_kick) return {};
    return {split->drifts.data(), split->drift_count};
}

template <class T>
bool has_springs_in_flows(const Plan<T>& plan) {
    return std::holds_alternative<ExactPlan<T>>(plan);
}

/// Fills the flows of the columns with those of the plan, unless they are valid: one response per
/// distinct damping (and stiffness) and duration.
template <class T, int Axes>
void fill_flows(Columns<T, Axes>& columns, const LinearAxis<T>& forces, const Plan<T>& plan) {
    const std::span<const T> durations = durations_of(plan);
    if (durations.empty()) return;
    const auto* split = std::get_if<SplittingPlan<T>>(&plan);
    const T half_step = split ? split->half_step : T(0);
    Flows<T>& flows = columns.flows;
    if (flows.valid && std::ranges::equal(flows.durations, durations) &&
        flows.half_step == half_step)
        return;
    Flows<T> filled;
    filled.durations = {durations.begin(), durations.end()};
    filled.half_step = half_step;
    const bool with_springs = has_springs_in_flows(plan);
    if (with_springs || forces.damping)
        for (const T duration : durations)
            filled.of.push_back(flow_columns(forces, columns.size, duration, with_springs));
    if (half_step != 0) filled.damping_numbers = damping_numbers(columns, half_step);
    filled.valid = true;
    flows = std::move(filled);
}

/// Whether a response is finite for certain: all products in it are small.
template <class T>
bool stays_finite(const Oscillator<T>& of, T duration) {
    constexpr T largest = 1e30F;
    return std::abs(of.c) < largest && std::abs(of.k) < largest && std::abs(duration) < largest &&
           std::abs(of.c * duration) < 1 && std::abs(of.k * duration * duration) < 1;
}

template <class T>
void view_others(const std::vector<ForceColumns<T>>& stored,
                 const std::vector<Parameter<T>>& damping_numbers,
                 std::vector<ForceView<T>>& views) {
    views.resize(stored.size());
    for (std::size_t index = 0; index < stored.size(); ++index) {
        for (std::size_t i = 0; i < stored[index].size(); ++i)
            views[index].numbers[i] = NumberView<T>(stored[index][i]);
        if (index < damping_numbers.size())
            views[index].damping_number = NumberView<T>(damping_numbers[index]);
    }
}

}  // namespace

template <std::floating_point T, int Axes>
void renew_views(Columns<T, Axes>& columns, const Plan<T>& plan) {
    RowViews<T, Axes>& views = columns.views;
    const LinearAxes<T, Axes> linear = linear_axes(columns, columns.linear_sums);
    fill_flows(columns, linear[0], plan);
    views.flows.clear();
    for (const FlowColumns<T>& flow : columns.flows.of)
        views.flows.push_back(
            {NumberView<T>(flow.reach), NumberView<T>(flow.sway), NumberView<T>(flow.decay)});
    for (std::size_t axis = 0; axis < Axes; ++axis)
        views.axis[axis] = {columns.motion.x[axis].data(), columns.motion.v[axis].data(),
                            linear[axis], views.flows.data(),
                            axis == 0 ? &columns.evaluations : nullptr};
    for_each_index<force_count>([&](auto kind) {
        using Force = std::tuple_element_t<kind, ForceList<T, Axes>>;
        if constexpr (!Linear<Force>)
            view_others(columns.forces[kind], columns.flows.damping_numbers[kind],
                        views.others[kind]);
    });
    views.valid = true;
}

template <std::floating_point T, int Axes>
void require_flows(const Columns<T, Axes>& columns, const Plan<T>& plan) {
    const std::span<const T> durations = durations_of(plan);
    if (durations.empty() || columns.size == 0) return;
    LinearSums<T, Axes> sums;
    const LinearAxis<T> forces = linear_axes(columns, sums)[0];
    const bool with_springs = has_springs_in_flows(plan);
    if (!with_springs && !forces.damping) return;
    const std::size_t rows = rows_agree(forces, with_springs) ? 1 : columns.size;
    for (const T duration : durations)
        for (std::size_t row = 0; row < rows; ++row) {
            const Oscillator<T> oscillator = oscillator_of(forces, row, with_springs);
            if (!stays_finite(oscillator, duration)) response_of(oscillator, duration);
        }
}

template void renew_views(Columns<float, 1>&, const Plan<float>&);
template void renew_views(Columns<float, 2>&, const Plan<float>&);
template void renew_views(Columns<float, 3>&, const Plan<float>&);
template void renew_views(Columns<double, 1>&, const Plan<double>&);
template void renew_views(Columns<double, 2>&, const Plan<double>&);
template void renew_views(Columns<double, 3>&, const Plan<double>&);
template void renew_views(Columns<long double, 1>&, const Plan<long double>&);
template void renew_views(Columns<long double, 2>&, const Plan<long double>&);
template void renew_views(Columns<long double, 3>&, const Plan<long double>&);

template void require_flows(const Columns<float, 1>&, const Plan<float>&);
template void require_flows(const Columns<float, 2>&, const Plan<float>&);
template void require_flows(const Columns<float, 3>&, const Plan<float>&);
template void require_flows(const Columns<double, 1>&, const Plan<double>&);
template void require_flows(const Columns<double, 2>&, const Plan<double>&);
template void require_flows(const Columns<double, 3>&, const Plan<double>&);
template void require_flows(const Columns<long double, 1>&, const Plan<long double>&);
template void require_flows(const Columns<long double, 2>&, const Plan<long double>&);
template void require_flows(const Columns<long double, 3>&, const Plan<long double>&);

}  // namespace oiler
