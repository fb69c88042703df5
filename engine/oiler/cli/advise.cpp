// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/advise.hpp"

#include <span>

#include "oiler/app/interrupt.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/cli/measuring.hpp"
#include "oiler/cli/tables.hpp"
#include "oiler/lab/advice/json.hpp"
#include "oiler/scene/apply.hpp"

namespace oiler::cli {
namespace {

Advice search(const Scene& scene, const Reference& reference, const Requirements& requirements,
              bool quiet) {
    Percent percent(quiet, "of the ways to step it, of which most need no run");
    SweepWatch watch;
    watch.progress = [&](double share) { percent(share); };
    watch.stopped = Interrupt::requested;
    return advise(scene, reference, requirements, watch);
}

}  // namespace

Exit AdviseCommand::run() const {
    const Interrupt interrupt;
    const Scene scene = read_measured(measured);
    Requirements requirements{.position_error = position_error, .energy_drift = energy_drift};
    if (budget_us) requirements.ns_per_second = *budget_us * 60'000;
    if (!requirements.has_tolerance() && !requirements.ns_per_second)
        fail(Exit::usage,
             "say what is good enough: --position-error, --energy-drift or --budget-us (see oiler "
             "advise --help)");
    requirements.min_rate = min_rate;
    requirements.methods = parse_methods(methods);
    const SampleTimes samples = sample_times_of(scene);
    const Reference reference = measure_reference(
        scene, samples, required_reference_error(requirements) / 2, measured.quiet);
    if (Interrupt::requested()) return Exit::interrupted;
    const Advice advice = search(scene, reference, requirements, measured.quiet);
    if (Interrupt::requested()) return Exit::interrupted;
    if (!measured.json.empty())
        write_json(measured.json, json_of(advice, scene, reference, requirements));
    if (measured.json != "-") {
        std::string text;
        for (const std::string& sentence : describe(advice, scene, reference, requirements))
            text += sentence + "\n";
        print(text);
    }
    if (!advice.meets) return Exit::comparison_failed;
    if (apply_it) {
        const std::string text =
            apply(read_text(measured.scene), measured.scene.string(), advice.best->stepping);
        write_file(measured.scene, std::as_bytes(std::span(text)));
        remark(measured.quiet, "{} now says {}", measured.scene.string(),
               describe(advice.best->stepping));
    }
    return Exit::done;
}

}  // namespace oiler::cli
