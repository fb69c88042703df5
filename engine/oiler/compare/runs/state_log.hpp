// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "oiler/compare/captures/captured.hpp"

namespace oiler {

/// The positions and velocities of all bodies at the ticks of a run. It is compact, because a trace
/// may have 10 million rows.
struct StateLog {
    struct Tick {
        std::int64_t tick = 0;
        double time = 0;  ///< s
        std::size_t first_row = 0;
    };

    std::string name;  ///< of the file, for messages
    int axes = 0;
    /// Whether each value is the shortest decimal of some float, read as a double. This is so in
    /// the trace of a run in float. In a run in double a value usually has more digits.
    bool floats = true;
    std::vector<Tick> ticks;            ///< ascending; each has rows
    std::vector<std::uint32_t> bodies;  ///< of each row, ascending within a tick
    std::vector<double> values;         ///< of each row: the position in m, the velocity in m/s
    std::vector<std::string> names{};   ///< of the bodies, by number; none in a trace

    /// The number of values in a row.
    [[nodiscard]] std::size_t width() const { return 2 * static_cast<std::size_t>(axes); }
    /// The row after the last one of ticks[index].
    [[nodiscard]] std::size_t end_row(std::size_t index) const {
        return index + 1 < ticks.size() ? ticks[index + 1].first_row : bodies.size();
    }
    [[nodiscard]] std::span<const double> row(std::size_t index) const {
        return std::span(values).subspan(index * width(), width());
    }
};

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
class TickPairs {
public:
    TickPairs(const StateLog& a, const StateLog& b, std::int64_t last)
        : a_(a), b_(b), last_(last) {}

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

/// The states of a capture's frames that have a record, in three axes. Bodies are numbered by their
/// names: those of `names` first, then new ones. Throws Error{usage} if no frame has a record.
[[nodiscard]] StateLog state_log_of(const Captured& captured, std::vector<std::string> names);

/// Removes the ticks that only one log has, up to the end of the shorter one: frames at other times
/// show other ticks. Throws Error{usage} if no tick is left.
void keep_common_ticks(StateLog& a, StateLog& b);

/// The first tick whose state hashes differ; empty if they are equal as far as both captures go. In
/// a capture of more than 1000 bodies, only frames have hashes.
[[nodiscard]] std::optional<std::int64_t> first_different_tick(const Captured& a,
                                                               const Captured& b);

/// Reads a trace, the CSV file of `--trace`. Throws Error(Exit::usage) with file and line if it is
/// malformed, missing or has no rows, and Error(Exit::io) if it cannot be read.
[[nodiscard]] StateLog read_trace(const std::filesystem::path& path);

}  // namespace oiler
