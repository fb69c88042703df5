// SPDX-License-Identifier: MIT
#include "oiler/compare/captured_states.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

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

}  // namespace

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
             "{}: the capture has no states, because it has more than 1000 bodies or no PNG; "
             "compare two files of --trace",
             log.name);
    log.names = numbering.names();
    return log;
}

std::optional<std::int64_t> first_different_tick(const Captured& a, const Captured& b) {
    const auto hashes_b = b.tick_hashes();
    for (const auto& [tick, hash] : a.tick_hashes()) {
        const auto found = hashes_b.find(tick);
        if (found != hashes_b.end() && found->second != hash) return tick;
    }
    return std::nullopt;
}

}  // namespace oiler
