// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "oiler/compare/state_log.hpp"

namespace oiler {

/// The rows of a tick, from `row` to before `end`.
struct Rows {
    std::size_t row = 0;
    std::size_t end = 0;

    [[nodiscard]] std::size_t size() const { return end - row; }
};

/// A tick of either run or of both. A run without the tick has no rows in it.
struct TickPair {
    std::int64_t tick = 0;
    double time_a = 0;
    double time_b = 0;
    Rows a;
    Rows b;
};

/// Visits the ticks of either log in their order, up to the tick `last`.
class TickWalk {
public:
    TickWalk(const StateLog& a, const StateLog& b, std::int64_t last) : a_(a), b_(b), last_(last) {}

    /// Returns empty after the last tick.
    [[nodiscard]] std::optional<TickPair> next();

private:
    const StateLog& a_;
    const StateLog& b_;
    std::int64_t last_;
    std::size_t index_a_ = 0;
    std::size_t index_b_ = 0;
};

/// Empty if a log lacks the tick.
[[nodiscard]] std::optional<TickPair> find_tick(const StateLog& a, const StateLog& b,
                                                std::int64_t tick);

}  // namespace oiler
