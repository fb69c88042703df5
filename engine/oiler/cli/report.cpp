// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "oiler/app/interrupt.hpp"
#include "oiler/app/stills.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/cli/measuring.hpp"
#include "oiler/cli/parts_json.hpp"
#include "oiler/cli/tables.hpp"
#include "oiler/lab/ledger.hpp"
#include "oiler/lab/tradeoff_picture.hpp"
#include "oiler/scene/draw.hpp"
#include "oiler/sim/oscillations.hpp"

extern "C" {
extern const char oiler_page[], oiler_page_end[];
extern const char oiler_chart[], oiler_chart_end[];
}

namespace oiler {
namespace {

using Json = nlohmann::ordered_json;

/// A page is for a first look: how far a sweep goes for it.
constexpr std::int64_t highest_multiple = 128;  ///< of how often is looked
constexpr double most_work = 5e7;
constexpr Size frame_size{960, 540};
constexpr double usual_tolerance = 1e-3;  ///< of what bodies move

std::string base64(const std::vector<std::byte>& bytes) {
    constexpr std::string_view letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 |
                    (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? letters[three >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if (c == '&')
            safe += "&amp;";
        else if (c == '<')
            safe += "&lt;";
        else
            safe += c;
    }
    return safe;
}

/// No script's end can hide in a text.
std::string for_script(const Json& json) {
    std::string safe;
    for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace)) {
        if (c == '<')
            safe += "\\u003c";
        else
            safe += c;
    }
    return safe;
}

/// The template with each @NAME@ replaced, in one pass: what is put in is not looked at again.
std::string fill(std::string_view page, const std::map<std::string, std::string>& parts) {
    std::string text;
    while (!page.empty()) {
        std::size_t at = page.npos;
        const std::pair<const std::string, std::string>* found = nullptr;
        for (const auto& part : parts)
            if (const std::size_t here = page.find(part.first); here < at) {
                at = here;
                found = &part;
            }
        text += page.substr(0, at);
        if (!found) break;
        text += found->second;
        page.remove_prefix(at + found->first.size());
    }
    return text;
}

Json choice_json(const SceneChoice& choice) {
    return {{"method", choice.method->name},
            {"rate", choice.rate},
            {"precision", name_of(choice.precision)}};
}

Json row_json(const TradeoffRow& row, bool best) {
    Json json = choice_json(row.choice);
    const Judgement& judgement = row.judgement;
    json["order"] =
        row.choice.method->order == exact_order ? Json("exact") : Json(row.choice.method->order);
    json["position_error"] = number(judgement.position_error);
    json["velocity_error"] = number(judgement.velocity_error);
    json["phase_error"] = number(judgement.phase_error);
    json["energy_drift"] = number(judgement.energy_drift);
    json["evaluations"] = number(judgement.evaluations);
    json["ns_per_second"] = number(row.ns_per_second);
    json["ns_spread"] = number(row.ns_spread);
    json["stable"] = judgement.stable;
    json["aligned"] = row.meets_steps;
    json["below_floor"] = judgement.below_floor();
    json["pareto"] = best;
    return json;
}

Json tradeoff_json(const Tradeoff& tradeoff) {
    const Machine machine = this_machine();
    Json json{{"machine",
               {{"cpu", machine.cpu}, {"cores", machine.cores}, {"compiler", machine.compiler}}},
              {"duration", tradeoff.duration},
              {"looks_per_second", tradeoff.looks.per_second},
              {"reference",
               {{"kind", tradeoff.reference.closed_form ? "closed form" : "fine steps"},
                {"words", tradeoff.reference.words},
                {"position_error", tradeoff.reference.position_error},
                {"position_floor", tradeoff.reference.floor.position},
                {"velocity_error", tradeoff.reference.velocity_error},
                {"meaningful_until", tradeoff.reference.meaningful_until}}},
              {"rows", Json::array()}};
    const auto front = pareto(tradeoff, time_of);
    for (const TradeoffRow* row : tradeoff.rows())
        json["rows"].push_back(
            row_json(*row, std::find(front.begin(), front.end(), row) != front.end()));
    return json;
}

Json advice_part(const Advice& advice, const Scene& scene, const Reference& reference,
                 const Wish& wish) {
    Json rows = Json::array();
    const auto add = [&](const char* role, const std::optional<TradeoffRow>& row,
                         const std::string& why) {
        if (!row) return;
        Json json = row_json(*row, false);
        json["role"] = role;
        json["why"] = why;
        rows.push_back(std::move(json));
    };
    add("advice", advice.best,
        advice.meets ? "the cheapest that keeps within the tolerance" : "comes nearest");
    add("runner-up", advice.runner_up, "the cheapest of another method");
    add("today", advice.today, "what the scene file says");
    for (const Alternative& alternative : advice.alternatives)
        add("alternative", alternative.row, alternative.why);
    const auto optional = [](const std::optional<double>& value) {
        return value ? Json(*value) : Json(nullptr);
    };
    return {{"words", words_of(advice, scene, reference, wish)},
            {"rows", std::move(rows)},
            {"tolerance",
             {{"position_error", optional(wish.position_error)},
              {"energy_drift", optional(wish.energy_drift)}}}};
}

/// What swings, alike ones together; the fastest first and not too many.
Json springs_json(const Scene& scene, const Bodies& bodies) {
    constexpr std::size_t most = 12;
    std::map<std::pair<double, double>, std::pair<std::string, int>> kinds;
    for (const BodyOscillation& one : oscillations(bodies, true)) {
        if (!(one.of.k > 0)) continue;
        const double omega = std::sqrt(one.of.k);
        auto& [name, count] = kinds[{-omega, one.of.c / (2 * omega)}];
        if (count++ > 0) continue;
        const auto body = [&](std::size_t row) {
            return row < scene.bodies.size() && !scene.bodies[row].name.empty()
                       ? scene.bodies[row].name
                       : fmt::format("body {}", row);
        };
        name = one.linked ? fmt::format("{} to {}, at most", body(one.row), body(*one.linked))
                          : fmt::format("springs of {}", body(one.row));
    }
    Json list = Json::array();
    for (const auto& [shape, kind] : kinds)
        if (list.size() < most)
            list.push_back({{"name", kind.first},
                            {"omega", -shape.first},
                            {"zeta", shape.second},
                            {"count", kind.second}});
    return list;
}

Json stability_json(const Scene& scene, const std::vector<const Method*>& methods) {
    constexpr int points = 11;
    constexpr double widest = 1.5;
    const Bodies bodies = make_world(scene, settings_of(scene)).bodies();
    Json springs = springs_json(scene, bodies);
    if (springs.empty()) return nullptr;
    Json curves = Json::array();
    for (const Method* method : methods) {
        Json curve = Json::array();
        for (int i = 0; i < points; ++i) {
            const double zeta = widest * i / (points - 1);
            const double limit = method->order == exact_order
                                     ? INFINITY
                                     : stability_limit(*method, method->damping, {1, 2 * zeta});
            curve.push_back({zeta, std::isinf(limit) ? Json(nullptr) : Json(limit)});
        }
        curves.push_back({{"method", method->name}, {"points", std::move(curve)}});
    }
    return {{"methods", std::move(curves)}, {"springs", std::move(springs)}, {"rate", scene.rate}};
}

Json ledger_json(const Scene& scene) {
    const auto steps = static_cast<std::int64_t>(scene.duration * static_cast<double>(scene.rate));
    const Ledger found = ledger(scene, std::max<std::int64_t>(2, steps));
    Json passes = Json::array();
    for (const LedgerPass& pass : found.passes)
        passes.push_back({{"name", pass.name},
                          {"saves_ns", number(pass.saves_ns)},
                          {"saves_percent", number(pass.saves_percent)},
                          {"changes_position_m", number(pass.changes_position)}});
    return {{"ns_per_body_step", number(found.ns)},
            {"bytes_per_body", found.bytes_per_body()},
            {"passes", std::move(passes)},
            {"absent", found.absent},
            {"flags", found.flags}};
}

std::string frame_of(const Scene& scene) {
    Stills stills(frame_size);
    const World world = make_world(scene, settings_of(scene));
    return "data:image/png;base64," +
           base64(stills.png(draw_scene(scene, world, camera_of(scene, world))));
}

Wish wish_of(const ReportCommand& command, const Scene& scene, const Reference& reference) {
    Wish wish{.position_error = command.position_error, .energy_drift = command.energy_drift};
    if (!wish.has_tolerance()) {
        wish.position_error = scene.budget.position_error;
        wish.energy_drift = scene.budget.energy_drift;
    }
    if (!wish.has_tolerance())
        wish.position_error =
            std::pow(10, std::floor(std::log10(usual_tolerance * reference.extent)));
    wish.methods = parse_methods("all");
    return wish;
}

}  // namespace

Exit ReportCommand::run() const {
    const Interrupt interrupt;
    Scene scene = read_measured(measured);
    Looks looks = looks_of(scene);
    Reference reference = measure_reference(scene, looks, 0, measured.quiet);
    if (Interrupt::requested()) return Exit::interrupted;
    if (!reference.why_no_longer.empty()) {
        remark(measured.quiet, "the page is about the first {:.4g} s: {}",
               reference.meaningful_until(), reference.why_no_longer);
        scene.duration = reference.meaningful_until();
        looks = looks_of(scene);
        reference = measure_reference(scene, looks, 0, measured.quiet);
    }
    const Wish wish = wish_of(*this, scene, reference);
    require_judgeable(scene, reference, wish);
    File page(out);
    SweepPlan plan{.methods = parse_methods("all"),
                   .max_rate = std::min<std::int64_t>(
                       1'000'000, std::max(scene.rate, highest_multiple * looks.per_second)),
                   .most_work = most_work};
    Tradeoff tradeoff = start_tradeoff(scene, looks, reference, plan);
    tradeoff.scene = name_of(measured);
    measure_tradeoff(tradeoff, scene, reference, plan, measured.quiet);
    SweepWatch watch;
    watch.stopped = Interrupt::requested;
    const Advice advice = advise(scene, reference, wish, watch);
    const Rates rates =
        measure_rates(scene, reference, reference.swing ? reference.swing->row : 0,
                      RatesCommand{}.rates, usual_methods(scene), Interrupt::requested);
    if (Interrupt::requested()) return Exit::interrupted;
    const Json data{{"scene", tradeoff.scene},
                    {"title", scene.title},
                    {"today", choice_json(tradeoff.today)},
                    {"tradeoff", tradeoff_json(tradeoff)},
                    {"advice", advice_part(advice, scene, reference, wish)},
                    {"stability", stability_json(scene, notable_methods(tradeoff))},
                    {"rates", rates.quantities.empty() ? Json(nullptr) : rates_json(rates)},
                    {"ledger", ledger_json(scene)}};
    page.write(fill({oiler_page, oiler_page_end},
                    {{"@CHART_LIBRARY@", {oiler_chart, oiler_chart_end}},
                     {"@FRAME@", frame_of(scene)},
                     {"@TITLE@", escaped(scene.title.empty() ? tradeoff.scene : scene.title)},
                     {"@DATA@", for_script(data)}}));
    page.commit();
    if (!measured.json.empty()) write_json(measured.json, data);
    remark(measured.quiet, "{} is written; open it in a browser", out.string());
    return Exit::done;
}

}  // namespace oiler
