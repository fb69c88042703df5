// SPDX-License-Identifier: MIT
#include "oiler/cli/measuring.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>
#include <variant>

#include "oiler/app/interrupt.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/scene/read.hpp"

namespace oiler::cli {
namespace {

bool is_in(const Method& method, const std::string& group) {
    const bool splits = std::holds_alternative<Splitting>(method.rule);
    if (group == "splitting") return splits;
    if (group == "explicit") return splits || std::holds_alternative<Tableau>(method.rule);
    return group == "all";
}

}  // namespace

Scene read_measured(const Measured& measured) {
    Scene scene = read_scene(measured.scene.string());
    if (measured.duration > 0) scene.duration = measured.duration;
    return scene;
}

std::string name_of(const Measured& measured) { return measured.scene.stem().string(); }

std::vector<const Method*> parse_methods(const std::string& words) {
    std::vector<const Method*> chosen;
    for (const Method& method : methods())
        if (is_in(method, words)) chosen.push_back(&method);
    if (!chosen.empty()) return chosen;
    std::istringstream stream(words);
    for (std::string name; std::getline(stream, name, ',');) {
        const Method* const method = &find_method(name);
        if (std::find(chosen.begin(), chosen.end(), method) == chosen.end())
            chosen.push_back(method);
    }
    if (chosen.empty())
        fail(Exit::usage, "--methods: give splitting, explicit, all, or names with commas between");
    return chosen;
}

std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        fail(Exit::io, "{}: it is a folder; give a file", path.string());
    if (!file) fail(Exit::io, "{}: cannot be read: {}", path.string(), system_reason(errno));
    return {std::istreambuf_iterator<char>(file), {}};
}

void print(const std::string& text) { write_file("-", std::as_bytes(std::span(text))); }

Reference measure_reference(const Scene& scene, const SampleTimes& samples, double wanted,
                            bool quiet) {
    Percent percent(quiet, "of the work that a reference may take");
    ReferenceEffort effort{.wanted = wanted};
    effort.progress = [&](double share) { percent(share); };
    effort.stopped = Interrupt::requested;
    return make_reference(scene, samples, effort);
}

void measure_tradeoff(Tradeoff& tradeoff, const Scene& scene, const Reference& reference,
                      const SweepPlan& plan, bool quiet,
                      const std::function<void(const Tradeoff&)>& ladder_done) {
    SweepWatch watch;
    watch.stopped = Interrupt::requested;
    watch.ladder_done = ladder_done;
    {
        Percent percent(quiet, "of the errors");
        watch.progress = [&](double share) { percent(share); };
        sweep(tradeoff, scene, reference, plan, watch);
    }
    constexpr int rounds = 7;
    Percent percent(quiet, "of the times");
    watch.progress = [&](double share) { percent(share); };
    std::vector<TradeoffRow*> rows;
    for (Ladder& ladder : tradeoff.ladders)
        for (TradeoffRow& row : ladder.rows) rows.push_back(&row);
    time_rows(scene, rows, rounds, watch);
}

}  // namespace oiler::cli
