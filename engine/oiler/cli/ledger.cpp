// SPDX-License-Identifier: MIT
#include "oiler/lab/ledger/ledger.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/cli/files.hpp"
#include "oiler/cli/ledger_text.hpp"
#include "oiler/cli/measuring.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/cli/tables.hpp"
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
            {"diverges", pass.diverged ? Json(*pass.diverged) : Json(nullptr)}};
}

template <class Item>
Json list_of(const std::vector<Item>& items) {
    Json list = Json::array();
    for (const Item& item : items) list.push_back(to_json(item));
    return list;
}

Json to_json(const Scene& scene, const std::string& name, const Ledger& ledger) {
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
            {"columns", list_of(ledger.columns)},
            {"absent", ledger.absent},
            {"ns_per_body_step", number(ledger.ns)},
            {"spread_ns", number(ledger.spread_ns)},
            {"passes", list_of(ledger.passes)},
            {"flags", ledger.flags},
            {"diverges", ledger.diverged ? Json(*ledger.diverged) : Json(nullptr)}};
}

Ledger measure(const Scene& scene, std::int64_t steps, bool quiet) {
    Percent percent(quiet, "measured");
    return ledger(scene, steps, [&](double fraction) { percent(fraction); });
}

}  // namespace

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
