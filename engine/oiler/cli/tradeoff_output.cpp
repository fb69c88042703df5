// SPDX-License-Identifier: MIT
#include "oiler/cli/tradeoff_output.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "oiler/cli/output.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/length_text.hpp"
#include "oiler/lab/sweep/tradeoff_file.hpp"
#include "oiler/lab/sweep/tradeoff_picture.hpp"
#include "oiler/process/console.hpp"

namespace oiler::cli {

using namespace lab;

namespace {

constexpr const char* data_file = "tradeoff.json";
constexpr const char* table_file = "tradeoff.csv";
constexpr const char* time_picture = "error_over_time.png";
constexpr const char* evaluations_picture = "error_over_evaluations.png";

constexpr auto tradeoff_legend = R"(
* Pareto front: no cheaper setting is more accurate; > current setting. drawn m: the largest error of
any body at any time, on straight lines between steps; steps m: at the steps; phase: at the end, +
leads; energy: relative error at the steps; forces: evaluations in the run; µs per s: mean computing
time per simulated second in a game of 60 frames per second, with warm caches and one step per call,
±: half the interquartile range of repeated times; frame: its share of the time; in calls: µs per s
at many steps per call, as with --steps.
{} of {} rows are shown{}
)";

std::string heading(const Tradeoff& tradeoff) {
    const ReferenceSummary& reference = tradeoff.reference;
    std::string text = fmt::format("{}\n  {:.4g} s; reference: {}\n",
                                   tradeoff.title.empty() ? tradeoff.scene : tradeoff.title,
                                   reference.meaningful_until, reference.words);
    text += fmt::format(
        "  errors below {}, 100 × the reference's own error of {}, are shown as < limit\n",
        length_text(reference.floor.position), length_text(reference.position_error));
    if (tradeoff.machines.size() > 1)
        text += fmt::format(
            "  times come from {} machines: compare only times of one method in one precision\n",
            tradeoff.machines.size());
    if (!reference.why_no_longer.empty())
        text += fmt::format("  only the first {:.4g} s of {:.4g} s are measured:\n  {}\n",
                            reference.meaningful_until, tradeoff.duration, reference.why_no_longer);
    return text;
}

std::string line_of(const TradeoffRow& row, const Tradeoff& tradeoff, char mark) {
    const Judgement& judgement = row.judgement;
    const auto error = [&](double metres) {
        if (!judgement.stable) return std::string("unstable");
        return std::isnan(metres) ? fmt::format("<{:.1e}", tradeoff.reference.floor.position)
                                  : fmt::format("{:.3g}", metres);
    };
    return fmt::format(
        "{} {:<30} {:>7} {:<6} {:>9} {:>9} {:>8} {:>9} {:>9} {:>9} {:>4} {:>8} {:>9}\n", mark,
        row.stepping.method->name, row.stepping.rate.steps, name_of(row.stepping.precision),
        error(judgement.position_error), error(judgement.step_error),
        cell(judgement.phase_error, "{:.2g}"), cell(judgement.energy_drift, "{:.2g}"),
        cell(judgement.evaluations, "{:.4g}"), cell(row.ns_per_second / 1e3, "{:.4g}"),
        cell(100 * row.ns_spread / row.ns_per_second, "{:.0f}%"),
        cell(row.ns_per_second / 1e7, "{:.2g}%"), cell(row.ns_together / 1e3, "{:.4g}"));
}

/// Returns the cheapest row of a method for each decade of error.
std::vector<const TradeoffRow*> cheapest_of(const Tradeoff& tradeoff, const Method* method) {
    std::vector<const TradeoffRow*> rows;
    for (const TradeoffRow* row : tradeoff.rows())
        if (row->stepping.method == method && row->judgement.stable) rows.push_back(row);
    std::ranges::stable_sort(rows, {}, &TradeoffRow::ns_per_second);
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
        if (row && std::ranges::find(rows, row) == rows.end()) rows.push_back(row);
    };
    for (const Method* method : notable_methods(tradeoff))
        for (const TradeoffRow* row : cheapest_of(tradeoff, method)) add(row);
    add(tradeoff.find(tradeoff.current));
    std::ranges::stable_sort(rows, {}, &TradeoffRow::ns_per_second);
    return rows;
}

std::string table_of(const Tradeoff& tradeoff, bool all) {
    std::string text = heading(tradeoff);
    text += fmt::format(
        "\n  {:<30} {:>7} {:<6} {:>9} {:>9} {:>8} {:>9} {:>9} {:>9} {:>4} {:>8} {:>9}\n", "method",
        "Hz", "", "drawn m", "steps m", "phase °", "energy", "forces", "µs per s", "±", "frame",
        "in calls");
    const auto front = pareto(tradeoff, time_of);
    const auto shown = shown_rows(tradeoff, all);
    for (const TradeoffRow* row : shown) {
        const bool best = std::ranges::find(front, row) != front.end();
        const char mark = row->stepping == tradeoff.current ? '>' : best ? '*' : ' ';
        text += line_of(*row, tradeoff, mark);
    }
    text += fmt::format(tradeoff_legend, shown.size(), tradeoff.rows().size(),
                        all ? "." : "; --all and tradeoff.csv have all of them.");
    for (const RateSeries& series : tradeoff.all_series)
        if (series.done && series.rows.empty() && series.precision == Precision::double_)
            text += fmt::format("Omitted: {}\n", series.end);
    return text;
}

}  // namespace

bool is_tradeoff_file(std::string_view name) {
    return name == data_file || name == table_file || name == time_picture ||
           name == evaluations_picture || name == energy_picture;
}

std::optional<Tradeoff> find_earlier(const std::filesystem::path& path) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(path, none) || std::filesystem::is_empty(path, none))
        return std::nullopt;
    return parse_tradeoff(read_text(path), path.string(), "remove it or choose another place");
}

void save(const Tradeoff& tradeoff, const std::filesystem::path& path) {
    write_file(path, file_text(tradeoff), kinds::sweep, Links::replaced);
}

void remove_picture(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::remove(path, error);
    if (error)
        fail(Exit::io, "cannot remove {} of an earlier sweep: {}; choose another folder",
             path.string(), error.message());
}

void publish(const Tradeoff& tradeoff, const TradeoffOutput& output, Stills& stills) {
    save(tradeoff, output.out / data_file);
    write_file(output.out / table_file, to_csv(tradeoff), kinds::table, Links::replaced);
    if (!output.json.empty()) write_file(output.json, file_text(tradeoff), kinds::sweep);
    if (output.json != "-") print(table_of(tradeoff, output.all));
    stills.write(
        work_precision(tradeoff, {time_of, 1e3, "computing time per simulated second, µs", "µs"}),
        output.out / time_picture);
    stills.write(
        work_precision(tradeoff, {evaluations_of, 1, "force evaluations in the run", "forces"}),
        output.out / evaluations_picture);
    remark(output.quiet, "the table and the pictures are in {}", output.out.string());
}

}  // namespace oiler::cli
