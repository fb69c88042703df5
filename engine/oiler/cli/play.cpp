// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>

#include "oiler/app/console.hpp"
#include "oiler/app/interrupt.hpp"
#include "oiler/app/loops.hpp"
#include "oiler/cli/arguments.hpp"
#include "oiler/cli/files.hpp"
#include "oiler/lab/budget.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/scene/draw.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/scene/read.hpp"
#include "oiler/scene/scene_text.hpp"

namespace oiler::cli {
namespace {

class SceneGame final : public AnyGame {
public:
    /// The scene must outlive the game. With `repeats`, it begins anew after its duration.
    SceneGame(const Scene& scene, const Settings& settings, bool repeats)
        : scene_(scene),
          repeats_(repeats),
          world_(make_world(scene, settings)),
          camera_(camera_of(scene, world_)) {}

    std::int64_t step(std::int64_t, std::int64_t count, InputSource&) override {
        if (repeats_ && world_.time() >= scene_.duration) restart();
        const std::int64_t taken = repeats_ ? 1 : count;
        const Stopwatch stopwatch(times_, &StepTimes::step);
        world_.step(taken);
        return taken;
    }
    void restart() override {
        world_ = make_world(scene_, Settings(world_.settings()));
        ++cuts_;
    }
    [[nodiscard]] std::unique_ptr<AnyGame> clone() const override {
        return std::make_unique<SceneGame>(*this);
    }
    void assign(const AnyGame& other) override {
        world_ = dynamic_cast<const SceneGame&>(other).world_;
        ++cuts_;
    }
    [[nodiscard]] const World& world() const override { return world_; }
    [[nodiscard]] Picture picture() const override {
        Picture picture = draw_scene(scene_, world_, camera_);
        if (repeats_)
            picture.labels.push_back({.at = {8, 6},
                                      .text = fmt::format("repeats after {:g} s", scene_.duration),
                                      .size = 9,
                                      .colour = palette::grey});
        return picture;
    }
    [[nodiscard]] std::string name_of(Entity entity) const override {
        return scene_.name_of_body(entity.index);
    }

private:
    const Scene& scene_;
    bool repeats_;
    World world_;
    Camera camera_;
};

About describe(const Scene& scene, const std::string& name, const std::string& text) {
    return {.name = name,
            .title = scene.title.empty() ? name : scene.title,
            .rate = static_cast<int>(scene.stepping.rate.steps),
            .method = scene.stepping.method->name,
            .precision = scene.stepping.precision,
            .duration = scene.duration,
            .damping = scene.stepping.damping ? name_of(*scene.stepping.damping) : "",
            .scene_text = text};
}

/// Whether somebody looks at the run, and nothing of it is written.
bool is_watched(const Options& options) {
    return !options.headless && !options.steps && options.json.empty() && options.trace.empty() &&
           options.energy.empty() && options.record.empty() && !options.replay &&
           options.script.empty();
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
    std::vector<BudgetEntry> entries;
    if (seconds <= 0) return entries;
    if (scene.budget.energy_drift && seconds < least_share * scene.duration) {
        remark(options.quiet, "[budget] energy_drift is compared over {:g} s, not over {:g} s",
               scene.duration, seconds);
        scene.budget.energy_drift.reset();
    }
    scene.duration = std::min(scene.duration, seconds);
    for (const lab::BudgetLine& budget : lab::check_budget(scene, settings, Interrupt::requested))
        entries.push_back({budget.name, budget.most, budget.measured, budget.kept,
                           fmt::format("over {:g} s: {}", scene.duration, describe(budget))});
    return entries;
}

}  // namespace

/// Takes the options of all games, which app parses.
struct PlayCommand {
    static constexpr CommandTexts texts{
        .name = "play",
        .summary = "Play a scene file in a window, as frames or as numbers",
        .example = "assets/scenes/cloth.toml"};

    static Exit parse_and_run(int argc, char** argv);
};

Exit PlayCommand::parse_and_run(int argc, char** argv) {
    constexpr About program{.name = "oiler play", .title = "Play a scene file"};
    Scene scene;
    std::string name;
    std::string text;
    const auto read = [&](const std::string& path, const std::optional<Manifest>& from) {
        const SceneFile file = find_scene(path, from);
        text = file.text;
        scene = parse_scene(text, file.name);
        name = std::filesystem::path(file.name).stem().string();
        return describe(scene, name, text);
    };
    const CommandLine line = parse_command_line(argc, argv, program, read);
    if (!line.text.empty()) {
        print(line.text);
        return Exit::done;
    }
    const bool repeats = is_watched(line.options);
    const auto make = [&](const Settings& settings) {
        return std::make_unique<SceneGame>(scene, settings, repeats);
    };
    const auto measure_budget = [&](double seconds) { return check(scene, line.options, seconds); };
    return run_game(line.options, line.about, make, measure_budget);
}

template Command make_command<PlayCommand>();

}  // namespace oiler::cli
