// SPDX-License-Identifier: MIT
#include "oiler/compare/runs/state_log.hpp"

#include <algorithm>
#include <limits>

namespace oiler {
namespace {

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

std::int64_t tick_at(const StateLog& log, std::size_t index) {
    return index < log.ticks.size() ? log.ticks[index].tick : never;
}

Rows rows_at(const StateLog& log, std::size_t index) {
    return {log.ticks[index].first_row, log.end_row(index)};
}

std::size_t find(const StateLog& log, std::int64_t tick) {
    const auto at = std::ranges::lower_bound(log.ticks, tick, {}, &StateLog::Tick::tick);
    return static_cast<std::size_t>(at - log.ticks.begin());
}

}  // namespace

std::optional<TickPair> TickWalk::next() {
    const std::int64_t tick_a = tick_at(a_, index_a_);
    const std::int64_t tick_b = tick_at(b_, index_b_);
    const std::int64_t tick = std::min(tick_a, tick_b);
    if (tick > last_) return std::nullopt;
    TickPair pair;
    pair.tick = tick;
    pair.time_a = tick_a == tick ? a_.ticks[index_a_].time : b_.ticks[index_b_].time;
    pair.time_b = tick_b == tick ? b_.ticks[index_b_].time : pair.time_a;
    if (tick_a == tick) pair.a = rows_at(a_, index_a_++);
    if (tick_b == tick) pair.b = rows_at(b_, index_b_++);
    return pair;
}

std::optional<TickPair> find_tick(const StateLog& a, const StateLog& b, std::int64_t tick) {
    const std::size_t in_a = find(a, tick);
    const std::size_t in_b = find(b, tick);
    if (tick_at(a, in_a) != tick || tick_at(b, in_b) != tick) return std::nullopt;
    return TickPair{tick, a.ticks[in_a].time, b.ticks[in_b].time, rows_at(a, in_a),
                    rows_at(b, in_b)};
}

}  // namespace oiler
