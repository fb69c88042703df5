// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "oiler/app/interrupt.hpp"
#include "oiler/app/stills.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/cli/measuring.hpp"
#include "oiler/lab/sweep/tradeoff_file.hpp"
#include "oiler/lab/sweep/tradeoff_picture.hpp"

namespace oiler::cli {
namespace {

std::string head(const Tradeoff& tradeoff) {
    const ReferenceSummary& reference = tradeoff.reference;
    std::string text =
        fmt::format("{}\n  {:.4g} s, looked at {} times a second; measured against {}\n",
                    tradeoff.title.empty() ? tradeoff.scene : tradeoff.title,
                    reference.meaningful_until, tradeoff.samples.per_second, reference.words);
    text += fmt::format(
        "  errors below {:.2g} m are not told: a hundred times the reference's own {:.2g} m\n",
        reference.floor.position, reference.position_error);
    if (tradeoff.machines.size() > 1)
        text += fmt::format(
            "  times are of {} machines: compare only those of a method in one precision\n",
            tradeoff.machines.size());
    if (!reference.why_no_longer.empty())
        text += fmt::format("  of its {:.4g} s only the first {:.4g} mean anything:\n  {}\n",
                            tradeoff.duration, reference.meaningful_until, reference.why_no_longer);
    return text;
}

std::string cell(double value, const char* format) {
    return std::isnan(value) ? "-" : fmt::format(fmt::runtime(format), value);
}

std::string line_of(const TradeoffRow& row, const Tradeoff& tradeoff, char mark) {
    const Judgement& judgement = row.judgement;
    const std::string error = !judgement.stable ? "unstable"
                              : judgement.below_floor()
                                  ? fmt::format("<{:.1e}", tradeoff.reference.floor.position)
                                  : fmt::format("{:.3g}", judgement.position_error);
    return fmt::format(
        "{} {:<30} {:>7}{} {:<6} {:>9} {:>9} {:>8} {:>9} {:>9} {:>10} {:>4}\n", mark,
        row.stepping.method->name, row.stepping.rate.steps, row.meets_steps ? ' ' : '~',
        name_of(row.stepping.precision), error, cell(judgement.velocity_error, "{:.3g}"),
        cell(judgement.phase_error, "{:.2g}"), cell(judgement.energy_drift, "{:.2g}"),
        cell(judgement.evaluations, "{:.4g}"), cell(row.ns_per_second / 1e3, "{:.4g}"),
        cell(100 * row.ns_spread / row.ns_per_second, "{:.0f}%"));
}

/// The cheapest row of a method for each decade of error.
std::vector<const TradeoffRow*> cheapest_of(const Tradeoff& tradeoff, const Method* method) {
    std::vector<const TradeoffRow*> rows;
    for (const TradeoffRow* row : tradeoff.rows())
        if (row->stepping.method == method && row->judgement.stable) rows.push_back(row);
    std::stable_sort(rows.begin(), rows.end(), [](const TradeoffRow* a, const TradeoffRow* b) {
        return a->ns_per_second < b->ns_per_second;
    });
    std::vector<const TradeoffRow*> cheapest;
    double reached = INFINITY;
    for (const TradeoffRow* row : rows) {
        const double error = row->judgement.below_floor() ? tradeoff.reference.floor.position
                                                          : row->judgement.position_error;
        const double decade = std::floor(std::log10(error));
        if (decade >= reached) continue;
        reached = decade;
        cheapest.push_back(row);
    }
    return cheapest;
}

std::vector<const TradeoffRow*> shown_rows(const Tradeoff& tradeoff, bool all) {
    if (all) return tradeoff.rows();
    std::vector<const TradeoffRow*> rows = pareto(tradeoff, time_of);
    const auto add = [&](const TradeoffRow* row) {
        if (row && std::find(rows.begin(), rows.end(), row) == rows.end()) rows.push_back(row);
    };
    for (const Method* method : notable_methods(tradeoff))
        for (const TradeoffRow* row : cheapest_of(tradeoff, method)) add(row);
    add(tradeoff.find(tradeoff.current));
    std::stable_sort(rows.begin(), rows.end(), [](const TradeoffRow* a, const TradeoffRow* b) {
        return a->ns_per_second < b->ns_per_second;
    });
    return rows;
}

std::string text_of(const Tradeoff& tradeoff, bool all) {
    std::string text = head(tradeoff);
    text +=
        fmt::format("\n  {:<30} {:>8} {:<6} {:>9} {:>9} {:>8} {:>9} {:>9} {:>10} {:>4}\n", "method",
                    "Hz", "", "error m", "m/s", "phase °", "energy", "forces", "µs per s", "±");
    const auto front = pareto(tradeoff, time_of);
    const auto shown = shown_rows(tradeoff, all);
    for (const TradeoffRow* row : shown) {
        const bool best = std::find(front.begin(), front.end(), row) != front.end();
        const char mark = row->stepping == tradeoff.current ? '>' : best ? '*' : ' ';
        text += line_of(*row, tradeoff, mark);
    }
    text += fmt::format(
        "\n* nothing that costs less is less wrong; > today's choice; ~ looked at between steps, "
        "on the\nstraight line that is drawn. error and m/s: the largest at any look; phase: at "
        "the end, + is\nahead; energy: relative drift; forces: evaluations in the run; µs per s: "
        "of computing for a\nsecond of the scene, in frames of 1/60 s. {} of {} rows are shown{}\n",
        shown.size(), tradeoff.rows().size(),
        all ? "." : ", all of them\nwith --all and in tradeoff.csv.");
    for (const Ladder& ladder : tradeoff.ladders)
        if (ladder.done && ladder.rows.empty() && ladder.precision == Precision::double_)
            text += fmt::format("Left out: {}\n", ladder.end);
    return text;
}

/// What was begun with the same scene and options, and not ended.
std::optional<Tradeoff> find_unfinished(const std::filesystem::path& path,
                                        const std::string& fingerprint, bool quiet) try {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return std::nullopt;
    Tradeoff found = parse_tradeoff(read_text(path), path.string());
    if (found.fingerprint != fingerprint || (found.complete() && found.timed()))
        return std::nullopt;
    remark(quiet, "going on with {}: {} of {} methods and precisions are done", path.string(),
           std::count_if(found.ladders.begin(), found.ladders.end(),
                         [](const Ladder& ladder) { return ladder.done; }),
           found.ladders.size());
    return found;
} catch (const Error& error) {
    if (error.exit() != Exit::usage) throw;
    remark(quiet, "{}; starting anew", error.what());
    return std::nullopt;
}

void save(const Tradeoff& tradeoff, const std::filesystem::path& path) {
    const std::string text = to_json(tradeoff);
    write_file(path, std::as_bytes(std::span(text)));
}

/// Where a trade-off is shown.
struct Places {
    std::filesystem::path out;
    std::filesystem::path json;
    bool all;  ///< rows are printed
    bool quiet;
};

/// Files, the printed table and the diagrams.
void publish(const Tradeoff& tradeoff, const Places& places, Stills& stills) {
    save(tradeoff, places.out / "tradeoff.json");
    const std::string csv = to_csv(tradeoff);
    write_file(places.out / "tradeoff.csv", std::as_bytes(std::span(csv)));
    if (!places.json.empty()) save(tradeoff, places.json);
    if (places.json != "-") print(text_of(tradeoff, places.all));
    stills.write(
        work_precision(tradeoff, {time_of, 1e3, "computing for a second of the scene, µs", "µs"}),
        places.out / "error_over_time.png");
    stills.write(
        work_precision(tradeoff, {evaluations_of, 1, "force evaluations in the run", "forces"}),
        places.out / "error_over_evaluations.png");
    remark(places.quiet, "the table and its pictures are in {}", places.out.string());
}

/// With the energies of the notable methods at today's rate, which only runs of the scene have.
void publish_whole(const Tradeoff& tradeoff, const Scene& scene, const Reference& reference,
                   const Places& places, Stills& stills) {
    publish(tradeoff, places, stills);
    std::vector<Stepping> choices;
    for (const Method* method : notable_methods(tradeoff))
        choices.push_back({method, tradeoff.current.rate, Precision::double_});
    if (!choices.empty())
        stills.write(energy_over_time(scene, tradeoff, reference, choices),
                     places.out / "energy_over_time.png");
}

}  // namespace

Exit TradeoffCommand::run() const {
    const Interrupt interrupt;
    const Scene scene = read_measured(measured);
    const SampleTimes samples = sample_times_of(scene);
    const SweepPlan plan{
        .methods = parse_methods(methods), .max_rate = max_rate, .shard = shard, .shards = shards};
    const bool whole = shards == 1;
    const std::filesystem::path part =
        out / (whole ? "tradeoff.json" : fmt::format("part-{}-of-{}.json", shard, shards));
    const std::string mark = fingerprint(read_text(measured.scene), scene, samples, plan);
    const std::optional<Tradeoff> unfinished = find_unfinished(part, mark, measured.quiet);
    const Reference reference = measure_reference(scene, samples, 0, measured.quiet);
    if (Interrupt::requested()) return Exit::interrupted;

    Tradeoff tradeoff = unfinished.value_or(start_tradeoff(scene, samples, reference, plan));
    tradeoff.scene = name_of(measured);
    tradeoff.fingerprint = mark;
    tradeoff.machines = {this_machine()};
    make_folder(out);
    // Before the work, so that a machine that cannot draw says so at once.
    std::optional<Stills> stills;
    if (whole) stills.emplace(size);
    measure_tradeoff(tradeoff, scene, reference, plan, measured.quiet,
                     [&](const Tradeoff& so_far) { save(so_far, part); });
    save(tradeoff, part);
    if (Interrupt::requested()) {
        remark(measured.quiet, "interrupted; the same command goes on from {}", part.string());
        return Exit::interrupted;
    }
    if (whole)
        publish_whole(tradeoff, scene, reference, {out, measured.json, all, measured.quiet},
                      *stills);
    else
        remark(measured.quiet, "{} is written; oiler merge joins all parts", part.string());
    return Exit::done;
}

Exit MergeCommand::run() const {
    std::vector<Tradeoff> read;
    for (const std::filesystem::path& path : parts)
        read.push_back(parse_tradeoff(read_text(path), path.string()));
    const Tradeoff tradeoff = merge(read);
    if (!tradeoff.timed())
        fail(Exit::usage,
             "some parts were interrupted before they were timed: run their commands again");
    make_folder(out);
    Stills stills(size);
    publish(tradeoff, {out, json, all, quiet}, stills);
    return Exit::done;
}

}  // namespace oiler::cli
