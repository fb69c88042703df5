// SPDX-License-Identifier: MIT
#include <algorithm>

#include "oiler/core/error.hpp"
#include "oiler/lab/sweep/json.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::lab {
namespace {

std::string name_of(const Ladder& ladder) {
    return fmt::format("{} in {}", ladder.method->name, oiler::name_of(ladder.precision));
}

bool is_same_ladder(const Ladder& a, const Ladder& b) {
    return a.method == b.method && a.precision == b.precision;
}

/// All of its numbers, of which unknown ones are equal here.
std::string text_of(const ReferenceSummary& reference) { return json_of(reference).dump(1); }

void require_same_sweep(const Tradeoff& part, const Tradeoff& first) {
    const bool same = part.fingerprint == first.fingerprint && part.scene == first.scene &&
                      part.title == first.title && part.duration == first.duration &&
                      part.current == first.current &&
                      text_of(part.reference) == text_of(first.reference) &&
                      std::ranges::equal(part.ladders, first.ladders, is_same_ladder);
    if (!same)
        fail(Exit::usage,
             "{}: not of one sweep with {}: the scene, the options or the version differ; give "
             "parts of one sweep",
             part.file, first.file);
}

/// Adds what `part` has measured to `whole`. `files` are those that measured the ladders of
/// `whole`.
void add(const Tradeoff& part, Tradeoff& whole, std::vector<std::string>& files) {
    for (const Machine& machine : part.machines)
        if (std::ranges::find(whole.machines, machine) == whole.machines.end())
            whole.machines.push_back(machine);
    for (std::size_t i = 0; i < part.ladders.size(); ++i) {
        if (!part.ladders[i].done) continue;
        if (whole.ladders[i].done)
            fail(Exit::usage, "{}: {} is in {}, too; give each part once", part.file,
                 name_of(part.ladders[i]), files[i]);
        whole.ladders[i] = part.ladders[i];
        files[i] = part.file;
    }
}

std::string list_files(const std::vector<Tradeoff>& parts) {
    constexpr std::size_t most = 8;
    std::string list;
    for (std::size_t i = 0; i < parts.size() && i < most; ++i)
        list += (i == 0 ? "" : ", ") + parts[i].file;
    return parts.size() > most ? list + ", …" : list;
}

}  // namespace

Tradeoff merge(const std::vector<Tradeoff>& parts) {
    Tradeoff whole = parts.front();
    whole.file.clear();
    for (Ladder& ladder : whole.ladders)
        ladder = {.method = ladder.method, .precision = ladder.precision};
    std::vector<std::string> files(whole.ladders.size());
    for (const Tradeoff& part : parts) {
        require_same_sweep(part, parts.front());
        add(part, whole, files);
    }
    const auto is_missing = [](const Ladder& ladder) { return !ladder.done; };
    const auto missing = std::ranges::count_if(whole.ladders, is_missing);
    if (missing > 0)
        fail(Exit::usage,
             "{}: {} of {} ladders (methods × precisions) are missing, first {}; give all parts, "
             "and run the command of an interrupted part again",
             list_files(parts), missing, whole.ladders.size(),
             name_of(*std::ranges::find_if(whole.ladders, is_missing)));
    return whole;
}

}  // namespace oiler::lab
