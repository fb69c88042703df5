// SPDX-License-Identifier: MIT
#include "oiler/lab/ledger/ledger.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>

#include "oiler/app/console.hpp"
#include "oiler/cli/commands.hpp"
#include "oiler/cli/tables.hpp"
#include "oiler/scene/read.hpp"

namespace oiler::cli {
namespace {

/// As many as the scene lasts, and two at least.
std::int64_t steps_of(const Scene& scene) {
    return std::max<std::int64_t>(2,
                                  std::llround(scene.duration * static_cast<double>(scene.stepping.rate.steps)));
}

std::string head(const Scene& scene, const std::string& name, const Ledger& ledger,
                 std::int64_t wanted) {
    std::string text =
        fmt::format("{}\n  {} at {} Hz in {}, {} {}, {} {}, {} {}, {} steps",
                    scene.title.empty() ? name : scene.title, scene.stepping.method->name, scene.stepping.rate.steps,
                    name_of(scene.stepping.precision), scene.axes, scene.axes == 1 ? "axis" : "axes",
                    ledger.bodies, ledger.bodies == 1 ? "body" : "bodies", ledger.links,
                    ledger.links == 1 ? "link" : "links", ledger.steps);
    if (ledger.steps < wanted && !ledger.diverged)
        text += fmt::format(" of {}: more would take too long", wanted);
    return text + "\n";
}

/// A line for all numbers of one thing, which are side by side.
class Thing {
public:
    explicit Thing(const LedgerColumn& first) : first_(first) {}

    [[nodiscard]] bool has(const LedgerColumn& column) const {
        return column.of == first_.of && column.nth == first_.nth;
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
            first_.nth == 0 ? first_.of : fmt::format("{} {}", first_.of, first_.nth + 1);
        return fmt::format("  {:<15} {:>6}  {}\n", name, bytes_, where);
    }

private:
    LedgerColumn first_;
    std::vector<std::string> own_;
    std::vector<std::string> shared_;
    std::size_t bytes_ = 0;
};

std::vector<Thing> things_of(const Ledger& ledger) {
    std::vector<Thing> things;
    for (const LedgerColumn& column : ledger.columns) {
        if (things.empty() || !things.back().has(column)) things.emplace_back(column);
        things.back().add(column);
    }
    return things;
}

std::string columns_text(const Ledger& ledger) {
    std::string text = "\nStored           bytes per body\n";
    for (const Thing& thing : things_of(ledger)) text += thing.line(ledger.bodies);
    if (ledger.links > 0)
        text += fmt::format("  {:<15} {:>6.1f}  {} bytes each, {:.2f} to a body\n", "links",
                            static_cast<double>(ledger.links) *
                                static_cast<double>(ledger.bytes_per_link) /
                                static_cast<double>(ledger.bodies),
                            ledger.bytes_per_link,
                            static_cast<double>(ledger.links) / static_cast<double>(ledger.bodies));
    text += fmt::format("  {:<15} {:>6.4g}\n", "in all", ledger.bytes_per_body());
    if (!ledger.absent.empty())
        text += fmt::format("Not stored, not evaluated: {}\n", fmt::join(ledger.absent, ", "));
    return text;
}

std::string change_text(const LedgerPass& pass) {
    if (pass.diverged) return "diverges";
    return pass.changes_position == 0 ? "nothing" : fmt::format("{:.4g} m", pass.changes_position);
}

/// Of what leaving a pass out saves, unless the whole step differs from itself by as much.
std::string saving_text(const Ledger& ledger, const LedgerPass& pass) {
    if (!(std::abs(pass.saves_ns) > ledger.noise_ns)) return fmt::format("{:>19}", "-");
    return fmt::format("{:>9.3g} ns {:>4.0f} %", pass.saves_ns, pass.saves_percent);
}

std::string passes_text(const Ledger& ledger) {
    if (ledger.passes.empty() || ledger.diverged) return "";
    std::string text = fmt::format(
        "\nA step takes {:.3g} ns per body, {:.2g} ns more or less; - is within that. Savings "
        "overlap:\nthey need not add up, and one below 0 says that steps are slower without.\n"
        "  {:<15} {:>19}  {}\n",
        ledger.ns, ledger.noise_ns, "without", "saves", "moves a body by up to");
    for (const LedgerPass& pass : ledger.passes)
        if (pass.name != "moving")
            text += fmt::format("  {:<15} {}  {}\n", pass.name, saving_text(ledger, pass),
                                change_text(pass));
    const LedgerPass& moving = ledger.passes.back();
    text += moving.diverged
                ? "Without all of them it diverges."
                : fmt::format("Without all of them {:.3g} ns are left, for moving.", moving.ns);
    return text + fmt::format(
                      " Times are of the first {} steps, in one go;\npositions were "
                      "compared {} times in {} steps.\n",
                      ledger.timed_steps, ledger.samples, ledger.steps);
}

std::string flags_text(const Ledger& ledger) {
    std::string text;
    for (const std::string& flag : ledger.flags) text += fmt::format("  {}\n", flag);
    if (text.empty()) text = "  nothing found\n";
    return ledger.diverged ? "" : "\nWithout effect:\n" + text;
}

std::string text_of(const Scene& scene, const std::string& name, const Ledger& ledger,
                    std::int64_t wanted) {
    std::string text =
        head(scene, name, ledger, wanted) + columns_text(ledger) + passes_text(ledger);
    for (const LedgerPass& pass : ledger.passes)
        if (pass.diverged) text += fmt::format("Without {}: {}\n", pass.name, *pass.diverged);
    return text + flags_text(ledger);
}

Json to_json(const LedgerColumn& column) {
    return {{"of", column.of},         {"nth", column.nth},
            {"number", column.number}, {"stored", column.shared ? "shared" : "own"},
            {"bytes", column.bytes},   {"bodies", column.bodies}};
}

Json to_json(const LedgerPass& pass) {
    return {{"name", pass.name},
            {"ns_per_body_step", number(pass.ns)},
            {"saves_ns", number(pass.saves_ns)},
            {"saves_percent", number(pass.saves_percent)},
            {"changes_position_m", number(pass.changes_position)},
            {"diverges", pass.diverged ? Json(*pass.diverged) : Json(nullptr)}};
}

template <class Item>
Json list_of(const std::vector<Item>& items) {
    Json list = Json::array();
    for (const Item& item : items) list.push_back(to_json(item));
    return list;
}

Json to_json(const Scene& scene, const std::string& name, const Ledger& ledger) {
    return {{"scene", name},
            {"title", scene.title},
            {"method", scene.stepping.method->name},
            {"rate", scene.stepping.rate.steps},
            {"precision", name_of(scene.stepping.precision)},
            {"axes", scene.axes},
            {"bodies", ledger.bodies},
            {"links", ledger.links},
            {"steps", ledger.steps},
            {"looks", ledger.samples},
            {"timed_steps", ledger.timed_steps},
            {"bytes_per_body", ledger.bytes_per_body()},
            {"bytes_per_link", ledger.bytes_per_link},
            {"columns", list_of(ledger.columns)},
            {"absent", ledger.absent},
            {"ns_per_body_step", number(ledger.ns)},
            {"noise_ns", number(ledger.noise_ns)},
            {"passes", list_of(ledger.passes)},
            {"flags", ledger.flags},
            {"diverges", ledger.diverged ? Json(*ledger.diverged) : Json(nullptr)}};
}

Ledger measure(const Scene& scene, std::int64_t steps, bool quiet) {
    constexpr std::int64_t whole = 100;
    Progress progress(quiet, "% measured", whole);
    return ledger(scene, steps, [&](double share) {
        progress.show(static_cast<std::int64_t>(share * double{whole}));
    });
}

}  // namespace

Exit LedgerCommand::run() const {
    const Scene read = read_scene(scene.string());
    const std::string name = scene.stem().string();
    const std::int64_t wanted = steps > 0 ? steps : steps_of(read);
    const Ledger measured = measure(read, wanted, quiet);
    if (!json.empty()) write_json(json, to_json(read, name, measured));
    if (json != "-") {
        const std::string text = text_of(read, name, measured, wanted);
        write_file("-", std::as_bytes(std::span(text)));
    }
    if (!measured.diverged) return Exit::done;
    say(*measured.diverged);
    return Exit::diverged;
}

}  // namespace oiler::cli
