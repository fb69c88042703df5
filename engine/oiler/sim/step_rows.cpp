// SPDX-License-Identifier: MIT
#include "oiler/sim/step_rows.hpp"

#include <cmath>
#include <mutex>
#include <utility>

#include "oiler/sim/kernels.hpp"
#include "oiler/sim/take_steps.hpp"

namespace oiler {
namespace {

template <std::floating_point T, int Axes>
bool all_finite(const State<T, Axes>& state) {
    bool finite = true;
    for (int i = 0; i < Axes; ++i)
        finite = finite && std::isfinite(state.x[i]) && std::isfinite(state.v[i]);
    return finite;
}

template <std::floating_point T, int Axes>
std::optional<Divergence> find_divergence(const State<T, Axes>& state, std::size_t row,
                                          std::int64_t tick) {
    for (const auto of : {Divergence::Of::position, Divergence::Of::velocity})
        for (int axis = 0; axis < Axes; ++axis)
            if (!std::isfinite((of == Divergence::Of::velocity ? state.v : state.x)[axis]))
                return Divergence{tick, row, axis, of};
    return std::nullopt;
}

/// Never inlined: it is large, and both callers instantiate it for each type and rule.
template <std::floating_point T, int Axes, class Rule>
[[gnu::noinline]] bool take_steps_of_row(const Columns<T, Axes>& columns, const Rule& rule,
                                         const Steps& steps, std::size_t row, State<T, Axes>& state,
                                         std::int64_t& evaluations) {
    RowPhysics<T, Axes> physics(columns, row, damping_of(rule));
    const bool found = take_steps(rule, state, physics, steps);
    evaluations += physics.evaluations();
    return found;
}

/// Repeats the steps of a diverged row one at a time to find the step of the divergence.
template <std::floating_point T, int Axes, class Rule>
std::optional<Divergence> replay(const Columns<T, Axes>& columns, const Rule& rule, Steps steps,
                                 std::size_t row) {
    State<T, Axes> state = load<T>(columns.motion, row);
    std::int64_t evaluations = 0;
    const std::int64_t end = steps.first + steps.count;
    steps.count = 1;
    for (; steps.first < end; ++steps.first) {
        const std::int64_t tick = steps.first + 1;
        if (!take_steps_of_row(columns, rule, steps, row, state, evaluations))
            return Divergence{tick, row, 0, Divergence::Of::solution};
        if (const auto found = find_divergence(state, row, tick)) return found;
    }
    return std::nullopt;
}

template <std::floating_point T, int Axes, class Rule>
std::optional<Divergence> step_row(Columns<T, Axes>& columns, const Rule& rule, const Steps& steps,
                                   std::size_t row) {
    State<T, Axes> state = load<T>(columns.motion, row);
    std::int64_t evaluations = 0;
    if (!take_steps_of_row(columns, rule, steps, row, state, evaluations) || !all_finite(state))
        return replay(columns, rule, steps, row);
    store(state, columns.motion, row);
    if (row == 0) columns.evaluations += evaluations;
    return std::nullopt;
}

/// Keeps the divergence with the smaller tick, then the smaller row.
void keep_earlier(std::optional<Divergence>& first, const std::optional<Divergence>& other) {
    if (!other) return;
    if (!first || std::pair(other->tick, other->row) < std::pair(first->tick, first->row))
        first = other;
}

template <std::floating_point T, int Axes, class Rule>
std::optional<Divergence> step_one_by_one(Columns<T, Axes>& columns, const Rule& rule,
                                          const Steps& steps, std::size_t begin, std::size_t end) {
    std::optional<Divergence> first;
    for (std::size_t row = begin; row < end; ++row)
        keep_earlier(first, step_row(columns, rule, steps, row));
    return first;
}

/// Rows after the last body are stepped too; their numbers must not overflow.
template <class T, int Axes>
void clear_padding(MotionColumns<T, Axes>& motion) {
    for (auto* vector : {&motion.x, &motion.v})
        for (Column<T>& column : *vector) column.clear_padding();
}

/// Steps in batches. Batches in which a number may no longer be finite are stepped row by row.
template <std::floating_point T, int Axes, class Rule>
std::optional<Divergence> step_in_batches(Columns<T, Axes>& columns, const Rule& rule,
                                          const Steps& steps, std::size_t begin, std::size_t end,
                                          auto kernel) {
    std::optional<Divergence> first;
    for (std::size_t row = begin; (row = kernel(columns, rule, steps, row, end)) < end;) {
        const std::size_t stop = std::min(row + row_padding, end);
        keep_earlier(first, step_one_by_one(columns, rule, steps, row, stop));
        if (stop == columns.size) clear_padding(columns.motion);
        row = stop;
    }
    return first;
}

template <std::floating_point T, int Axes, class Rule>
std::optional<Divergence> step_range(Columns<T, Axes>& columns, const Rule& rule,
                                     const Steps& steps, std::size_t begin, std::size_t end) {
    constexpr bool has_kernels =
        !std::is_same_v<T, long double> && !std::is_same_v<Rule, ImplicitPlan<T>>;
    if constexpr (has_kernels) {
        if (const Kernels<T, Axes>* const all = kernels<T, Axes>()) {
            const auto run = [&](auto kernel) {
                return step_in_batches(columns, rule, steps, begin, end, kernel);
            };
            if constexpr (std::is_same_v<Rule, SplittingPlan<T>>) return run(all->splitting);
            if constexpr (std::is_same_v<Rule, TableauPlan<T>>) return run(all->tableau);
            if constexpr (std::is_same_v<Rule, ExactPlan<T>>) return run(all->exact);
        }
    }
    return step_one_by_one(columns, rule, steps, begin, end);
}

/// With fewer row-steps, calling a team takes longer than stepping on one thread.
constexpr std::size_t team_threshold = 16384;

bool pays_for_team(std::size_t rows, const Steps& steps) {
    return rows > row_padding &&
           rows >=
               team_threshold / static_cast<std::size_t>(std::max<std::int64_t>(1, steps.count));
}

/// The first row of part `part` of `parts`; it begins a batch.
std::size_t begin_of(std::size_t part, std::size_t parts, std::size_t rows) {
    return std::min(rows, padded(rows) / row_padding * part / parts * row_padding);
}

template <std::floating_point T, int Axes, class Rule>
std::optional<Divergence> step_in_parallel(Columns<T, Axes>& columns, const Rule& rule,
                                           const Steps& steps, Team* team) {
    // Choose the kernels on this thread: an error in a thread of the team would end the program.
    if constexpr (!std::is_same_v<T, long double>) static_cast<void>(kernels<T, Axes>());
    if (!team || !pays_for_team(columns.size, steps))
        return step_range(columns, rule, steps, 0, columns.size);
    std::mutex first_mutex;
    std::optional<Divergence> first;
    team->run([&](std::size_t part) {
        const auto found =
            step_range(columns, rule, steps, begin_of(part, team->size(), columns.size),
                       begin_of(part + 1, team->size(), columns.size));
        if (!found) return;
        const std::lock_guard lock(first_mutex);
        keep_earlier(first, found);
    });
    return first;
}

}  // namespace

template <std::floating_point T, int Axes>
std::optional<Divergence> step_rows(Columns<T, Axes>& columns, const Plan<T>& plan,
                                    const Steps& steps, Team* team) {
    return std::visit(
        [&](const auto& rule) { return step_in_parallel(columns, rule, steps, team); }, plan);
}

template std::optional<Divergence> step_rows(Columns<float, 1>&, const Plan<float>&, const Steps&,
                                             Team*);
template std::optional<Divergence> step_rows(Columns<float, 2>&, const Plan<float>&, const Steps&,
                                             Team*);
template std::optional<Divergence> step_rows(Columns<float, 3>&, const Plan<float>&, const Steps&,
                                             Team*);
template std::optional<Divergence> step_rows(Columns<double, 1>&, const Plan<double>&, const Steps&,
                                             Team*);
template std::optional<Divergence> step_rows(Columns<double, 2>&, const Plan<double>&, const Steps&,
                                             Team*);
template std::optional<Divergence> step_rows(Columns<double, 3>&, const Plan<double>&, const Steps&,
                                             Team*);
template std::optional<Divergence> step_rows(Columns<long double, 1>&, const Plan<long double>&,
                                             const Steps&, Team*);
template std::optional<Divergence> step_rows(Columns<long double, 2>&, const Plan<long double>&,
                                             const Steps&, Team*);
template std::optional<Divergence> step_rows(Columns<long double, 3>&, const Plan<long double>&,
                                             const Steps&, Team*);

}  // namespace oiler
