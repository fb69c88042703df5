// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/limits.hpp"

namespace oiler::bench {

/// Does a piece of work the given number of times.
using Work = std::function<void(long times)>;

/// Repeats a piece of work as often as asked.
template <class F>
Work repeated(F once) {
    return [once](long times) mutable {
        for (long i = 0; i < times; ++i) once();
    };
}

/// The duration and the number of measurements of a piece of work.
struct Effort {
    int repetitions = 15;
    double seconds = 0.001;  ///< the least, of each repetition
    double patience = 0.4;   ///< s, after which slow work is not repeated
    /// Whether to run the work once untimed before each repetition, because other work in between
    /// discards what it prepares.
    bool prepared = false;
};

/// Seconds that each piece of work takes once: the least of several repetitions. The pieces take
/// turns, so that other load on the machine affects all alike.
[[nodiscard]] std::vector<double> race(const std::vector<Work>& work, const Effort& effort);

/// Keeps a result and its computation from being optimised away.
template <class T>
inline void keep(const T& value) {
    asm volatile("" : : "g"(&value) : "memory");
}

/// The limit of a measurement.
struct Bound {
    bool is_least = false;  ///< otherwise the most
    double limit = 0;
    std::string unit{};  ///< "ns"; empty for a ratio
};
inline Bound at_least(double limit, std::string unit = {}) {
    return {true, limit, std::move(unit)};
}
inline Bound at_most(double limit, std::string unit = {}) {
    return {false, limit, std::move(unit)};
}

/// A target and its measurement.
struct Target {
    std::string id;    ///< "T1"
    std::string what;  ///< the subject and its size
    double measured;
    Bound bound;
    std::string remark{};  ///< the terms of a ratio, or a peer's additional work

    [[nodiscard]] bool met() const {
        return bound.is_least ? measured >= bound.limit : measured <= bound.limit;
    }
};

/// A row of a table: numbers by the names of their columns.
struct Row {
    std::string name;
    std::vector<std::pair<std::string, double>> numbers;
};

struct Section {
    std::string title;
    std::vector<Row> rows;
};

/// All measurements of a run.
class Report {
public:
    /// A fact about the machine or this run.
    void fact(const std::string& name, const std::string& value);
    /// Adds a missing measurement and its reason.
    void missing(const std::string& line);
    void add(const std::string& section, Row row);
    void target(Target target);

    [[nodiscard]] const std::vector<Section>& sections() const { return sections_; }
    [[nodiscard]] bool empty() const { return sections_.empty() && targets_.empty(); }

    /// The tables, then targets and measurements.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] std::string json() const;

private:
    [[nodiscard]] std::string targets_text() const;

    std::vector<std::pair<std::string, std::string>> facts_;
    std::vector<std::string> missing_;
    std::vector<Section> sections_;
    std::vector<Target> targets_;
};

/// "10⁴", "4·10⁶"; 300 stays "300".
[[nodiscard]] std::string in_powers(std::size_t count);

/// One run of the benchmark: its options and its report.
struct Bench {
    bool full = false;         ///< the campaign, some minutes instead of one
    bool all_methods = false;  ///< otherwise a representative few
    bool quiet = false;
    std::string only{};  ///< regular expression; empty for everything
    Limits limits{};
    Effort effort{};
    Report report{};

    /// Whether to measure something of this name; if so, shows it on the terminal.
    [[nodiscard]] bool wants(std::string_view name) const;
    /// Converts the seconds of some work to ns for each of its `per` parts.
    [[nodiscard]] static double ns(double seconds, double per) { return seconds / per * 1e9; }
    /// A number of bodies that exceeds every cache.
    [[nodiscard]] std::size_t memory_bodies() const { return full ? 10'000'000 : 4'000'000; }
};

void bench_limits(Bench& bench);
void bench_agreement(Bench& bench);
void bench_steps(Bench& bench);
void bench_methods(Bench& bench);
void bench_prices(Bench& bench);
void bench_threads(Bench& bench);
void bench_settled(Bench& bench);
void bench_nets(Bench& bench);
void bench_entities(Bench& bench);
void bench_memory(Bench& bench);
void bench_loop(Bench& bench);
void bench_frames(Bench& bench);
void bench_peers(Bench& bench);
void bench_bounces(Bench& bench);
void bench_bounce_costs(Bench& bench);
void bench_obstacles(Bench& bench);
void bench_obstacle_errors(Bench& bench);

}  // namespace oiler::bench
