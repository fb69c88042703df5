// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/advise.hpp"

#include "oiler/app/interrupt.hpp"
#include "oiler/cli/files.hpp"
#include "oiler/cli/measuring.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/lab/advice/json.hpp"
#include "oiler/scene/apply.hpp"

namespace oiler::cli {

using namespace lab;

namespace {

constexpr double frames_per_second = 60;

Advice search(const Scene& scene, const Reference& reference, const Requirements& requirements,
              bool quiet) {
    Percent percent(quiet, "of the settings, most of which need no run");
    SweepWatch watch;
    watch.progress = [&](double fraction) { percent(fraction); };
    watch.stopped = Interrupt::requested;
    return advise(scene, reference, requirements, watch);
}

}  // namespace

struct AdviseCommand {
    static constexpr CommandTexts texts{
        .name = "advise",
        .summary = "Find the cheapest method, rate and precision within a tolerance",
        .example = "assets/scenes/orbit.toml --position-error 1e-3",
        .notes =
            "Exits with 1 when no setting meets the tolerance. --budget-us alone finds the most\n"
            "accurate setting within the budget."};

    SceneOptions scene_options;
    ToleranceOptions tolerances;
    std::optional<double> budget_us;  ///< per frame of 1/60 s
    std::int64_t min_rate = 1;        ///< Hz
    std::string methods = "all";
    bool writes_scene = false;

    void declare(Arguments& arguments) {
        scene_options.declare(arguments);
        tolerances.declare(arguments);
        arguments.add_positive("--budget-us", budget_us, "US",
                               "largest computing time in µs for a frame of 1/60 s");
        arguments.add_integer("--min-rate", min_rate, 1, 1'000'000,
                              "lowest rate in Hz, 1 if not given");
        add_method_list(arguments, methods);
        arguments.add_flag("--apply", writes_scene,
                           "write the setting into the scene file and keep its comments");
    }

    /// Throws Error{usage} without a tolerance and a budget.
    [[nodiscard]] Requirements requirements() const {
        Requirements requirements{.position_error = tolerances.position_error,
                                  .energy_drift = tolerances.energy_drift};
        if (budget_us) requirements.ns_per_second = *budget_us * (1e3 * frames_per_second);
        if (!requirements.has_tolerance() && !requirements.ns_per_second)
            fail(Exit::usage,
                 "give a tolerance or a budget: --position-error, --energy-drift or --budget-us "
                 "(see oiler advise --help)");
        requirements.min_rate = min_rate;
        requirements.methods = parse_methods(methods);
        return requirements;
    }

    void show(const Advice& advice, const Scene& scene, const Reference& reference,
              const Requirements& requirements) const {
        if (!scene_options.json.empty())
            write_json(scene_options.json, json_of(advice, scene, reference, requirements));
        if (scene_options.json == "-") return;
        std::string text;
        for (const std::string& sentence : describe(advice, scene, reference, requirements))
            text += sentence + "\n";
        print(text);
    }

    void apply_to_scene(const Stepping& stepping) const {
        const std::string file = scene_options.file.string();
        write_text(file, apply(read_text(file), file, stepping));
        remark(scene_options.quiet, "{} now has the setting {}", file, describe(stepping));
    }

    [[nodiscard]] Exit run() const {
        const Interrupt interrupt;
        const Scene scene = scene_options.read();
        const Requirements requirements = this->requirements();
        const Reference reference =
            measure_reference(scene, sample_times_of(scene),
                              required_reference_error(requirements) / 2, scene_options.quiet);
        if (Interrupt::requested()) return Exit::interrupted;
        const Advice advice = search(scene, reference, requirements, scene_options.quiet);
        if (Interrupt::requested()) return Exit::interrupted;
        show(advice, scene, reference, requirements);
        if (!advice.meets) return Exit::comparison_failed;
        if (writes_scene) apply_to_scene(advice.best->stepping);
        return Exit::done;
    }
};

template Command make_command<AdviseCommand>();

}  // namespace oiler::cli
