// SPDX-License-Identifier: MIT
#include "oiler/compare/runs/state_log.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "oiler/capture/capture_folder.hpp"
#include "oiler/core/error.hpp"

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

/// Numbers names in the order in which they come.
class Numbering {
public:
    explicit Numbering(std::vector<std::string> names) : names_(std::move(names)) {
        for (std::size_t i = 0; i < names_.size(); ++i)
            numbers_[names_[i]] = static_cast<std::uint32_t>(i);
    }

    [[nodiscard]] std::uint32_t number_of(const std::string& name) {
        const auto [found, added] =
            numbers_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
        if (added) names_.push_back(name);
        return found->second;
    }
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

private:
    std::vector<std::string> names_;
    std::map<std::string, std::uint32_t> numbers_;
};

void add_tick(StateLog& log, const Manifest::Frame& frame, double time,
              const std::vector<BodyState>& bodies, Numbering& numbering) {
    std::map<std::uint32_t, const BodyState*> by_number;
    for (const BodyState& body : bodies) by_number[numbering.number_of(body.name)] = &body;
    log.ticks.push_back({frame.tick, time, log.bodies.size()});
    for (const auto& [number, body] : by_number) {
        log.bodies.push_back(number);
        log.values.insert(log.values.end(), body->position.begin(), body->position.end());
        log.values.insert(log.values.end(), body->velocity.begin(), body->velocity.end());
    }
}

/// The state hash of each frame, by tick.
std::map<std::int64_t, std::uint64_t> state_hashes(const Captured& captured) {
    std::map<std::int64_t, std::uint64_t> hashes;
    for (const Manifest::Frame& frame : captured.manifest().frames)
        hashes.emplace(frame.tick, frame.state_hash);
    return hashes;
}

/// The first tick of both whose hashes differ.
template <class Hash>
std::optional<std::int64_t> first_difference(const std::map<std::int64_t, Hash>& a,
                                             const std::map<std::int64_t, Hash>& b) {
    for (const auto& [tick, hash] : a) {
        const auto found = b.find(tick);
        if (found != b.end() && found->second != hash) return tick;
    }
    return std::nullopt;
}

/// The log without the ticks that the other one passes over.
StateLog without_ticks_between(const StateLog& log, const StateLog& other) {
    StateLog kept = log;
    kept.ticks.clear();
    kept.bodies.clear();
    kept.values.clear();
    for (std::size_t i = 0; i < log.ticks.size(); ++i) {
        const StateLog::Tick& tick = log.ticks[i];
        const bool is_after = tick.tick > other.ticks.back().tick;
        if (!is_after &&
            !std::ranges::binary_search(other.ticks, tick.tick, {}, &StateLog::Tick::tick))
            continue;
        kept.ticks.push_back({tick.tick, tick.time, kept.bodies.size()});
        for (std::size_t row = tick.first_row; row < log.end_row(i); ++row) {
            kept.bodies.push_back(log.bodies[row]);
            kept.values.insert(kept.values.end(), log.row(row).begin(), log.row(row).end());
        }
    }
    return kept;
}

}  // namespace

std::optional<TickPair> TickPairs::next() {
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

StateLog state_log_of(const Captured& captured, std::vector<std::string> names) {
    const Manifest& manifest = captured.manifest();
    StateLog log;
    log.name = captured.folder().string();
    log.axes = 3;
    log.floats = manifest.precision == "float";
    Numbering numbering(std::move(names));
    for (const Manifest::Frame& frame : manifest.frames) {
        const FrameRecord* const record = captured.record(frame.index);
        const bool is_new = log.ticks.empty() || frame.tick > log.ticks.back().tick;
        if (record && is_new && !record->bodies.empty())
            add_tick(log, frame, static_cast<double>(frame.tick) / manifest.rate, record->bodies,
                     numbering);
    }
    if (log.ticks.empty())
        fail(Exit::usage,
             "{}: no states there, because {} is missing, the capture has no PNG or more than 1000 "
             "bodies; compare two files of --trace",
             log.name, records_name);
    log.names = numbering.names();
    return log;
}

void keep_common_ticks(StateLog& a, StateLog& b) {
    const StateLog all_of_a = a;
    a = without_ticks_between(a, b);
    b = without_ticks_between(b, all_of_a);
    if (a.ticks.empty() || !find_tick(a, b, a.ticks.front().tick))
        fail(Exit::usage,
             "{} and {}: their frames show no tick that both have; capture with the same --rate "
             "and --fps",
             a.name, b.name);
}

std::optional<std::int64_t> first_different_tick(const Captured& a, const Captured& b) {
    const auto in_frames = first_difference(state_hashes(a), state_hashes(b));
    const auto between = first_difference(a.tick_hashes(), b.tick_hashes());
    if (!in_frames || !between) return in_frames ? in_frames : between;
    return std::min(*in_frames, *between);
}

}  // namespace oiler
