// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "oiler/cli/measuring.hpp"
#include "oiler/cli/output.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/cli/tradeoff_output.hpp"
#include "oiler/lab/sweep/tradeoff_file.hpp"
#include "oiler/lab/sweep/tradeoff_picture.hpp"
#include "oiler/process/interrupt.hpp"

namespace oiler::cli {

using namespace lab;

namespace {

/// Reads the unfinished trade-off of the same scene and options, if there is one.
std::optional<Tradeoff> find_unfinished(const std::filesystem::path& path,
                                        const std::string& fingerprint, bool quiet) {
    std::optional<Tradeoff> found = find_earlier(path);
    if (!found || (found->complete() && found->timed())) return std::nullopt;
    if (found->fingerprint != fingerprint) {
        remark(quiet, "{} is unfinished, but of another scene or other options: it is replaced",
               path.string());
        return std::nullopt;
    }
    remark(quiet, "continuing {}: {} of {} methods and precisions are done", path.string(),
           std::ranges::count(found->all_series, true, &RateSeries::done),
           found->all_series.size());
    return found;
}

/// Draws the energies of the notable methods at the scene's current rate. Takes runs of the scene,
/// so `oiler merge` has no such picture.
void draw_energies(const Tradeoff& tradeoff, const Scene& scene, const Reference& reference,
                   const std::filesystem::path& path, Stills& stills) {
    std::vector<Stepping> settings;
    for (const Method* method : notable_methods(tradeoff))
        settings.push_back({method, tradeoff.current.rate, Precision::double_});
    if (settings.empty()) return remove_picture(path);
    stills.write(energy_over_time(scene, tradeoff, reference, settings), path);
}

/// One part of a sweep that several machines share.
struct Shard {
    int index = 1;  ///< from 1
    int count = 1;

    [[nodiscard]] bool is_whole() const { return count == 1; }
    [[nodiscard]] std::string file_name() const {
        return is_whole() ? "tradeoff.json" : fmt::format("part-{}-of-{}.json", index, count);
    }
};

bool is_file_of_sweep(std::string_view name) {
    return is_tradeoff_file(name) || (name.starts_with("part-") && name.ends_with(".json"));
}

/// Parses "K/N"; no words are the whole sweep. Throws Error{usage}.
Shard parse_shard(const std::string& words) {
    if (words.empty()) return {};
    constexpr int most = 1000;
    const std::size_t slash = words.find('/');
    const Shard shard{parse_integer(words.substr(0, slash)),
                      slash == words.npos ? 0 : parse_integer(words.substr(slash + 1))};
    if (shard.index < 1 || shard.index > shard.count || shard.count > most)
        fail(Exit::usage, "--shard {}: give K/N, part K of N with N up to {}, such as 1/4", words,
             most);
    return shard;
}

}  // namespace

struct TradeoffCommand {
    static constexpr CommandTexts texts{
        .name = "tradeoff",
        .summary = "Measure error and cost of all methods and rates on a scene",
        .example = "assets/scenes/orbit.toml --out orbit",
        .notes =
            "Ctrl-C interrupts it; the same command continues. On three machines:\n"
            "  oiler tradeoff SCENE --shard 1/3 --out parts    (2/3 and 3/3 on the others)\n"
            "  oiler merge parts/part-*.json --out whole"};

    SceneOptions scene_options;
    std::string methods = "all";
    std::int64_t max_rate = 0;  ///< Hz; 0: see SweepPlan
    std::string shard_words;
    bool all = false;
    PictureOptions pictures{.out = "tradeoff"};

    void declare(Arguments& arguments) {
        scene_options.declare(arguments, kinds::sweep);
        add_method_list(arguments, methods);
        arguments.add_integer(
            "--max-rate", max_rate, 1, 1'000'000,
            "highest rate in Hz besides the scene's own, 61,440 or more if not given");
        arguments.add_option("--shard", shard_words, "K/N", "measure part K of N");
        arguments.add_flag("--all", all, "print all rows");
        pictures.declare(arguments, is_file_of_sweep);
    }

    [[nodiscard]] Exit run() const;
};

namespace {

/// A run of `oiler tradeoff` after its options were parsed.
class TradeoffRun {
public:
    TradeoffRun(const TradeoffCommand& options, const Shard& shard, Size size)
        : options_(options),
          shard_(shard),
          size_(size),
          scene_(options.scene_options.read()),
          plan_{.methods = parse_methods(options.methods),
                .max_rate = options.max_rate,
                .shard = shard.index,
                .shards = shard.count},
          part_(options.pictures.out / shard.file_name()) {}

    [[nodiscard]] Exit run() {
        const std::string inputs =
            fingerprint(read_text(options_.scene_options.file), scene_, plan_);
        const std::optional<Tradeoff> unfinished = find_unfinished(part_, inputs, quiet());
        (void)find_earlier(options_.scene_options.json);
        const Reference reference = measure_reference(scene_, 0, quiet());
        if (Interrupt::requested()) return Exit::interrupted;
        Tradeoff tradeoff = unfinished.value_or(start_tradeoff(scene_, reference, plan_));
        tradeoff.scene = options_.scene_options.name();
        tradeoff.fingerprint = inputs;
        tradeoff.machines = {this_machine()};
        return complete(tradeoff, reference);
    }

private:
    [[nodiscard]] bool quiet() const { return options_.scene_options.quiet; }

    [[nodiscard]] Exit complete(Tradeoff& tradeoff, const Reference& reference) {
        const std::filesystem::path& out = options_.pictures.out;
        make_folder(out);
        // A machine that cannot draw reports it before the work.
        std::optional<Stills> stills;
        if (shard_.is_whole()) stills.emplace(size_);
        measure_tradeoff(tradeoff, scene_, reference, plan_, quiet(),
                         [&](const Tradeoff& so_far) { save(so_far, part_); });
        save(tradeoff, part_);
        if (Interrupt::requested()) {
            remark(quiet(), "the same command continues from {}", part_.string());
            return Exit::interrupted;
        }
        if (!stills) {
            remark(quiet(), "{} is written; oiler merge joins all parts", part_.string());
            return Exit::done;
        }
        publish(tradeoff, {out, options_.scene_options.json, options_.all, quiet()}, *stills);
        draw_energies(tradeoff, scene_, reference, out / energy_picture, *stills);
        return Exit::done;
    }

    const TradeoffCommand& options_;
    Shard shard_;
    Size size_;
    Scene scene_;
    SweepPlan plan_;
    std::filesystem::path part_;
};

}  // namespace

Exit TradeoffCommand::run() const {
    const Shard shard = parse_shard(shard_words);
    if (!shard.is_whole() && !scene_options.json.empty())
        fail(Exit::usage, "--json: a part is written to {}; give --json to oiler merge",
             (pictures.out / shard.file_name()).string());
    return TradeoffRun(*this, shard, pictures.size()).run();
}

template Command make_command<TradeoffCommand>();

}  // namespace oiler::cli
