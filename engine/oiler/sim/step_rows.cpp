// SPDX-License-Identifier: MIT
#include "oiler/sim/step_rows.hpp"

#include <algorithm>

#include "oiler/sim/batch.hpp"

namespace oiler {
namespace {

static_assert(row_padding % Batch<float>::lanes == 0);

template <class T, int Axes>
State<Batch<T>, Axes> load_state(const Columns<T, Axes>& columns, std::size_t row) {
    return {
        {generate<Axes>([&](auto i) { return Batch<T>::load(columns.position[i].data() + row); })},
        {generate<Axes>([&](auto i) { return Batch<T>::load(columns.velocity[i].data() + row); })}};
}

template <class T, int Axes>
void store_state(const State<Batch<T>, Axes>& state, Columns<T, Axes>& columns, std::size_t row) {
    for_each_index<Axes>([&](auto i) {
        state.x.axis[i].store(columns.position[i].data() + row);
        state.v.axis[i].store(columns.velocity[i].data() + row);
    });
}

template <class T, int Axes>
Forces<Batch<T>, Axes> load_forces(const Columns<T, Axes>& columns, std::size_t row) {
    Forces<Batch<T>, Axes> forces;
    for_each_index<force_count>([&](auto i) {
        const auto& stored = std::get<i>(columns.forces);
        forces.present[i] = stored.present;
        std::size_t next = 0;
        if (stored.present)
            for_each_number(std::get<i>(forces.list), [&](Batch<T>& number) {
                const Parameter<T>& parameter = stored.numbers[next++];
                number = parameter.shared() ? Batch<T>(parameter.data()[0])
                                            : Batch<T>::load(parameter.data() + row);
            });
    });
    return forces;
}

template <class T, int Axes>
bool all_finite(const State<Batch<T>, Axes>& state) {
    bool finite = true;
    for (int i = 0; i < Axes; ++i)
        finite = finite && all_finite(state.x[i]) && all_finite(state.v[i]);
    return finite;
}

/// The first row from `row` on of which `state` holds a number that is not finite. Lanes beyond the
/// last body do not count.
template <class T, int Axes>
std::optional<Divergence> find_divergence(const State<Batch<T>, Axes>& state, std::size_t row,
                                          std::size_t rows, std::int64_t tick) {
    alignas(column_alignment) std::array<T, Batch<T>::lanes> lane;
    std::optional<Divergence> found;
    for (const bool velocity : {false, true})
        for (int axis = 0; axis < Axes; ++axis) {
            (velocity ? state.v : state.x)[axis].store(lane.data());
            const auto end =
                lane.begin() + static_cast<std::ptrdiff_t>(std::min(rows - row, Batch<T>::lanes));
            const auto bad = std::find_if(lane.begin(), end, [](T v) { return !std::isfinite(v); });
            const std::size_t at = row + static_cast<std::size_t>(bad - lane.begin());
            if (bad != end && (!found || at < found->row)) found = {tick, at, axis, velocity};
        }
    return found;
}

template <class T, int Axes, class Rule>
std::optional<Divergence> replay(State<Batch<T>, Axes> state, const Forces<Batch<T>, Axes>& forces,
                                 const Rule& rule, const Steps& steps, std::size_t row,
                                 std::size_t rows) {
    for (std::int64_t j = 0; j < steps.count; ++j) {
        advance(rule, state, forces, steps.rate.time(steps.first + j));
        if (const auto found = find_divergence(state, row, rows, steps.first + j + 1)) return found;
    }
    return std::nullopt;
}

template <class T, int Axes, class Rule>
std::optional<Divergence> step_block(Columns<T, Axes>& columns, const Rule& rule,
                                     const Steps& steps, std::size_t row) {
    const Forces<Batch<T>, Axes> forces = load_forces(columns, row);
    State<Batch<T>, Axes> state = load_state(columns, row);
    for (std::int64_t j = 0; j < steps.count; ++j)
        advance(rule, state, forces, steps.rate.time(steps.first + j));
    if (!all_finite(state))
        if (const auto found =
                replay(load_state(columns, row), forces, rule, steps, row, columns.size))
            return found;
    store_state(state, columns, row);
    return std::nullopt;
}

/// Rows beyond the last body were stepped along; what they came to must not add up over the calls.
template <class T, int Axes>
void clear_padding(Columns<T, Axes>& columns) {
    for (auto* vector : {&columns.position, &columns.velocity})
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
        [&](const auto& rule) {
            std::optional<Divergence> first;
            for (std::size_t row = 0; row < columns.size; row += Batch<T>::lanes)
                if (const auto found = step_block(columns, rule, steps, row); found)
                    if (earlier(*found, first)) first = found;
            clear_padding(columns);
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

}  // namespace oiler
