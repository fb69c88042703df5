// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <mutex>
#include <optional>

#include "oiler/core/team.hpp"
#include "oiler/physics/steps.hpp"
#include "oiler/sim/store/column.hpp"

namespace oiler {

/// With fewer row-steps, calling a team takes longer than stepping on one thread.
inline constexpr std::size_t team_threshold = 16384;

[[nodiscard]] inline bool pays_for_team(std::size_t rows, std::int64_t steps) {
    const auto count = static_cast<std::size_t>(std::max<std::int64_t>(1, steps));
    return rows > row_padding && rows >= team_threshold / count;
}

/// The first row of part `part` of `parts`; it begins a block.
[[nodiscard]] constexpr std::size_t begin_of(std::size_t part, std::size_t parts,
                                             std::size_t rows) {
    return std::min(rows, padded(rows) / row_padding * part / parts * row_padding);
}

/// Calls f(begin, end, part) for ranges of rows that begin a block: on the threads of the team if
/// that is faster for so many steps of them; a null team means this thread alone.
template <class F>
void for_parts(std::size_t rows, std::int64_t steps, Team* team, F f) {
    if (!team || !pays_for_team(rows, steps)) {
        f(std::size_t{0}, rows, std::size_t{0});
        return;
    }
    team->run([&](std::size_t part) {
        f(begin_of(part, team->size(), rows), begin_of(part + 1, team->size(), rows), part);
    });
}

/// Like for_parts, for a step(begin, end, part) that returns a divergence. Returns the earliest.
template <class Step>
[[nodiscard]] std::optional<Divergence> in_parts(std::size_t rows, const Steps& steps, Team* team,
                                                 Step step) {
    std::mutex first_mutex;
    std::optional<Divergence> first;
    for_parts(rows, steps.count, team, [&](std::size_t begin, std::size_t end, std::size_t part) {
        const auto found = step(begin, end, part);
        if (!found) return;
        const std::lock_guard lock(first_mutex);
        keep_earlier(first, found);
    });
    return first;
}

}  // namespace oiler
