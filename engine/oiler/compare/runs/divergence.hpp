// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "oiler/compare/runs/state_log.hpp"

namespace oiler {

/// The differences between two runs, of which one or both may have ended early. The runs are
/// compared up to the last tick of the shorter one.
struct RunDivergence {
    /// Two numbers of one body.
    struct Value {
        std::int64_t tick = 0;
        double time = 0;  ///< s
        std::uint32_t body = 0;
        int field = 0;  ///< index in a row of a StateLog
        double a = 0;
        double b = 0;
        std::uint64_t ulps = 0;  ///< 0 for 0 and −0; not_in_ulps for NaN
        double distance = 0;     ///< m or m/s
        std::size_t bodies = 0;  ///< the number of bodies that differ at this tick
    };
    /// The bodies that only one run has at a tick.
    struct Presence {
        std::int64_t tick = 0;
        double time = 0;  ///< s
        std::vector<std::uint32_t> only_a;
        std::vector<std::uint32_t> only_b;
    };
    struct Times {
        std::int64_t tick = 0;
        double a = 0;  ///< s
        double b = 0;  ///< s
    };
    /// The body whose positions are furthest apart at a tick.
    struct Growth {
        std::int64_t tick = 0;
        double time = 0;  ///< s
        std::uint32_t body = 0;
        double distance = 0;     ///< m
        std::uint64_t ulps = 0;  ///< along the axis on which the positions are furthest apart
    };

    std::int64_t first_tick = 0;  ///< of either run
    std::int64_t last_tick = 0;   ///< of the shorter run
    double last_time = 0;         ///< s
    std::size_t bodies = 0;       ///< the number of bodies that either run has at any tick

    /// Whether ulps are those of float: both logs have only floats.
    bool floats = false;
    std::optional<Value> value;        ///< the most ulps at the first tick whose numbers differ
    std::optional<Presence> presence;  ///< at the first tick at which only one run has some body
    std::optional<Times> times;        ///< at the first tick whose times differ
    /// At up to 12 ticks, from the one of `value` to the last, ever further apart.
    std::vector<Growth> growth;

    [[nodiscard]] bool same() const { return !value && !presence && !times; }
};

/// Compares the bits of all numbers: 0 differs from −0. Bodies are matched by their numbers, ticks
/// by theirs. Throws Error(Exit::usage) if the logs have different numbers of axes.
[[nodiscard]] RunDivergence find_divergence(const StateLog& a, const StateLog& b);

/// The name of a field, for example "vy", and its unit.
[[nodiscard]] std::string field_name(int axes, int field);
[[nodiscard]] const char* field_unit(int axes, int field);

}  // namespace oiler
