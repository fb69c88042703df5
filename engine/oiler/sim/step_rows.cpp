// SPDX-License-Identifier: MIT
#include "oiler/sim/step_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "oiler/sim/kernels.hpp"

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

/// Steps all rows of a call, in ranges of whole blocks.
template <std::floating_point T, int Axes, class Rule>
class RowStepper {
public:
    RowStepper(Columns<T, Axes>& columns, const RowViews<T, Axes>& views, const Rule& rule,
               const Steps& steps)
        : columns_(columns), views_(views), rule_(rule), steps_(steps) {}

    std::optional<Divergence> run(std::size_t begin, std::size_t end) {
        std::optional<Divergence> first;
        for (std::size_t row = begin; row < end;) {
            const Kinds kinds = kinds_of_block(columns_, row);
            const std::size_t stop = end_of_run(row, end, kinds);
            if ((kinds & ~linear_kinds) == 0)
                step_axes(row, stop, kinds, first);
            else
                step_all_axes(row, stop, kinds, first);
            row = stop;
        }
        return first;
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

    void step_axes(std::size_t begin, std::size_t end, Kinds kinds,
                   std::optional<Divergence>& first) {
        std::array<AxisRows<T>, Axes> rows;
        std::array<std::size_t, Axes> parts;
        for (std::size_t axis = 0; axis < Axes; ++axis) {
            rows[axis] = rows_along(axis);
            parts[axis] = index_of(rows[axis].forces.parts(kinds));
        }
        // Axes with the same parts are stepped by the same kernel.
        for (std::size_t axis = 0; axis < Axes;) {
            std::size_t stop = axis;
            while (stop < Axes && parts[stop] == parts[axis]) ++stop;
            step_like_axes(std::span(rows).subspan(axis, stop - axis), begin, end, axis, kinds,
                           first);
            axis = stop;
        }
    }
    /// Steps rows along axes from `first_axis` on that have the same parts of linear forces.
    void step_like_axes(std::span<const AxisRows<T>> axes, std::size_t begin, std::size_t end,
                        std::size_t first_axis, Kinds kinds, std::optional<Divergence>& first) {
        const LinearParts parts = axes[0].forces.parts(kinds);
        const auto one_by_one = [&](std::size_t axis, std::size_t from, std::size_t to) {
            for (std::size_t row = from; row < to; ++row)
                keep_earlier(first, step_axis_row(axes[axis], parts, row,
                                                  static_cast<int>(first_axis + axis)));
        };
        const auto* const all = kernels_or_null();
        if constexpr (has_kernels) {
            if (all) {
                AxisPlace at{begin, 0, begin};
                while (!all->axis.of(rule_)[index_of(parts)](axes, rule_, steps_, at, end)) {
                    const std::size_t stop =
                        std::min({at.row + row_padding, at.begin + rows_per_axis, end});
                    one_by_one(at.axis, at.row, stop);
                    if (stop == columns_.size) clear_padding(columns_.motion);
                    at.row = stop;
                }
                return;
            }
        }
        for (std::size_t axis = 0; axis < axes.size(); ++axis) one_by_one(axis, begin, end);
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

    std::optional<Divergence> step_row_axis_by_axis(std::size_t row) {
        std::optional<Divergence> first;
        for (std::size_t axis = 0; axis < Axes; ++axis) {
            const AxisRows<T> rows = rows_along(axis);
            const LinearParts parts = rows.forces.parts(columns_.kinds[row]);
            keep_earlier(first, step_axis_row(rows, parts, row, static_cast<int>(axis)));
        }
        return first;
    }

    void step_all_axes(std::size_t begin, std::size_t end, Kinds kinds,
                       std::optional<Divergence>& first) {
        const auto one_by_one = [&](std::size_t from, std::size_t to) {
            for (std::size_t row = from; row < to; ++row)
                keep_earlier(first, step_whole_row(row, kinds));
        };
        constexpr bool in_kernels = has_kernels && (std::is_same_v<Rule, SplittingPlan<T>> ||
                                                    std::is_same_v<Rule, TableauPlan<T>>);
        const auto* const all = kernels_or_null();
        if (!in_kernels || !all) return one_by_one(begin, end);
        const auto kernel = [&](std::size_t from) {
            if constexpr (has_kernels && std::is_same_v<Rule, SplittingPlan<T>>)
                return all->splitting(columns_, views_, kinds, rule_, steps_, from, end);
            else if constexpr (has_kernels && std::is_same_v<Rule, TableauPlan<T>>)
                return all->tableau(columns_, views_, kinds, rule_, steps_, from, end);
            else
                return end;
        };
        in_batches(begin, end, kernel, one_by_one);
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

    static constexpr bool has_kernels = !std::is_same_v<T, long double>;
    static auto kernels_or_null() {
        if constexpr (has_kernels)
            return kernels<T, Axes>();
        else
            return static_cast<const Kernels<double, Axes>*>(nullptr);
    }

    Columns<T, Axes>& columns_;
    const RowViews<T, Axes>& views_;
    const Rule& rule_;
    const Steps& steps_;
};

}  // namespace

template <std::floating_point T, int Axes>
std::optional<Divergence> step_row_range(Columns<T, Axes>& columns, const RowViews<T, Axes>& views,
                                         const Plan<T>& plan, const Steps& steps, std::size_t begin,
                                         std::size_t end) {
    return std::visit(
        [&]<class Rule>(const Rule& rule) {
            return RowStepper<T, Axes, Rule>(columns, views, rule, steps).run(begin, end);
        },
        plan);
}

template std::optional<Divergence> step_row_range(Columns<float, 1>&, const RowViews<float, 1>&,
                                                  const Plan<float>&, const Steps&, std::size_t,
                                                  std::size_t);
template std::optional<Divergence> step_row_range(Columns<float, 2>&, const RowViews<float, 2>&,
                                                  const Plan<float>&, const Steps&, std::size_t,
                                                  std::size_t);
template std::optional<Divergence> step_row_range(Columns<float, 3>&, const RowViews<float, 3>&,
                                                  const Plan<float>&, const Steps&, std::size_t,
                                                  std::size_t);
template std::optional<Divergence> step_row_range(Columns<double, 1>&, const RowViews<double, 1>&,
                                                  const Plan<double>&, const Steps&, std::size_t,
                                                  std::size_t);
template std::optional<Divergence> step_row_range(Columns<double, 2>&, const RowViews<double, 2>&,
                                                  const Plan<double>&, const Steps&, std::size_t,
                                                  std::size_t);
template std::optional<Divergence> step_row_range(Columns<double, 3>&, const RowViews<double, 3>&,
                                                  const Plan<double>&, const Steps&, std::size_t,
                                                  std::size_t);
template std::optional<Divergence> step_row_range(Columns<long double, 1>&,
                                                  const RowViews<long double, 1>&,
                                                  const Plan<long double>&, const Steps&,
                                                  std::size_t, std::size_t);
template std::optional<Divergence> step_row_range(Columns<long double, 2>&,
                                                  const RowViews<long double, 2>&,
                                                  const Plan<long double>&, const Steps&,
                                                  std::size_t, std::size_t);
template std::optional<Divergence> step_row_range(Columns<long double, 3>&,
                                                  const RowViews<long double, 3>&,
                                                  const Plan<long double>&, const Steps&,
                                                  std::size_t, std::size_t);

}  // namespace oiler
