// SPDX-License-Identifier: MIT
#include "oiler/cli/ledger_text.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "oiler/cli/measuring.hpp"
#include "oiler/cli/output.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/core/length_text.hpp"
#include "oiler/scene/read.hpp"

namespace oiler::cli {

using namespace lab;

namespace {

/// Returns the steps of the scene's duration, two at least.
std::int64_t steps_of(const Scene& scene) {
    return std::max<std::int64_t>(
        2, std::llround(scene.duration * static_cast<double>(scene.stepping.rate.steps)));
}

Json to_json(const LedgerColumn& column) {
    return {{"of", column.of},         {"nth", column.index},
            {"number", column.number}, {"stored", column.shared ? "shared" : "own"},
            {"bytes", column.bytes},   {"bodies", column.bodies}};
}

Json to_json(const LedgerPass& pass) {
    return {{"name", pass.name},
            {"ns_per_body_step", number(pass.ns)},
            {"saves_ns", number(pass.saves_ns)},
            {"saves_percent", number(pass.saves_percent)},
            {"spread_percent", number(pass.spread_percent)},
            {"changes_position_m", number(pass.changes_position)},
            {"diverges", pass.diverged}};
}

Json to_json(const Scene& scene, const std::string& name, const Ledger& ledger) {
    const auto to_item = [](const auto& item) { return to_json(item); };
    Json stepping = to_json(scene.stepping);
    return {{"scene", name},
            {"title", scene.title},
            {"method", stepping["method"]},
            {"rate", stepping["rate"]},
            {"precision", stepping["precision"]},
            {"axes", scene.axes},
            {"bodies", ledger.bodies},
            {"links", ledger.links},
            {"steps", ledger.steps},
            {"looks", ledger.samples},
            {"timed_steps", ledger.timed_steps},
            {"rounds", ledger.rounds},
            {"bytes_per_body", ledger.bytes_per_body()},
            {"bytes_per_link", ledger.bytes_per_link},
            {"columns", Json::list(ledger.columns, to_item)},
            {"absent", ledger.absent},
            {"ns_per_body_step", number(ledger.ns)},
            {"spread_ns", number(ledger.spread_ns)},
            {"passes", Json::list(ledger.passes, to_item)},
            {"flags", ledger.flags},
            {"diverges", ledger.diverged}};
}

std::string heading(const Scene& scene, const std::string& name, const Ledger& ledger,
                    std::int64_t wanted) {
    std::string text = fmt::format(
        "{}\n  {}, {} {}, {} {}, {} {}, {} steps", scene.title.empty() ? name : scene.title,
        describe(Stepping{scene.stepping.method, scene.stepping.rate, scene.stepping.precision}),
        scene.axes, scene.axes == 1 ? "axis" : "axes", ledger.bodies,
        ledger.bodies == 1 ? "body" : "bodies", ledger.links, ledger.links == 1 ? "link" : "links",
        ledger.steps);
    if (ledger.steps < wanted && !ledger.diverged)
        text += fmt::format(" of {}: more steps would take too long", wanted);
    return text + "\n";
}

/// The numbers of one force or body property, which are adjacent columns.
class ColumnGroup {
public:
    explicit ColumnGroup(const LedgerColumn& first) : first_(first) {}

    [[nodiscard]] bool has(const LedgerColumn& column) const {
        return column.of == first_.of && column.index == first_.index;
    }
    void add(const LedgerColumn& column) {
        (column.shared ? shared_ : own_).push_back(column.number);
        bytes_ += column.bytes;
    }
    [[nodiscard]] std::string line(std::int64_t bodies) const {
        std::string where;
        if (!own_.empty()) where = fmt::format("a column each: {}", fmt::join(own_, ", "));
        if (!shared_.empty())
            where += fmt::format("{}shared by all: {}", where.empty() ? "" : "; ",
                                 fmt::join(shared_, ", "));
        if (first_.bodies < bodies)
            where += fmt::format("; {} of {} bodies have it", first_.bodies, bodies);
        const std::string name =
            first_.index == 0 ? first_.of : fmt::format("{} {}", first_.of, first_.index + 1);
        return fmt::format("  {:<15} {:>6}  {}\n", name, bytes_, where);
    }

private:
    LedgerColumn first_;
    std::vector<std::string> own_;
    std::vector<std::string> shared_;
    std::size_t bytes_ = 0;
};

std::vector<ColumnGroup> groups_of(const Ledger& ledger) {
    std::vector<ColumnGroup> groups;
    for (const LedgerColumn& column : ledger.columns) {
        if (groups.empty() || !groups.back().has(column)) groups.emplace_back(column);
        groups.back().add(column);
    }
    return groups;
}

std::string columns_text(const Ledger& ledger) {
    std::string text = "\nStored           bytes per body\n";
    for (const ColumnGroup& group : groups_of(ledger)) text += group.line(ledger.bodies);
    if (ledger.links > 0)
        text += fmt::format("  {:<15} {:>6.1f}  {:.4g} bytes each, {:.2f} per body\n", "links",
                            static_cast<double>(ledger.links) * ledger.bytes_per_link /
                                static_cast<double>(ledger.bodies),
                            ledger.bytes_per_link,
                            static_cast<double>(ledger.links) / static_cast<double>(ledger.bodies));
    text += fmt::format("  {:<15} {:>6.4g}\n", "total", ledger.bytes_per_body());
    if (!ledger.absent.empty())
        text += fmt::format("Not stored, not evaluated: {}\n", fmt::join(ledger.absent, ", "));
    return text;
}

std::string change_text(const LedgerPass& pass) {
    if (pass.diverged) return "diverges";
    return length_text(pass.changes_position);
}

std::string saving_text(const LedgerPass& pass) {
    if (std::isnan(pass.saves_percent)) return "-";
    const std::string spread = fmt::format("± {:>4.2g} %", pass.spread_percent);
    if (pass.is_within_spread()) return "within the spread, " + spread;
    return fmt::format("{:.3g} ns, {:>6.1f} {}", pass.saves_ns, pass.saves_percent, spread);
}

constexpr auto passes_head = R"(
A step takes {:.3g} ± {:.2g} ns per body. Ablation: a step without one part.
Savings overlap and need not add up; a negative saving is a slower step.
)";
// For implicit methods: an ablation that stays at rest would need fewer iterations.
constexpr auto passes_foot = R"( Timed: {} rounds of {} {}
per call, all scenes of a round from one state of the whole scene's run, so that implicit
solvers iterate on the same motion. ±: half the interquartile range.
Compared: the positions at {} sample times in {} steps.
)";

std::string passes_text(const Ledger& ledger) {
    if (ledger.passes.empty() || ledger.diverged) return "";
    std::string text = fmt::format(passes_head, ledger.ns, ledger.spread_ns);
    text += fmt::format("  {:<15} {:>28}  {}\n", "without", "saves", "moves a body by up to");
    for (const LedgerPass& pass : ledger.passes)
        if (pass.name != "moving")
            text += fmt::format("  {:<15} {:>28}  {}\n", pass.name, saving_text(pass),
                                change_text(pass));
    const LedgerPass& moving = ledger.passes.back();
    text += moving.diverged ? "The run without all of them diverges."
                            : fmt::format("A step without all of them takes {:.3g} ns.", moving.ns);
    return text + fmt::format(passes_foot, ledger.rounds, ledger.timed_steps,
                              ledger.timed_steps == 1 ? "step" : "steps", ledger.samples,
                              ledger.steps);
}

std::string flags_text(const Ledger& ledger) {
    std::string text;
    for (const std::string& flag : ledger.flags) text += fmt::format("  {}\n", flag);
    if (text.empty()) text = "  none\n";
    return ledger.diverged ? "" : "\nWithout effect:\n" + text;
}

Ledger measure(const Scene& scene, std::int64_t steps, bool quiet) {
    Percent percent(quiet, "measured");
    return ledger(scene, steps, std::ref(percent));
}

}  // namespace

std::string ledger_text(const Scene& scene, const std::string& name, const Ledger& ledger,
                        std::int64_t wanted) {
    std::string text =
        heading(scene, name, ledger, wanted) + columns_text(ledger) + passes_text(ledger);
    for (const LedgerPass& pass : ledger.passes)
        if (pass.diverged) text += fmt::format("Without {}: {}\n", pass.name, *pass.diverged);
    return text + flags_text(ledger);
}

struct LedgerCommand {
    static constexpr CommandTexts texts{
        .name = "ledger",
        .summary = "Measure the cost and the effect of each part of a scene",
        .example = "assets/scenes/salvo.toml",
        .notes =
            "--json has scene, title, method, rate, precision, axes, bodies, links, steps, looks,\n"
            "timed_steps, rounds, bytes_per_body, bytes_per_link, columns, absent,\n"
            "ns_per_body_step, spread_ns, passes (name, ns_per_body_step, saves_ns,\n"
            "saves_percent, spread_percent, changes_position_m, diverges) and flags.\n"
            "Times are medians, spreads half interquartile ranges. null: not measurable."};

    std::filesystem::path file;
    std::int64_t steps = 0;  ///< largest number; 0: the steps of the scene's duration
    std::filesystem::path json;
    bool quiet = false;

    void declare(Arguments& arguments) {
        arguments.add_required("SCENE", file, "scene file");
        arguments.add_integer("--steps", steps, 2, 1'000'000'000,
                              "largest number of steps, the scene's duration if not given");
        add_json(arguments, json);
        add_quiet(arguments, quiet);
    }

    [[nodiscard]] Exit run() const {
        const Scene scene = read_scene(file.string());
        const std::string name = file.stem().string();
        const std::int64_t wanted = steps > 0 ? steps : steps_of(scene);
        const Ledger measured = measure(scene, wanted, quiet);
        if (!json.empty()) write_json(json, to_json(scene, name, measured));
        if (json != "-") print(ledger_text(scene, name, measured, wanted));
        if (!measured.diverged) return Exit::done;
        say(*measured.diverged);
        return Exit::diverged;
    }
};

template Command make_command<LedgerCommand>();

}  // namespace oiler::cli
