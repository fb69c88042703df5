// SPDX-License-Identifier: MIT
#include "oiler/sim/step_rows.hpp"

#include <algorithm>

#include "oiler/sim/advance.hpp"
#include "oiler/sim/row_physics.hpp"

namespace oiler {
namespace {

/// What a rule steps through the columns with: a batch of rows, or one row where rows go ways of
/// their own (an iteration ends when it ends) or T has no registers of several.
template <class T, class Rule>
struct StepsWith {
    using type = Batch<T>;
};
template <class T>
struct StepsWith<T, ImplicitPlan<T>> {
    using type = T;
};
template <class Rule>
struct StepsWith<long double, Rule> {
    using type = long double;
};
template <>
struct StepsWith<long double, ImplicitPlan<long double>> {
    using type = long double;
};

template <class V>
constexpr std::size_t lanes_of = 1;
template <class T>
constexpr std::size_t lanes_of<Batch<T>> = Batch<T>::lanes;

static_assert(row_padding % Batch<float>::lanes == 0);

template <std::floating_point T>
bool all_finite(T number) {
    return std::isfinite(number);
}
template <class V, int Axes>
bool all_finite(const State<V, Axes>& state) {
    bool finite = true;
    for (int i = 0; i < Axes; ++i)
        finite = finite && all_finite(state.x[i]) && all_finite(state.v[i]);
    return finite;
}

template <class T>
std::array<T, 1> lanes(const T& number) {
    return {number};
}
template <class T>
std::array<T, Batch<T>::lanes> lanes(const Batch<T>& batch) {
    alignas(column_alignment) std::array<T, Batch<T>::lanes> lane;
    batch.store(lane.data());
    return lane;
}

/// The first row from `row` on of which `state` holds a number that is not finite. Lanes beyond the
/// last body do not count. By value: a state whose address is taken is not kept in registers.
template <class V, int Axes>
std::optional<Divergence> find_divergence(State<V, Axes> state, std::size_t row, std::size_t rows,
                                          std::int64_t tick) {
    using Of = Divergence::Of;
    std::optional<Divergence> found;
    for (const Of of : {Of::position, Of::velocity})
        for (int axis = 0; axis < Axes; ++axis) {
            const auto lane = lanes((of == Of::velocity ? state.v : state.x)[axis]);
            const auto end =
                lane.begin() + static_cast<std::ptrdiff_t>(std::min(rows - row, lanes_of<V>));
            const auto bad =
                std::find_if(lane.begin(), end, [](auto v) { return !std::isfinite(v); });
            const std::size_t at = row + static_cast<std::size_t>(bad - lane.begin());
            if (bad != end && (!found || at < found->row)) found = {tick, at, axis, of};
        }
    return found;
}

/// One step of a block; whether there was one to be found.
template <class Rule, class V, int Axes>
[[gnu::always_inline]] inline bool step_once(const Rule& rule, State<V, Axes>& state,
                                             RowPhysics<V, Axes>& physics, double t) {
    if constexpr (std::is_same_v<Rule, ImplicitPlan<Scalar<V>>>) {
        return advance(rule, state, physics, t);
    } else {
        advance(rule, state, physics, t);
        return true;
    }
}

template <class V, class T, int Axes, class Rule>
std::optional<Divergence> replay(const Columns<T, Axes>& columns, const Plan<T>& plan,
                                 const Rule& rule, const Steps& steps, std::size_t row) {
    RowPhysics<V, Axes> physics(columns, row, plan);
    State<V, Axes> state = load<V>(columns.motion, row);
    for (std::int64_t j = 0; j < steps.count; ++j) {
        const std::int64_t tick = steps.first + j + 1;
        if (!step_once(rule, state, physics, steps.rate.time(tick - 1)))
            return Divergence{tick, row, 0, Divergence::Of::solution};
        if (const auto found = find_divergence(state, row, columns.size, tick)) return found;
    }
    return std::nullopt;
}

template <class V, class T, int Axes, class Rule>
std::optional<Divergence> step_block(Columns<T, Axes>& columns, const Plan<T>& plan,
                                     const Rule& rule, const Steps& steps, std::size_t row) {
    RowPhysics<V, Axes> physics(columns, row, plan);
    State<V, Axes> state = load<V>(columns.motion, row);
    bool solved = true;
    for (std::int64_t j = 0; j < steps.count && solved; ++j)
        solved = step_once(rule, state, physics, steps.rate.time(steps.first + j));
    if (!solved || (!all_finite(state) && find_divergence(state, row, columns.size, 0)))
        return replay<V>(columns, plan, rule, steps, row);
    store(state, columns.motion, row);
    if (row == 0) columns.evaluations += physics.evaluations();
    return std::nullopt;
}

/// Rows beyond the last body were stepped along; what they came to must not add up over the calls.
template <class T, int Axes>
void clear_padding(MotionColumns<T, Axes>& motion) {
    for (auto* vector : {&motion.x, &motion.v})
        for (Column<T>& column : *vector) column.clear_padding();
}

bool earlier(const Divergence& a, const std::optional<Divergence>& b) {
    return !b || a.tick < b->tick;
}

}  // namespace

template <std::floating_point T, int Axes>
std::optional<Divergence> step_rows(Columns<T, Axes>& columns, const Plan<T>& plan,
                                    const Steps& steps) {
    return std::visit(
        [&]<class Rule>(const Rule& rule) {
            using V = typename StepsWith<T, Rule>::type;
            std::optional<Divergence> first;
            for (std::size_t row = 0; row < columns.size; row += lanes_of<V>)
                if (const auto found = step_block<V>(columns, plan, rule, steps, row); found)
                    if (earlier(*found, first)) first = found;
            clear_padding(columns.motion);
            return first;
        },
        plan);
}

template std::optional<Divergence> step_rows(Columns<float, 1>&, const Plan<float>&, const Steps&);
template std::optional<Divergence> step_rows(Columns<float, 2>&, const Plan<float>&, const Steps&);
template std::optional<Divergence> step_rows(Columns<float, 3>&, const Plan<float>&, const Steps&);
template std::optional<Divergence> step_rows(Columns<double, 1>&, const Plan<double>&,
                                             const Steps&);
template std::optional<Divergence> step_rows(Columns<double, 2>&, const Plan<double>&,
                                             const Steps&);
template std::optional<Divergence> step_rows(Columns<double, 3>&, const Plan<double>&,
                                             const Steps&);
template std::optional<Divergence> step_rows(Columns<long double, 1>&, const Plan<long double>&,
                                             const Steps&);
template std::optional<Divergence> step_rows(Columns<long double, 2>&, const Plan<long double>&,
                                             const Steps&);
template std::optional<Divergence> step_rows(Columns<long double, 3>&, const Plan<long double>&,
                                             const Steps&);

}  // namespace oiler
