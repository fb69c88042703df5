// SPDX-License-Identifier: MIT
#include "oiler/lab/rates/rates.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numeric>
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
        return text +
               fmt::format(
                   "In {:g} s, the body shows no apex, bounce, oscillation or settling: give a "
                   "longer --duration or another --body.\n",
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

    [[nodiscard]] std::vector<const Method*> chosen_methods(const Scene& scene) const {
        return methods.empty() ? usual_methods(scene) : parse_methods(methods);
    }

    /// The steps of each method, at all rates together.
    [[nodiscard]] static double steps_of(const Scene& scene,
                                         const std::vector<std::int64_t>& wanted) {
        return scene.duration *
               static_cast<double>(std::accumulate(wanted.begin(), wanted.end(), std::int64_t{0}));
    }

    void announce_steps(const Scene& scene, const std::vector<std::int64_t>& wanted) const {
        const RunWork work(scene);
        double steps = 0;
        double seconds = 0;
        for (const Method* method : chosen_methods(scene)) {
            steps += steps_of(scene, wanted);
            seconds += steps_of(scene, wanted) * work.seconds_per_step(*method);
        }
        announce(scene_options.quiet, scene_options.file.string(), steps, seconds);
    }

    /// Returns the values so far when interrupted.
    [[nodiscard]] Rates measure(const Scene& scene, const Reference& reference,
                                const std::vector<std::int64_t>& wanted) const {
        const std::vector<const Method*> chosen = chosen_methods(scene);
        const std::size_t row =
            body.empty() ? most_oscillating_row(reference) : find_body(scene, body);
        Percent percent(scene_options.quiet, "of the runs");
        const double all = steps_of(scene, wanted) * static_cast<double>(chosen.size());
        double done = 0;
        return measure_rates(scene, reference, row, wanted, chosen, [&] {
            percent(++done / all);
            return Interrupt::requested();
        });
    }

    void show(const Scene& scene, const Rates& measured) const {
        if (!scene_options.json.empty()) {
            Json json = to_json(measured);
            json["scene"] = scene_options.name();
            if (Interrupt::requested()) json["complete"] = false;
            write_json(scene_options.json, json);
        }
        if (scene_options.json != "-") print(text_of(scene, scene_options.name(), measured));
    }

    [[nodiscard]] Exit run() const {
        const std::vector<std::int64_t> wanted = parse_rates(rates);
        const Scene scene = scene_options.read();
        announce_steps(scene, wanted);
        const Reference reference = measure_reference(scene, 0, scene_options.quiet);
        if (Interrupt::requested()) return Exit::interrupted;
        if (!reference.why_no_longer.empty())
            remark(scene_options.quiet, "measures only the first {:.4g} s of {:.4g} s: {}",
                   reference.meaningful_until, scene.duration, reference.why_no_longer);
        const Rates measured = measure(scene, reference, wanted);
        if (Interrupt::requested() && !Interrupt::by_time_limit()) return Exit::interrupted;
        show(scene, measured);
        return Exit::done;
    }
};

template Command make_command<RatesCommand>();

}  // namespace oiler::cli
