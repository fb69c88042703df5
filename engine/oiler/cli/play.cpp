// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>

#include "oiler/app/run_game.hpp"
#include "oiler/cli/arguments.hpp"
#include "oiler/cli/output.hpp"
#include "oiler/cli/scene_game.hpp"
#include "oiler/lab/rates/budget.hpp"
#include "oiler/process/console.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/scene/read.hpp"

namespace oiler::cli {
namespace {

About describe(const Scene& scene, const std::string& name, const std::string& text) {
    return {.name = name,
            .title = scene.title.empty() ? name : scene.title,
            .rate = static_cast<int>(scene.stepping.rate.steps),
            .method = scene.stepping.method->name,
            .precision = scene.stepping.precision,
            .duration = scene.duration,
            .damping = damping_name(scene.stepping),
            .scene_text = text,
            .controls = SceneGame::controls};
}

/// Whether the run is only shown in a window: no file of it depends on its steps.
bool is_watched(const Options& options) {
    return !options.headless && !options.steps && fixing_option(options).empty();
}

struct SceneFile {
    std::string name;
    std::string text;
};

/// The scene of the file, or the one that the manifest holds.
SceneFile find_scene(const std::string& path, const std::optional<Manifest>& from) {
    if (!path.empty()) return {path, read_scene_text(path)};
    if (!from)
        fail(Exit::usage, "give a scene file, or --from manifest.json (see oiler play --help)");
    if (from->scene_text.empty())
        fail(Exit::usage, "--from: the manifest is of the game {}, not of a scene; run {} --from",
             from->scene, from->scene);
    return {from->scene, from->scene_text};
}

/// Measures over `seconds`, at most over the scene's duration. A drift is relative to the energies
/// of the motion, which a much shorter run does not show.
std::vector<BudgetEntry> check(Scene scene, const Options& options, double seconds) {
    constexpr double least_share = 0.9;
    const Settings& settings = options.settings;
    if (seconds <= 0) return {};
    if (scene.budget.energy_drift && seconds < least_share * scene.duration) {
        remark(options.quiet, "[budget] energy_drift is compared over {:g} s, not over {:g} s",
               scene.duration, seconds);
        scene.budget.energy_drift.reset();
    }
    scene.duration = std::min(scene.duration, seconds);
    std::vector<BudgetEntry> entries = lab::check_budget(scene, settings, Interrupt::requested);
    for (BudgetEntry& entry : entries)
        entry.words = fmt::format("over {:g} s: {}", scene.duration, entry.words);
    return entries;
}

}  // namespace

/// Takes the options of all games, which app parses.
struct PlayCommand {
    static constexpr CommandTexts texts{
        .name = "play",
        .summary = "Play a scene file in a window, as frames or as numbers",
        .example = "assets/scenes/cloth.toml"};

    /// What the run holds to its end.
    struct Shown {
        std::shared_ptr<SceneShelf> shelf;
        std::string name;
        std::string text;
        std::string title;
    };

    static Exit parse_and_run(int argc, char** argv) {
        constexpr About program{.name = "oiler play", .title = "Play a scene file"};
        const auto shown = std::make_shared<Shown>();
        const auto read = [&](const std::string& path, const std::optional<Manifest>& from) {
            const SceneFile file = find_scene(path, from);
            shown->text = file.text;
            shown->shelf = std::make_shared<SceneShelf>(path, parse_scene(file.text, file.name));
            shown->name = std::filesystem::path(file.name).stem().string();
            return describe(*shown->shelf->scene(), shown->name, shown->text);
        };
        CommandLine line = parse_command_line(argc, argv, program, read);
        if (!line.text.empty()) {
            print(line.text);
            return Exit::done;
        }
        const bool watched = is_watched(line.options);
        shown->title = shown->shelf->title();
        line.about.title = shown->title;
        using Watched = SceneGame::Watched;
        const Watched by = !watched                         ? Watched::no
                           : shown->shelf->has_neighbours() ? Watched::among_others
                                                            : Watched::alone;
        const auto make = [shown, by](const Settings& settings) {
            return std::make_unique<SceneGame>(shown->shelf->scene(), settings, by);
        };
        const auto measure_budget = [shown, options = line.options](double seconds) {
            return check(*shown->shelf->scene(), options, seconds);
        };
        return run_game(line.options, line.about, make, measure_budget,
                        watched ? shown->shelf : nullptr);
    }
};

template Command make_command<PlayCommand>();

}  // namespace oiler::cli
