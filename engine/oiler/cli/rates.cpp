// SPDX-License-Identifier: MIT
#include "oiler/lab/rates/rates.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <sstream>

#include "oiler/cli/measuring.hpp"
#include "oiler/cli/output.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/process/interrupt.hpp"

namespace oiler::cli {

using namespace lab;

namespace {

constexpr const char* rates_legend = R"(
The exact value is beside each name. spread: from the smallest to the largest value, relative to it.
-: missing or unstable. All values are those of the drawn motion: straight lines between steps.
)";

std::string line_of(const RatesLine& line) {
    std::string text = fmt::format("  {:<30}", line.method->name);
    for (const double value : line.values) text += fmt::format(" {:>8}", cell(value, "{:.5g}"));
    const bool has_spread = !std::isnan(line.spread_percent);
    return text + (has_spread ? fmt::format(" {:>6.2g}%\n", line.spread_percent) : "       -\n");
}

std::string text_of(const Scene& scene, const std::string& name, const Rates& rates) {
    std::string text = fmt::format("{}: {} in {}\n", scene.title.empty() ? name : scene.title,
                                   rates.body, name_of(scene.stepping.precision));
    if (rates.quantities.empty())
        return text + fmt::format(
                          "In {:g} s, the body reaches no apex and completes no oscillation: give "
                          "a longer --duration or another --body.\n",
                          scene.duration);
    for (const RatesQuantity& quantity : rates.quantities) {
        text += fmt::format("\n{}, {}: {:.6g}\n  {:<30}", quantity.name, quantity.unit,
                            quantity.truth, "Hz");
        for (const std::int64_t rate : rates.rates) text += fmt::format(" {:>8}", rate);
        text += "  spread\n";
        for (const RatesLine& line : quantity.lines) text += line_of(line);
    }
    return text + rates_legend;
}

/// Parses rates in Hz with commas between them. Throws Error{usage}.
std::vector<std::int64_t> parse_rates(const std::string& words) {
    std::vector<std::int64_t> rates;
    // getline returns an empty last word only before a comma.
    std::istringstream stream(words + ",");
    for (std::string word; std::getline(stream, word, ',');) {
        const int rate = parse_integer(word);
        if (rate < 1 || rate > 1'000'000)
            fail(Exit::usage,
                 "--rates {}: give whole numbers from 1 to 1000000 with commas between them",
                 words);
        rates.push_back(rate);
    }
    return rates;
}

}  // namespace

struct RatesCommand {
    static constexpr CommandTexts texts{
        .name = "rates",
        .summary = "Measure jump heights and periods of oscillation at several rates",
        .example = "assets/scenes/jump.toml"};

    SceneOptions scene_options;
    std::string rates = fmt::format("{}", fmt::join(usual_rates(), ","));
    std::string methods;  ///< empty: the scene's own and the usual ones
    std::string body;     ///< name or index; empty: the one with the largest oscillation, or 0

    void declare(Arguments& arguments) {
        scene_options.declare(arguments);
        arguments.add_option("--rates", rates, "LIST", "rates in Hz with commas");
        add_method_list(arguments, methods);
        arguments.add_option("--body", body, "BODY", "name of the body, or its index from 0");
    }

    /// Returns no rates when interrupted.
    [[nodiscard]] Rates measure(const Scene& scene, const Reference& reference,
                                const std::vector<std::int64_t>& wanted) const {
        const std::vector<const Method*> chosen =
            methods.empty() ? usual_methods(scene) : parse_methods(methods);
        const std::size_t row =
            body.empty() ? most_oscillating_row(reference) : find_body(scene, body);
        return measure_rates(scene, reference, row, wanted, chosen, Interrupt::requested);
    }

    void show(const Scene& scene, const Rates& measured) const {
        if (!scene_options.json.empty()) {
            Json json = to_json(measured);
            json["scene"] = scene_options.name();
            write_json(scene_options.json, json);
        }
        if (scene_options.json != "-") print(text_of(scene, scene_options.name(), measured));
    }

    [[nodiscard]] Exit run() const {
        const std::vector<std::int64_t> wanted = parse_rates(rates);
        const Scene scene = scene_options.read();
        const Reference reference = measure_reference(scene, 0, scene_options.quiet);
        if (Interrupt::requested()) return Exit::interrupted;
        if (!reference.why_no_longer.empty())
            remark(scene_options.quiet, "measures only the first {:.4g} s of {:.4g} s: {}",
                   reference.meaningful_until, scene.duration, reference.why_no_longer);
        const Rates measured = measure(scene, reference, wanted);
        if (Interrupt::requested()) return Exit::interrupted;
        show(scene, measured);
        return Exit::done;
    }
};

template Command make_command<RatesCommand>();

}  // namespace oiler::cli
