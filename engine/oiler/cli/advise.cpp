// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/advise.hpp"

#include "oiler/cli/measuring.hpp"
#include "oiler/cli/output.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/process/parse_size.hpp"
#include "oiler/scene/draw.hpp"
#include "oiler/scene/read.hpp"

namespace oiler::cli {

using namespace lab;

namespace {

constexpr double frames_per_second = 60;
constexpr const char* default_size = "1280x720";

/// The frames per second of `--display`, 0 for any time. Throws Error{usage}.
std::int64_t frames_of(const std::string& words) {
    if (words == "any") return 0;
    const int frames = parse_integer(words);
    if (frames < 1 || frames > 1000)
        fail(Exit::usage, "--display: expected any or frames per second from 1 to 1000, got {}",
             words);
    return frames;
}

}  // namespace

struct AdviseCommand {
    static constexpr CommandTexts texts{
        .name = "advise",
        .summary =
            "Find the cheapest method, rate and precision within a tolerance; exit 1 if none",
        .example = "assets/scenes/orbit.toml --position-error 1e-3"};

    SceneOptions scene_options;
    ToleranceOptions tolerances;
    std::optional<double> longer;  ///< s; none: the scene's duration
    std::optional<double> pixels;  ///< tolerance, in pixels of a picture of `size`
    std::string size_words = default_size;
    bool at_steps = false;
    std::string display = "any";
    std::optional<double> budget_us;  ///< per frame of 1/60 s
    std::int64_t min_rate = 30;       ///< Hz
    std::string methods = "all";
    bool writes_scene = false;

    void declare(Arguments& arguments) {
        scene_options.declare(arguments);
        arguments.add_positive("--for", longer, "S",
                               "simulated seconds for which the setting must hold");
        tolerances.declare(arguments);
        arguments.add_positive("--pixels", pixels, "N",
                               "tolerance: the position error in pixels of a picture of --size");
        arguments.add_option("--size", size_words, "WxH", "size of that picture");
        arguments.add_flag("--at-steps", at_steps,
                           "the tolerance is that at the steps, not that of the drawn lines");
        arguments.add_option("--display", display, "60|144|any",
                             "compare drawn lines at the times of frames, or at any time");
        arguments.add_positive("--budget-us", budget_us, "US",
                               "largest computing time in µs for a frame of 1/60 s; alone: the "
                               "most accurate within it");
        arguments.add_integer("--min-rate", min_rate, 1, 1'000'000,
                              "lowest rate in Hz, 30 if not given");
        add_method_list(arguments, methods);
        arguments.add_flag("--apply", writes_scene,
                           "write the setting into the scene file and keep its comments");
    }

    /// Throws Error{usage} without a tolerance and a budget.
    [[nodiscard]] Requirements requirements(const Scene& scene) const {
        Requirements requirements{.position_error = tolerances.position_error,
                                  .energy_drift = tolerances.energy_drift,
                                  .at_steps = at_steps,
                                  .display = frames_of(display)};
        if (pixels && requirements.position_error)
            fail(Exit::usage, "give one of --position-error and --pixels");
        if (pixels) requirements.position_error = *pixels * metres_per_pixel(scene);
        if (budget_us) requirements.ns_per_second = *budget_us * (1e3 * frames_per_second);
        if (!requirements.has_tolerance() && !requirements.ns_per_second)
            fail(Exit::usage,
                 "give a tolerance or a budget: --position-error, --pixels, --energy-drift or "
                 "--budget-us "
                 "(see oiler advise --help)");
        refuse_without_effect(requirements);
        requirements.min_rate = min_rate;
        requirements.negligible_ns_per_second = 0.01 * 1e9;  // 1 % of the time
        requirements.methods = parse_methods(methods);
        return requirements;
    }

    /// Refuses options that only modify another option, if that one is missing.
    void refuse_without_effect(const Requirements& requirements) const {
        constexpr const char* line = "{} has no effect {} (see oiler advise --help)";
        const bool is_sized = size_words != default_size;
        const bool is_displayed = requirements.display > 0;
        if (is_sized && !pixels) fail(Exit::usage, line, "--size", "without --pixels");
        for (const auto& [given, option] :
             {std::pair(at_steps, "--at-steps"), std::pair(is_displayed, "--display")})
            if (given && !requirements.position_error && !budget_us)
                fail(Exit::usage, line, option,
                     "without --position-error, --pixels or --budget-us");
        if (at_steps && is_displayed) fail(Exit::usage, line, "--display", "with --at-steps");
    }

    [[nodiscard]] Scene read_scene() const {
        Scene scene = scene_options.read();
        if (longer && scene_options.duration) fail(Exit::usage, "give one of --for and --duration");
        scene.duration = longer.value_or(scene.duration);
        return scene;
    }

    /// The size of a pixel of the scene's picture, m.
    [[nodiscard]] double metres_per_pixel(const Scene& scene) const {
        const World world = make_world(scene, Settings{scene.stepping});
        const double height = camera_of(scene, world).height;
        return height / parse_size(size_words).height;
    }

    void show(const Advice& advice, const Scene& scene, const Reference& reference,
              const Requirements& requirements) const {
        if (!scene_options.json.empty())
            write_json(scene_options.json, to_json(advice, scene, reference, requirements));
        if (scene_options.json == "-") return;
        std::string text;
        for (const std::string& sentence : describe(advice, scene, reference, requirements))
            text += sentence + "\n";
        print(text);
    }

    void apply_to_scene(const Stepping& stepping) const {
        const std::string file = scene_options.file.string();
        File applied(file);
        applied.write(apply(read_text(file), file, stepping));
        applied.commit();
        remark(scene_options.quiet, "{} now has the setting {}", file, describe(stepping));
    }

    [[nodiscard]] Exit run() const {
        const Scene scene = read_scene();
        if (writes_scene) require_writable(scene_options.file);
        const Requirements requirements = this->requirements(scene);
        const Reference reference = measure_reference(
            scene, required_reference_error(requirements) / 2, scene_options.quiet);
        if (Interrupt::requested()) return Exit::interrupted;
        const Advice advice = find_advice(scene, reference, requirements, scene_options.quiet);
        if (Interrupt::requested()) return Exit::interrupted;
        show(advice, scene, reference, requirements);
        if (!advice.meets) return Exit::comparison_failed;
        if (writes_scene) apply_to_scene(advice.best->stepping);
        return Exit::done;
    }
};

template Command make_command<AdviseCommand>();

}  // namespace oiler::cli
