// SPDX-License-Identifier: MIT
#include "oiler/lab/rates.hpp"

#include <fmt/format.h>

#include <cmath>

#include "oiler/app/interrupt.hpp"
#include "oiler/cli/measuring.hpp"
#include "oiler/cli/parts_json.hpp"
#include "oiler/cli/tables.hpp"

namespace oiler {
namespace {

using Json = nlohmann::ordered_json;

std::string cell(double value) { return std::isnan(value) ? "-" : fmt::format("{:.5g}", value); }

std::string text_of(const Scene& scene, const std::string& name, const Rates& rates) {
    std::string text = fmt::format("{}: {} in {}\n", scene.title.empty() ? name : scene.title,
                                   rates.body, name_of(scene.precision));
    if (rates.quantities.empty())
        text += "It neither jumps nor swings: there is nothing to notice.\n";
    for (const RatesQuantity& quantity : rates.quantities) {
        text += fmt::format("\n{}, {}: {:.6g}\n  {:<30}", quantity.name, quantity.unit,
                            quantity.truth, "Hz");
        for (const std::int64_t rate : rates.rates) text += fmt::format(" {:>8}", rate);
        text += "  spread\n";
        for (const RatesLine& line : quantity.lines) {
            text += fmt::format("  {:<30}", line.method->name);
            for (const double value : line.values) text += fmt::format(" {:>8}", cell(value));
            text += std::isnan(line.spread_percent)
                        ? "       -\n"
                        : fmt::format(" {:>6.2g}%\n", line.spread_percent);
        }
    }
    return text +
           "\nBeside the name is the exact value; spread: from the least to the largest, of it. - "
           "is not there,\nor unstable. As drawn: straight lines between steps.\n";
}

Json list_of(const std::vector<double>& values) {
    Json list = Json::array();
    for (const double value : values) list.push_back(number(value));
    return list;
}

}  // namespace

nlohmann::ordered_json rates_json(const Rates& rates) {
    Json quantities = Json::array();
    for (const RatesQuantity& quantity : rates.quantities) {
        Json lines = Json::array();
        for (const RatesLine& line : quantity.lines)
            lines.push_back({{"method", line.method->name},
                             {"values", list_of(line.values)},
                             {"spread_percent", number(line.spread_percent)}});
        quantities.push_back({{"name", quantity.name},
                              {"unit", quantity.unit},
                              {"body", rates.body},
                              {"truth", number(quantity.truth)},
                              {"methods", std::move(lines)}});
    }
    return {{"rates", rates.rates}, {"quantities", std::move(quantities)}};
}

std::vector<const Method*> usual_methods(const Scene& scene) {
    std::vector<const Method*> usual{scene.method};
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk4", "exact"}) {
        const Method& method = find_method(name);
        if (&method != scene.method &&
            why_not(scene, settings_of({&method, scene.rate, scene.precision})).empty())
            usual.push_back(&method);
    }
    return usual;
}

Exit RatesCommand::run() const {
    const Interrupt interrupt;
    const Scene scene = read_measured(measured);
    const Reference reference = measure_reference(scene, looks_of(scene), 0, measured.quiet);
    if (Interrupt::requested()) return Exit::interrupted;
    if (!reference.why_no_longer.empty())
        remark(measured.quiet, "of {:.4g} s only the first {:.4g} are measured: {}", scene.duration,
               reference.meaningful_until(), reference.why_no_longer);
    const std::vector<const Method*> chosen =
        methods.empty() ? usual_methods(scene) : parse_methods(methods);
    const std::size_t row =
        body.empty() ? reference.swing ? reference.swing->row : 0 : find_body(scene, body);
    const Rates measured_rates =
        measure_rates(scene, reference, row, rates, chosen, Interrupt::requested);
    if (Interrupt::requested()) return Exit::interrupted;
    if (!measured.json.empty()) {
        Json json = rates_json(measured_rates);
        json["scene"] = name_of(measured);
        write_json(measured.json, json);
    }
    if (measured.json != "-") print(text_of(scene, name_of(measured), measured_rates));
    return Exit::done;
}

}  // namespace oiler
