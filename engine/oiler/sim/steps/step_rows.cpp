// SPDX-License-Identifier: MIT
#include "oiler/sim/steps/step_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace oiler {
namespace {

using Of = Divergence::Of;

/// The first number of a state that is not finite; `axis` is that of its first coordinate.
template <std::floating_point T, int Axes>
std::optional<Divergence> find_divergence(const State<T, Axes>& state, std::size_t row,
                                          std::int64_t tick, int axis) {
    for (const Of of : {Of::position, Of::velocity})
        for (int i = 0; i < Axes; ++i)
            if (!std::isfinite((of == Of::velocity ? state.v : state.x)[i]))
                return Divergence{tick, row, axis + i, of};
    return std::nullopt;
}

/// Never inlined: it is large, and both callers instantiate it for each type and rule.
template <class Rule, class V, int Axes, class Physics>
[[gnu::noinline]] bool take_steps_of_row(const Rule& rule, State<V, Axes>& state, Physics& physics,
                                         const Steps& steps) {
    return take_steps(rule, state, physics, steps);
}

/// Repeats the steps of a diverged row one at a time to find the step of the divergence.
template <class Rule, class T, int Axes, class MakePhysics>
std::optional<Divergence> replay(const Rule& rule, Steps steps, State<T, Axes> state,
                                 std::size_t row, int axis, MakePhysics make_physics) {
    const std::int64_t end = steps.first + steps.count;
    steps.count = 1;
    for (; steps.first < end; ++steps.first) {
        const std::int64_t tick = steps.first + 1;
        auto physics = make_physics(row);
        if (!take_steps_of_row(rule, state, physics, steps))
            return Divergence{tick, row, axis, Of::solution};
        if (const auto found = find_divergence(state, row, tick, axis)) return found;
    }
    return std::nullopt;
}

/// Steps a row from `state`, which it changes unless the row diverges. `make_physics(row)` returns
/// its physics.
template <class Rule, class T, int Axes, class MakePhysics>
std::optional<Divergence> step_row(const Rule& rule, const Steps& steps, State<T, Axes>& state,
                                   std::size_t row, int axis, MakePhysics make_physics,
                                   std::int64_t* evaluations) {
    auto physics = make_physics(row);
    State<T, Axes> after = state;
    if (!take_steps_of_row(rule, after, physics, steps) || find_divergence(after, row, 0, axis))
        return replay(rule, steps, state, row, axis, make_physics);
    state = after;
    if (row == 0 && evaluations) *evaluations += physics.evaluations();
    return std::nullopt;
}

/// Rows whose numbers along one axis stay in the cache while the other axes are stepped, few enough
/// that memory is read in as many streams as there are columns.
constexpr std::size_t rows_per_axis = 8 * row_padding;

/// Steps rows in ranges of whole blocks.
template <std::floating_point T, int Axes, class Rule>
class RowStepper {
public:
    RowStepper(const StepCall<T, Axes>& call, const Rule& rule)
        : columns_(call.columns),
          views_(call.views),
          kernels_(call.kernels),
          rule_(rule),
          steps_(call.steps) {}

    std::optional<Divergence> step(std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end;) {
            const Kinds kinds = kinds_of_block(columns_, row);
            const std::size_t stop = end_of_run(row, end, kinds);
            if ((kinds & ~linear_kinds) == 0)
                step_along_axes(row, stop, kinds);
            else
                step_all_axes(row, stop, kinds);
            row = stop;
        }
        return first_;
    }

private:
    static constexpr Kinds linear_kinds = [] {
        Kinds kinds = 0;
        for_each_index<force_count>([&](auto kind) {
            if constexpr (Linear<std::tuple_element_t<kind, ForceList<T, Axes>>>)
                kinds = static_cast<Kinds>(kinds | 1U << kind);
        });
        return kinds;
    }();
    /// The end of the blocks from `row` on that have these kinds of force.
    [[nodiscard]] std::size_t end_of_run(std::size_t row, std::size_t end, Kinds kinds) const {
        if (columns_.kinds.shared()) return end;
        do row += row_padding;
        while (row < end && kinds_of_block(columns_, row) == kinds);
        return std::min(row, end);
    }

    [[nodiscard]] AxisRows<T> rows_along(std::size_t axis) {
        return {columns_.motion.x[axis].data(), columns_.motion.v[axis].data(),
                views_.linear().axis[axis], views_.flows(),
                axis == 0 ? &columns_.evaluations : nullptr};
    }

    /// Rows under linear forces alone are stepped axis by axis, because their axes are independent.
    void step_along_axes(std::size_t begin, std::size_t end, Kinds kinds) {
        const auto rows = generate<Axes>([&](auto axis) { return rows_along(axis); });
        const auto kernels =
            generate<Axes>([&](auto axis) { return kernel_of(rows[axis], kinds); });
        for (std::size_t row = begin; row < end; row += rows_per_axis)
            for (std::size_t axis = 0; axis < Axes; ++axis)
                step_axis(rows[axis], kernels[axis], axis, kinds, row,
                          std::min(row + rows_per_axis, end));
    }
    [[nodiscard]] StepAxis<T, Rule> kernel_of(const AxisRows<T>& rows, Kinds kinds) const {
        if (!kernels_) return nullptr;
        const auto choose = std::get<ChooseStepAxis<T, Rule>>(kernels_->axis);
        return choose(rule_, rows.forces.parts(kinds), steps_.count == 1);
    }
    void step_axis(const AxisRows<T>& rows, StepAxis<T, Rule> kernel, std::size_t axis, Kinds kinds,
                   std::size_t begin, std::size_t end) {
        const auto in_kernel = [&](std::size_t from) {
            return kernel(rows, rule_, steps_, from, end);
        };
        const auto one_by_one = [&](std::size_t from, std::size_t to) {
            const LinearParts parts = rows.forces.parts(kinds);
            for (std::size_t row = from; row < to; ++row)
                keep_earlier(first_, step_axis_row(rows, parts, row, static_cast<int>(axis)));
        };
        kernel ? in_batches(begin, end, in_kernel, one_by_one) : one_by_one(begin, end);
    }
    std::optional<Divergence> step_axis_row(const AxisRows<T>& rows, const LinearParts& parts,
                                            std::size_t row, int axis) {
        State<T, 1> state{{rows.x[row]}, {rows.v[row]}};
        const auto diverged = step_row(
            rule_, steps_, state, row, axis,
            [&](std::size_t at) { return physics_of<T>(rows, at, parts, damping_of(rule_)); },
            rows.evaluations);
        rows.x[row] = state.x[0];
        rows.v[row] = state.v[0];
        return diverged;
    }

    void step_all_axes(std::size_t begin, std::size_t end, Kinds kinds) {
        const auto kernel =
            kernels_ ? std::get<StepAllAxes<T, Axes, Rule>>(kernels_->all_axes) : nullptr;
        const auto in_kernel = [&](std::size_t from) {
            return kernel(columns_, views_, kinds, rule_, steps_, from, end);
        };
        const auto one_by_one = [&](std::size_t from, std::size_t to) {
            for (std::size_t row = from; row < to; ++row)
                keep_earlier(first_, step_whole_row(row, kinds));
        };
        kernel ? in_batches(begin, end, in_kernel, one_by_one) : one_by_one(begin, end);
    }
    std::optional<Divergence> step_whole_row(std::size_t row, Kinds kinds) {
        // Newton's iteration differs for linear forces, and no body may depend on its neighbours.
        if (std::is_same_v<Rule, ImplicitPlan<T>> && (columns_.kinds[row] & ~linear_kinds) == 0)
            return step_row_axis_by_axis(row);
        State<T, Axes> state = load<T>(columns_.motion, row);
        const auto diverged = step_row(
            rule_, steps_, state, row, 0,
            [&](std::size_t at) { return physics_of<T>(views_, at, kinds, damping_of(rule_)); },
            &columns_.evaluations);
        store(state, columns_.motion, row);
        return diverged;
    }
    std::optional<Divergence> step_row_axis_by_axis(std::size_t row) {
        std::optional<Divergence> first;
        for (std::size_t axis = 0; axis < Axes; ++axis) {
            const AxisRows<T> rows = rows_along(axis);
            const LinearParts parts = rows.forces.parts(columns_.kinds[row]);
            keep_earlier(first, step_axis_row(rows, parts, row, static_cast<int>(axis)));
        }
        return first;
    }

    /// Batches in which a number may no longer be finite are stepped row by row.
    template <class Kernel, class OneByOne>
    void in_batches(std::size_t begin, std::size_t end, Kernel kernel, OneByOne one_by_one) {
        for (std::size_t row = begin; (row = kernel(row)) < end;) {
            const std::size_t stop = std::min(row + row_padding, end);
            one_by_one(row, stop);
            // Rows after the last body are stepped too; their numbers must not overflow.
            if (stop == columns_.size) clear_padding(columns_.motion);
            row = stop;
        }
    }

    Columns<T, Axes>& columns_;
    const RowViews<T, Axes>& views_;
    const Kernels<T, Axes>* kernels_;
    const Rule& rule_;
    const Steps& steps_;
    std::optional<Divergence> first_;
};

}  // namespace

template <std::floating_point T, int Axes>
std::optional<Divergence> step_rows(const StepCall<T, Axes>& call, std::size_t begin,
                                    std::size_t end) {
    return std::visit(
        [&]<class Rule>(const Rule& rule) {
            return RowStepper<T, Axes, Rule>(call, rule).step(begin, end);
        },
        call.plan);
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
