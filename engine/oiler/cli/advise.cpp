// SPDX-License-Identifier: MIT
#include "oiler/lab/advise.hpp"

#include <fmt/format.h>

#include <cmath>

#include "oiler/app/interrupt.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/cli/measuring.hpp"
#include "oiler/cli/tables.hpp"

namespace oiler {
namespace {

using Json = nlohmann::ordered_json;

Json optional_number(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json to_json(const TradeoffRow& row) {
    const Judgement& judgement = row.judgement;
    return {{"method", row.choice.method->name},
            {"rate", row.choice.rate},
            {"precision", name_of(row.choice.precision)},
            {"stable", judgement.stable},
            {"position_error", number(judgement.position_error)},
            {"below_floor", judgement.below_floor()},
            {"velocity_error", number(judgement.velocity_error)},
            {"phase_error", number(judgement.phase_error)},
            {"energy_drift", number(judgement.energy_drift)},
            {"evaluations", number(judgement.evaluations)},
            {"ns_per_second", number(row.ns_per_second)},
            {"ns_spread", number(row.ns_spread)},
            {"us_per_frame", number(row.ns_per_second / 60'000)}};
}

Json to_json(const std::optional<TradeoffRow>& row) { return row ? to_json(*row) : Json(nullptr); }

Json alternatives_of(const Advice& advice) {
    Json list = Json::array();
    for (const Alternative& alternative : advice.alternatives) {
        Json one = alternative.row ? to_json(*alternative.row)
                                   : Json{{"method", alternative.method->name}};
        one["why"] = alternative.why;
        list.push_back(std::move(one));
    }
    return list;
}

Json advice_json(const Advice& advice, const Scene& scene, const Reference& reference,
                 const Wish& wish) {
    const Doubt floor = reference.floor();
    return {{"meets", advice.meets},
            {"advice", to_json(advice.best)},
            {"runner_up", to_json(advice.runner_up)},
            {"today", to_json(advice.today)},
            {"alternatives", alternatives_of(advice)},
            {"obstacles", advice.obstacles},
            {"wish",
             {{"position_error", optional_number(wish.position_error)},
              {"energy_drift", optional_number(wish.energy_drift)},
              {"us_per_frame", wish.ns_per_second ? Json(*wish.ns_per_second / 60'000) : Json()}}},
            {"reference",
             {{"words", reference.words},
              {"closed_form", reference.closed_form},
              {"position_floor", floor.position},
              {"energy_floor", floor.energy},
              {"meaningful_until", reference.meaningful_until()}}},
            {"runs", advice.runs},
            {"words", words_of(advice, scene, reference, wish)}};
}

}  // namespace

Exit AdviseCommand::run() const {
    const Interrupt interrupt;
    const Scene scene = read_measured(measured);
    Wish wish{.position_error = position_error, .energy_drift = energy_drift};
    if (budget_us) wish.ns_per_second = *budget_us * 60'000;
    if (!wish.has_tolerance() && !wish.ns_per_second)
        fail(Exit::usage,
             "say what is good enough: --position-error, --energy-drift or --budget-us (see oiler "
             "advise --help)");
    wish.min_rate = min_rate;
    wish.methods = parse_methods(methods);
    const Looks looks = looks_of(scene);
    const Reference reference =
        measure_reference(scene, looks, wanted_of(wish) / 2, measured.quiet);
    if (Interrupt::requested()) return Exit::interrupted;
    SweepWatch watch;
    watch.stopped = Interrupt::requested;
    const Advice advice = advise(scene, reference, wish, watch);
    if (Interrupt::requested()) return Exit::interrupted;
    if (!measured.json.empty())
        write_json(measured.json, advice_json(advice, scene, reference, wish));
    if (measured.json != "-") {
        std::string text;
        for (const std::string& sentence : words_of(advice, scene, reference, wish))
            text += sentence + "\n";
        print(text);
    }
    if (!advice.meets) return Exit::comparison_failed;
    if (apply_it) {
        const std::string text =
            apply(read_text(measured.scene), measured.scene.string(), advice.best->choice);
        write_file(measured.scene, std::as_bytes(std::span(text)));
        remark(measured.quiet, "{} now says {}", measured.scene.string(),
               words_of(advice.best->choice));
    }
    return Exit::done;
}

}  // namespace oiler
