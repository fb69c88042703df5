// SPDX-License-Identifier: MIT
#include "oiler/app/run.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <utility>

#include "oiler/app/golden.hpp"
#include "oiler/app/options.hpp"
#include "oiler/app/report.hpp"
#include "oiler/app/run_game.hpp"
#include "oiler/app/run_inputs.hpp"
#include "oiler/app/window.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/utf8.hpp"
#include "oiler/process/console.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/sim/kernels/instructions.hpp"
#include "oiler/sim/step_work.hpp"
#include "oiler/whatif/what_if_runs.hpp"

namespace oiler {
namespace {

using Clock = std::chrono::steady_clock;

void run_steps(const GameRun& run) {
    Playback& playback = run.playback;
    const std::int64_t steps = *run.options.steps;
    Progress progress(run.options.quiet, "steps", steps);
    progress.show(0);
    const std::int64_t stride = std::max<std::int64_t>(1, steps / 100);
    while (playback.steps() < steps && !playback.loop().quits() && !Interrupt::requested()) {
        playback.step_to(std::min(playback.steps() + stride, steps), run.inputs);
        progress.show(playback.steps());
    }
}

/// Says beforehand that a run without a window takes long.
void announce_steps(const Options& options, const About& about, const World& world) {
    if (!options.steps && (!options.headless || options.frame)) return;
    const Stepping& stepping = world.settings().stepping;
    const double seconds = options.frames
                               ? static_cast<double>(*options.frames) / options.fps.value_or(60)
                               : about.duration;
    const double steps =
        options.steps ? static_cast<double>(*options.steps) : seconds / stepping.rate.dt();
    announce(options.quiet, about.name, steps,
             steps * StepWork(world.bodies()).seconds_per_step(*stepping.method));
}

/// Plays as frames or as steps alone.
RunEnd play_without_window(GameRun& run) {
    const Options& options = run.options;
    if (options.steps) {
        run_steps(run);
        return {Interrupt::requested() ? Exit::interrupted : Exit::done};
    }
    const Exit exit = run_headless(run);
    // The last frame of a replay comes before its end.
    if (options.replay && !options.frames && !options.frame)
        run.playback.step_to(options.replay->steps, run.inputs);
    return {exit};
}

Exit show_budget(const std::vector<BudgetEntry>& budget, bool quiet) {
    bool kept = true;
    for (const BudgetEntry& entry : budget) {
        remark(quiet && entry.kept, "[budget] {}", entry.words);
        kept = kept && entry.kept;
    }
    return kept ? Exit::done : Exit::comparison_failed;
}

/// Without a provider of OpenGL, drawing is not timed, unless the user asks for that provider.
std::unique_ptr<DrawTimer> open_timer(const Options& options) {
    try {
        return std::make_unique<DrawTimer>(options.offscreen, options.size);
    } catch (const Error& error) {
        if (error.exit() != Exit::no_display || options.offscreen != Offscreen::automatic) throw;
        remark(options.quiet, "draw is not measured: {}", error.what());
        return nullptr;
    }
}

/// Measures the errors of other settings, prints the table and writes --json.
Exit run_what_if(const Options& options, const About& about, const MakeGame& make) {
    const std::vector<Stepping> steppings = options.what_if_settings.empty()
                                                ? usual_what_if(options.settings, make)
                                                : options.what_if_settings;
    std::optional<File> json;  // opened before the runs, so that a wrong path costs no time
    if (!options.json.empty()) json.emplace(options.json, kinds::json);
    const RecordedPlay play{options.settings, options.controls, *options.replay,
                            options.replay_file.string(), options.replay_anyway};
    const std::unique_ptr<DrawTimer> draw = open_timer(options);
    const std::optional<WhatIf> result =
        measure_what_if(play, steppings, make, draw.get(), options.quiet);
    if (!result) return Exit::interrupted;
    if (json) {
        json->write(to_json(*result, about.name).dump(2) + "\n");
        json->commit();
    }
    if (options.json != "-") write_file("-", for_terminal(text_of(*result, about.name)));
    return Exit::done;
}

/// Throws Error{diverged} if the energy is not finite. A run without a player is repeated one step
/// at a time to find the number of steps after which it overflowed.
void require_finite_energy(const GameRun& run, std::optional<std::int64_t>& overflow) {
    const World& world = run.playback.world();
    if (std::isfinite(world.energy().total())) return;
    if (run.options.headless || run.options.steps) {
        Options options = run.options;
        options.record.clear();
        options.quiet = true;
        const std::unique_ptr<AnyGame> game = run.make(options.settings);
        RunInputs inputs(options, run.about, *game);
        for (std::int64_t step = 0; step < run.playback.steps(); ++step) {
            overflow = step;
            game->world().require_finite(game->world().energy());
            static_cast<void>(game->step(step, 1, inputs.source()));
        }
        overflow.reset();
    }
    world.require_finite(world.energy());
}

/// A run from the making of its game to its files. A page goes on with it after main has returned,
/// so it holds all that it uses.
class Session {
public:
    Session(Options options, const About& about, MakeGame make, MeasureBudget measure_budget,
            std::shared_ptr<Shelf> shelf);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    [[nodiscard]] bool has_window() const { return !options_.headless && !options_.steps; }
    /// Plays without a window.
    void play() {
        until_divergence([&] { end_ = play_without_window(*run_); });
    }
    /// Plays a frame in the window. Returns whether the next one follows.
    [[nodiscard]] bool frame();
    /// Writes the files of the run. Throws the divergence that ended it.
    [[nodiscard]] Exit finish();

private:
    template <class F>
    void until_divergence(F f);
    void complete_report();
    void commit_files();

    const Options options_;
    const About about_;
    const MakeGame make_;
    const MeasureBudget measure_budget_;
    const std::shared_ptr<Shelf> shelf_;
    const std::unique_ptr<AnyGame> game_;
    RunInputs inputs_;
    RunReport report_;
    std::optional<TraceWriter> trace_;
    std::optional<File> json_;
    std::optional<File> profile_file_;
    std::optional<Profile> profile_;
    std::optional<Playback> playback_;
    std::optional<GoldenUpdate> golden_;
    std::optional<GameRun> run_;
    std::optional<GameWindow> window_;  ///< from the first frame to the last
    Clock::time_point start_ = Clock::now();
    RunEnd end_;
};

Session::Session(Options options, const About& about, MakeGame make, MeasureBudget measure_budget,
                 std::shared_ptr<Shelf> shelf)
    : options_(std::move(options)),
      about_(about),
      make_(std::move(make)),
      measure_budget_(std::move(measure_budget)),
      shelf_(std::move(shelf)),
      game_(make_(options_.settings)),
      inputs_(options_, about_, *game_) {
    const World& world = game_->world();
    world.require_applicable();
    if (const auto line = missing_instructions()) remark(options_.quiet, "{}", *line);
    if (!options_.quiet)
        for (const std::string& line : world.preflight()) remark(false, "{}", line);
    announce_steps(options_, about_, world);
    report_ = {.scene = about_.name, .first = world.energy()};
    trace_.emplace(options_.trace, options_.energy, world);
    // Opened before the run, so that a wrong path costs no time.
    if (!options_.json.empty()) json_.emplace(options_.json, kinds::json);
    if (!options_.profile.empty()) {
        profile_file_.emplace(options_.profile, kinds::json);
        profile_.emplace();
    }
    Profile* const stages = profile_ ? &*profile_ : nullptr;
    playback_.emplace(*game_, *trace_, options_.headless ? Keep::hashes : Keep::nothing, stages);
    if (options_.update_golden) golden_.emplace(options_.golden, std::string(about_.name));
    inputs_.watch(*playback_);
    run_.emplace(GameRun{.options = options_,
                         .about = about_,
                         .make = make_,
                         .playback = *playback_,
                         .live = inputs_.live,
                         .inputs = inputs_.source(),
                         .script_steps = inputs_.script_steps(),
                         .shelf = shelf_.get(),
                         .profile = stages});
    start_ = Clock::now();
}

/// Calls f(). A divergence ends the run, and the report has it.
template <class F>
void Session::until_divergence(F f) {
    try {
        f();
    } catch (const Error& error) {
        if (error.exit() != Exit::diverged) {
            inputs_.finish_recording(*playback_, true);
            throw;
        }
        report_.divergence = error.what();
    }
}

bool Session::frame() {
    bool goes_on = false;
    until_divergence([&] {
        if (!window_) window_.emplace(*run_);
        goes_on = !Interrupt::requested() && window_->show_frame();
        if (!goes_on) end_ = window_->finish();
    });
    return goes_on;
}

void Session::complete_report() {
    std::optional<std::int64_t> overflow;
    if (report_.divergence.empty())
        until_divergence([&] {
            require_finite_energy(*run_, overflow);
            report_.last = game_->world().energy();
            report_.state_hash = game_->state_hash();
            report_.readings = game_->readings();
        });
    report_.steps = overflow.value_or(playback_->steps());
    report_.dropped = end_.dropped;
    report_.wall = Clock::now() - start_;
}

void Session::commit_files() {
    trace_->commit();
    if (!profile_) return;
    profile_file_->write(profile_->to_json());
    profile_file_->commit();
}

Exit Session::finish() {
    window_.reset();
    complete_report();
    const bool diverged = !report_.divergence.empty();
    Exit exit = std::max(end_.exit, inputs_.finish(*playback_, options_, diverged));
    commit_files();
    if (report_.dropped.count() > 0)
        remark(options_.quiet, "late frames dropped {:.3f} s",
               std::chrono::duration<double>(report_.dropped).count());
    const bool is_checked = (options_.headless || json_) && !diverged;
    if (measure_budget_ && is_checked && exit == Exit::done && !Interrupt::requested())
        report_.budget = measure_budget_(game_->world().time());
    if (json_) write_report(*json_, report_, game_->world());
    if (diverged) throw Error(Exit::diverged, report_.divergence);
    if (exit == Exit::no_display)
        fail(Exit::no_display,
             "the display has ended; the files of the run are complete up to there");
    if (Interrupt::requested()) return Exit::interrupted;
    if (golden_)
        golden_->commit();
    else if (!options_.golden.empty())
        exit = std::max(exit, compare_with_golden(options_, report_.budget));
    return std::max(exit, show_budget(report_.budget, options_.quiet));
}

/// Plays the game and writes the files of the run. In a page, the frames come after the return.
Exit play_session(const std::shared_ptr<Session>& session) {
    if (!session->has_window()) {
        session->play();
        return session->finish();
    }
    const auto exit = std::make_shared<Exit>(Exit::done);
    repeat([session, exit] {
        if (session->frame()) return true;
        *exit = session->finish();
        return false;
    });
    return *exit;
}

}  // namespace

Exit run_game(const Options& options, const About& about, const MakeGame& make,
              const MeasureBudget& measure_budget, const std::shared_ptr<Shelf>& shelf) try {
    if (options.what_if) return run_what_if(options, about, make);
    const Exit exit =
        play_session(std::make_shared<Session>(options, about, make, measure_budget, shelf));
    if (!options.junit.empty() && Interrupt::requested())
        write_junit_of_failure(options, Exit::interrupted, Interrupt::reason());
    return exit;
} catch (const Error& error) {
    if (!options.junit.empty()) write_junit_of_failure(options, error.exit(), error.what());
    throw;
}

int run_program(int argc, char** argv, const About& about, const MakeGame& make) {
    return guard_main(about.name, [&] {
        const CommandLine line = parse_command_line(argc, argv, about);
        if (line.text.empty()) return run_game(line.options, about, make);
        write_file("-", for_terminal(line.text));
        return Exit::done;
    });
}

}  // namespace oiler
