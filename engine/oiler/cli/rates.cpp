// SPDX-License-Identifier: MIT
#include "oiler/lab/rates.hpp"

#include <fmt/core.h>

#include <cmath>

#include "oiler/app/interrupt.hpp"
#include "oiler/cli/measuring.hpp"
#include "oiler/cli/tables.hpp"
#include "oiler/lab/rates_json.hpp"

namespace oiler::cli {
namespace {

std::string cell(double value) { return std::isnan(value) ? "-" : fmt::format("{:.5g}", value); }

std::string text_of(const Scene& scene, const std::string& name, const Rates& rates) {
    std::string text = fmt::format("{}: {} in {}\n", scene.title.empty() ? name : scene.title,
                                   rates.body, name_of(scene.stepping.precision));
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

}  // namespace

Exit RatesCommand::run() const {
    const Interrupt interrupt;
    const Scene scene = read_measured(measured);
    const Reference reference = measure_reference(scene, sample_times_of(scene), 0, measured.quiet);
    if (Interrupt::requested()) return Exit::interrupted;
    if (!reference.why_no_longer.empty())
        remark(measured.quiet, "of {:.4g} s only the first {:.4g} are measured: {}", scene.duration,
               reference.meaningful_until(), reference.why_no_longer);
    const std::vector<const Method*> chosen =
        methods.empty() ? usual_methods(scene) : parse_methods(methods);
    const std::size_t row = body.empty() ? most_oscillating_row(reference) : find_body(scene, body);
    const Rates measured_rates =
        measure_rates(scene, reference, row, rates, chosen, Interrupt::requested);
    if (Interrupt::requested()) return Exit::interrupted;
    if (!measured.json.empty()) {
        Json json = json_of(measured_rates);
        json["scene"] = name_of(measured);
        write_json(measured.json, json);
    }
    if (measured.json != "-") print(text_of(scene, name_of(measured), measured_rates));
    return Exit::done;
}

}  // namespace oiler::cli
