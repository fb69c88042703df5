// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <mutex>
#include <optional>

#include "oiler/core/team.hpp"
#include "oiler/physics/steps.hpp"
#include "oiler/sim/store/columns.hpp"

namespace oiler {

/// Everything that the steps of a call need. The views and the plan of the columns are valid.
template <std::floating_point T, int Axes>
struct StepCall {
    Columns<T, Axes>& columns;
    const Method& method;
    const Steps& steps;
    Team* team;  ///< null means this thread alone

    [[nodiscard]] const Plan<T>& plan() const { return columns.plan_cache.plan; }
};

/// Steps the rows from `begin`, the start of a block, to `end`. Each block of rows is loaded into
/// registers, stepped `count` times and stored, so that a call accesses memory once. The bits do
/// not depend on the steps per call. Returns the earliest divergence, after which the columns are
/// unusable.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> step_rows(const StepCall<T, Axes>& call, std::size_t begin,
                                                  std::size_t end);

/// Steps all rows, of which some meet planes, and lists their impacts in the columns.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> step_landing_rows(const StepCall<T, Axes>& call);

/// Steps all rows if there are links: together, stage by stage.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> step_linked_rows(const StepCall<T, Axes>& call);

/// With fewer row-steps, calling a team takes longer than stepping on one thread.
inline constexpr std::size_t team_threshold = 16384;

[[nodiscard]] inline bool pays_for_team(std::size_t rows, std::int64_t steps) {
    const auto count = static_cast<std::size_t>(std::max<std::int64_t>(1, steps));
    return rows > row_padding && rows >= team_threshold / count;
}

/// Calls step(begin, end, part) for ranges of rows that begin a block: on the threads of the team
/// if that is faster for so many steps of them; a null team means this thread alone. Returns the
/// earliest divergence.
template <class Step>
std::optional<Divergence> in_parts(std::size_t rows, std::int64_t steps, Team* team, Step step) {
    if (!team || !pays_for_team(rows, steps)) return step(std::size_t{0}, rows, std::size_t{0});
    const std::size_t blocks = padded(rows) / row_padding;
    const auto begin_of = [&](std::size_t part) {
        return std::min(rows, blocks * part / team->size() * row_padding);
    };
    std::mutex first_mutex;
    std::optional<Divergence> first;
    team->run([&](std::size_t part) {
        const std::optional<Divergence> found = step(begin_of(part), begin_of(part + 1), part);
        if (!found) return;
        const std::lock_guard lock(first_mutex);
        keep_earlier(first, found);
    });
    return first;
}

}  // namespace oiler
