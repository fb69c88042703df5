// SPDX-License-Identifier: MIT
#include "oiler/sim/steps/step_rows.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "oiler/sim/rows/row_physics.hpp"

namespace oiler {
namespace {

/// All steps of a row, see take_steps. Never inlined: it is large, and both callers instantiate it
/// for each type.
template <std::floating_point T, int Axes, class Physics>
[[gnu::noinline]] bool take_steps_of_row(const Plan<T>& plan, State<T, Axes>& state,
                                         Physics& physics, const Steps& steps) {
    return std::visit([&](const auto& rule) { return take_steps(rule, state, physics, steps); },
                      plan);
}

template <std::floating_point T, int Axes>
constexpr Kinds linear_kinds = [] {
    Kinds kinds = 0;
    for_each_index<force_count>([&](auto kind) {
        if constexpr (Linear<std::tuple_element_t<kind, ForceList<T, Axes>>>)
            kinds = static_cast<Kinds>(kinds | 1U << kind);
    });
    return kinds;
}();

/// Whether all forces of these kinds are linear.
template <std::floating_point T, int Axes>
bool are_linear(Kinds kinds) {
    return (kinds & ~linear_kinds<T, Axes>) == 0;
}

/// Rows that are stepped along one axis before the next. Their numbers stay in the cache, and
/// memory is read in as many streams as there are columns.
constexpr std::size_t rows_per_axis = 8 * row_padding;

/// Steps ranges of whole blocks with the same kinds of force, and keeps the earliest divergence.
template <std::floating_point T, int Axes>
class RowStepper {
public:
    explicit RowStepper(const StepCall<T, Axes>& call)
        : columns_(call.columns), plan_(call.plan()), steps_(call.steps) {}

    /// Steps rows under linear forces alone axis by axis, because their axes are independent.
    void step_along_axes(std::size_t begin, std::size_t end, Kinds kinds) {
        const bool one_step = steps_.count == 1 && !is_sleep_tick(steps_.first + 1);
        for (std::size_t row = begin; row < end; row += rows_per_axis)
            for (std::size_t axis = 0; axis < Axes; ++axis) {
                const AxisRows<T>& rows = columns_.views.axis[axis];
                const LinearParts parts = rows.forces.parts(kinds);
                in_batches(
                    columns_.plan_cache.kernels.along_axis(parts, one_step), row,
                    std::min(row + rows_per_axis, end),
                    [&](auto kernel, std::size_t from, std::size_t to) {
                        return kernel(rows, plan_, steps_, from, to);
                    },
                    [&](std::size_t one) { step_axis_row(axis, parts, one); });
            }
    }

    void step_all_axes(std::size_t begin, std::size_t end, Kinds kinds) {
        in_batches(
            columns_.plan_cache.kernels.all_axes, begin, end,
            [&](auto kernel, std::size_t from, std::size_t to) {
                return kernel(columns_, kinds, steps_, from, to);
            },
            [&](std::size_t row) { step_whole_row(row, kinds); });
    }

    [[nodiscard]] const std::optional<Divergence>& first() const { return first_; }

private:
    /// Batches in which a number may no longer be finite are stepped row by row, and so are all
    /// rows without a kernel.
    template <class Kernel, class StepBatches, class StepRow>
    void in_batches(Kernel kernel, std::size_t begin, std::size_t end, StepBatches step_batches,
                    StepRow step_row) {
        std::size_t row = kernel ? step_batches(kernel, begin, end) : begin;
        while (row < end) {
            const std::size_t stop = std::min(row + row_padding, end);
            for (; row < stop; ++row) step_row(row);
            if (!kernel) continue;
            // Rows after the last body are stepped too; their numbers must not overflow.
            if (stop == columns_.size) clear_padding(columns_.motion);
            row = step_batches(kernel, stop, end);
        }
    }

    void step_axis_row(std::size_t axis, const LinearParts& parts, std::size_t row) {
        const AxisRows<T>& rows = columns_.views.axis[axis];
        State<T, 1> state{{rows.x[row]}, {rows.v[row]}};
        step_row(state, row, static_cast<int>(axis),
                 [&] { return physics_of<T>(rows, row, parts, damping_of(plan_)); });
        rows.x[row] = state.x[0];
        rows.v[row] = state.v[0];
    }
    void step_whole_row(std::size_t row, Kinds kinds) {
        const Kinds own = columns_.kinds[row];
        // Newton's iteration differs for linear forces, and no body may depend on its neighbours.
        if (std::holds_alternative<ImplicitPlan<T>>(plan_) && are_linear<T, Axes>(own)) {
            for (std::size_t axis = 0; axis < Axes; ++axis)
                step_axis_row(axis, columns_.views.axis[axis].forces.parts(own), row);
            return;
        }
        State<T, Axes> state = load<T>(columns_.motion, row);
        step_row(state, row, 0,
                 [&] { return physics_of<T>(columns_.views, row, kinds, damping_of(plan_)); });
        store(state, columns_.motion, row);
    }

    /// Changes the state of a row unless it diverges. `axis` is that of its first coordinate.
    template <int StateAxes, class MakePhysics>
    void step_row(State<T, StateAxes>& state, std::size_t row, int axis, MakePhysics make_physics) {
        auto physics = make_physics();
        State<T, StateAxes> after = state;
        if (!take_steps_of_row(plan_, after, physics, steps_) ||
            find_divergence(after, row, 0, axis))
            return keep_earlier(first_, replay(state, row, axis, make_physics));
        state = after;
        if (row == 0 && axis == 0) columns_.evaluations += physics.evaluations();
    }
    /// Repeats the steps of a diverged row one at a time to find the step of the divergence.
    template <int StateAxes, class MakePhysics>
    std::optional<Divergence> replay(State<T, StateAxes> state, std::size_t row, int axis,
                                     MakePhysics make_physics) const {
        Steps one = steps_;
        one.count = 1;
        for (; one.first < steps_.first + steps_.count; ++one.first) {
            const std::int64_t tick = one.first + 1;
            auto physics = make_physics();
            if (!take_steps_of_row(plan_, state, physics, one))
                return Divergence{tick, row, axis, Divergence::Of::solution};
            if (const auto found = find_divergence(state, row, tick, axis)) return found;
        }
        return std::nullopt;
    }

    Columns<T, Axes>& columns_;
    const Plan<T>& plan_;
    const Steps& steps_;
    std::optional<Divergence> first_;
};

}  // namespace

template <std::floating_point T, int Axes>
std::optional<Divergence> step_rows(const StepCall<T, Axes>& call, std::size_t begin,
                                    std::size_t end) {
    const Columns<T, Axes>& columns = call.columns;
    RowStepper<T, Axes> stepper(call);
    for (std::size_t row = begin; row < end;) {
        const Kinds kinds = kinds_of_block(columns, row);
        std::size_t stop = columns.kinds.shared() ? end : row + row_padding;
        while (stop < end && kinds_of_block(columns, stop) == kinds) stop += row_padding;
        stop = std::min(stop, end);
        if (are_linear<T, Axes>(kinds))
            stepper.step_along_axes(row, stop, kinds);
        else
            stepper.step_all_axes(row, stop, kinds);
        row = stop;
    }
    return stepper.first();
}

template std::optional<Divergence> step_rows(const StepCall<float, 1>&, std::size_t, std::size_t);
template std::optional<Divergence> step_rows(const StepCall<float, 2>&, std::size_t, std::size_t);
template std::optional<Divergence> step_rows(const StepCall<float, 3>&, std::size_t, std::size_t);
template std::optional<Divergence> step_rows(const StepCall<double, 1>&, std::size_t, std::size_t);
template std::optional<Divergence> step_rows(const StepCall<double, 2>&, std::size_t, std::size_t);
template std::optional<Divergence> step_rows(const StepCall<double, 3>&, std::size_t, std::size_t);
template std::optional<Divergence> step_rows(const StepCall<long double, 1>&, std::size_t,
                                             std::size_t);
template std::optional<Divergence> step_rows(const StepCall<long double, 2>&, std::size_t,
                                             std::size_t);
template std::optional<Divergence> step_rows(const StepCall<long double, 3>&, std::size_t,
                                             std::size_t);

}  // namespace oiler
