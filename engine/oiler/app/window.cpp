// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "oiler/app/kept_pace.hpp"
#include "oiler/app/kept_size.hpp"
#include "oiler/app/live_change.hpp"
#include "oiler/app/loops.hpp"
#include "oiler/app/pace.hpp"
#include "oiler/core/step_clock.hpp"
#include "oiler/overlay/game_inspector.hpp"
#include "oiler/overlay/help.hpp"
#include "oiler/overlay/overlays.hpp"
#include "oiler/play/rewind.hpp"
#include "oiler/process/console.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/render/renderer.hpp"
#include "oiler/whatif/play_along.hpp"

namespace oiler {
namespace {

using Clock = std::chrono::steady_clock;

std::chrono::nanoseconds now() { return Clock::now().time_since_epoch(); }

/// Escape quits a game that has no use for it.
bool uses_escape(std::span<const Control> controls) {
    const auto has_it = [](const Buttons& buttons) {
        return std::find(buttons.begin(), buttons.end(), Button(Key::escape)) != buttons.end();
    };
    return std::any_of(controls.begin(), controls.end(), [&](const Control& one) {
        return has_it(one.positive) || has_it(one.negative);
    });
}

/// Whether the player presses a button of the game's control "restart".
bool wants_restart(std::span<const Control> controls, const Input& keys) {
    const auto found = std::ranges::find(controls, "restart", &Control::name);
    return found != controls.end() &&
           std::any_of(found->positive.begin(), found->positive.end(),
                       [&](const Button& button) { return keys.pressed(button); });
}

/// The file with the size of the window. All scenes share one.
std::filesystem::path size_file(const About& about) {
    return file_of_size(about.scene_text.empty() ? about.name : "oiler");
}

/// The size that is given, else that of the last time.
Size first_size(const Options& options, const About& about) {
    if (options.has_size) return options.size;
    try {
        return read_size(size_file(about)).value_or(options.size);
    } catch (const Error& error) {
        remark(options.quiet, "{}", error.what());
        return options.size;
    }
}

/// Sleeps until the frame's period ends, unless the display has already waited.
void limit_frame_rate(std::chrono::nanoseconds frame_start, int fps) {
    const std::chrono::nanoseconds period = std::chrono::nanoseconds(std::chrono::seconds(1)) / fps;
    const std::chrono::nanoseconds spent = now() - frame_start;
    if (spent < period * 4 / 5) std::this_thread::sleep_for(period - spent);
}

/// A game in a window, with the keys of the loop.
class Session {
public:
    Session(Playback& playback, LiveInput& live, InputSource& inputs, const Options& options,
            const About& about, const MakeGame& make, Shelf* shelf, Profile* profile)
        : playback_(playback),
          make_(make),
          shelf_(shelf),
          profile_(profile),
          live_(live),
          options_(options),
          about_(about),
          title_(about.title),
          controls_(controls_of(options, about)),
          window_(open_window(first_size(options, about), std::string(about.title))),
          opened_size_(window_->size()),
          renderer_([this](const char* name) { return window_->procedure(name); }),
          clock_(static_cast<int>(options.settings.stepping.rate.steps)),
          along_(inputs, {options.settings, options.controls}, make,
                 measures() ? PlayAlong::Pace::of_frames : PlayAlong::Pace::never),
          inspector_(playback.game(), why_fixed(options, about), Renderer::font()),
          inspects_(options.inspector) {
        if (no_way_back(options).empty()) rewind_.emplace(playback.game(), along_);
        inputs_ = rewind_ ? static_cast<InputSource*>(&*rewind_) : &along_;
    }

    Played run() {
        remark(options_.quiet, "drawing with {} ({}): F1 inspector, F2 help, F3 pause, F4 back{}",
               window_->provider(), renderer_.gl_renderer(),
               uses_escape(controls_) ? "" : ", Escape quits");
        const int fps = options_.fps.value_or(window_->refresh_rate());
        for (std::int64_t frame = 0; !Interrupt::requested(); ++frame) {
            const std::chrono::nanoseconds start = now();
            const Span span(profile_, "frame");
            const Window::State state =
                window_->poll(live_.queue, keys_,
                              {.width = share_of(&Size::width),
                               .height = share_of(&Size::height),
                               .mouse = !inspects_ || !inspector_.has_mouse()});
            if (state == Window::State::lost) return {Exit::no_display, dropped_time()};
            const Input keys = keys_.take({});
            const bool closes_menu = inspects_ && inspector_.has_menu();
            control(keys);
            draw_frame(keys, start);
            const bool escaped =
                (failure_ || !uses_escape(controls_)) && keys.pressed(Key::escape) && !closes_menu;
            const bool last = (options_.frames && frame + 1 >= *options_.frames) ||
                              (options_.replay && playback_.steps() >= options_.replay->steps);
            if (state == Window::State::closed || escaped || last || playback_.loop().quits())
                break;
            const Span wait(profile_, "wait");
            limit_frame_rate(start, fps);
        }
        keep_size();
        if (failure_) throw Error(*failure_);
        return {.dropped = dropped_time()};
    }

private:
    void control(const Input& keys) {
        const Wishes wishes = std::exchange(wishes_, {});
        if (keys.presses(Key::f1) % 2 == 1) inspects_ = !inspects_;
        if (keys.presses(Key::f6) % 2 == 1) magnifies_ = !magnifies_;
        if (keys.presses(Key::f2) % 2 == 1) helps_ = !helps_;
        if (!failure_ && (wishes.pauses || keys.presses(Key::f3) % 2 == 1))
            clock_.paused() ? clock_.resume() : clock_.pause();
        for (int i = 0; i < keys.presses(Key::f7); ++i) pace_.slower();
        for (int i = 0; i < keys.presses(Key::f8); ++i) pace_.faster();
        if (wishes.pace < 0) pace_.slower();
        if (wishes.pace > 0) pace_.faster();
        if (keys.presses(Key::f11) % 2 == 1) window_->fill_screen(fills_ = !fills_);
        look_at_shelf();
        if (wishes.stepping) change_to(*wishes.stepping, wishes.changes_from_start);
        if (wishes.threads) is_possible([&] { playback_.game().set_threads(*wishes.threads); });
        clock_.set_time_scale(pace_.numerator(), pace_.denominator());
        // A game that takes no steps sees no keys.
        const bool stands = failure_ || clock_.paused();
        if (wishes.restarts || keys.pressed(Key::f9) ||
            (stands && wants_restart(controls_, keys))) {
            clock_.resume();
            complaint_.clear();
            restart();
        } else if (playback_.game().is_over() && playback_.steps() != restarted_at_ && !was_back_) {
            restart();
        }
        seeked_ = has_past() ? wishes.step : std::nullopt;
        goes_back_ = has_past() && (wishes.goes_back ||
                                    (clock_.paused() ? keys.pressed(Key::f4) : keys.held(Key::f4)));
        const bool steps = !failure_ && (wishes.steps || keys.pressed(Key::f5));
        if (clock_.paused() && (steps || goes_back_)) clock_.single_step();
    }

    /// Shows another game of the shelf, or why it cannot be shown.
    void look_at_shelf() {
        const std::optional<std::string> dropped = window_->take_dropped();
        if (!shelf_ && dropped)
            complaint_ = fmt::format("{}: this run shows no other scene; start `oiler play {}`",
                                     *dropped, *dropped);
        if (!shelf_) return;
        try {
            const std::optional<Shelf::Taken> taken = shelf_->take(playback_.game(), dropped);
            if (!taken) return;
            title_ = taken->title;
            window_->set_title(title_);
            change_.forget();
            complaint_.clear();
            restart_with(taken->stepping);
            inspector_.list_methods();
            inspector_.stop_following();
        } catch (const Error& error) {
            complaint_ = error.what();
        }
    }

    void change_to(const Stepping& stepping, bool from_start) {
        // Bodies have the precision that they were made with.
        const bool needs_start =
            failure_ || !about_.changes_in_play ||
            stepping.precision != playback_.world().settings().stepping.precision;
        change_.forget();
        complaint_.clear();
        if (from_start || needs_start)
            restart_with(stepping);
        else
            change_.want(stepping);
    }
    /// Makes the game anew with another setting. Whatever the game did is gone.
    void restart_with(const Stepping& stepping) {
        Settings settings = playback_.world().settings();
        settings.stepping = stepping;
        if (!is_possible([&] {
                const std::unique_ptr<AnyGame> fresh = make_(settings);
                fresh->world().require_applicable();
                playback_.game().assign(*fresh);
            }))
            return;
        begin_setting();
        if (measures()) along_.start(playback_.steps(), stepping);
    }
    /// Goes on with the wanted setting, if that has a tick until `step`.
    void change_until(std::int64_t step) {
        bool has_changed = false;
        if (!is_possible([&] { has_changed = change_.make(playback_, step, *inputs_); })) return;
        if (!has_changed) return;
        begin_setting();
        if (measures()) along_.start_from(playback_.game(), playback_.steps());
    }
    /// Whether the game can have a setting, which f() gives it. Else the window tells why.
    template <class F>
    bool is_possible(F f) {
        try {
            f();
            return true;
        } catch (const Error& error) {
            if (error.exit() != Exit::usage) throw;
            complaint_ = error.what();
            return false;
        }
    }
    /// The clock of the game's new setting; what was before it is out of reach.
    void begin_setting() {
        dropped_ += clock_.dropped_time();
        const bool was_paused = clock_.paused();
        clock_ = StepClock(static_cast<int>(playback_.world().settings().stepping.rate.steps));
        if (was_paused && !failure_) clock_.pause();
        knows_steps_ = false;
        kept_pace_ = {};
        undone_ = -playback_.steps();
        playback_.go_to(playback_.steps());
        failure_.reset();
        was_back_ = has_diverged_ = false;
        if (rewind_) rewind_->forget(playback_.steps());
    }
    [[nodiscard]] std::chrono::nanoseconds dropped_time() const {
        return dropped_ + clock_.dropped_time();
    }

    /// Keeps the size for the next start if the user has changed it.
    void keep_size() {
        const std::filesystem::path file = size_file(about_);
        if (fills_ || window_->size() == opened_size_ || file.empty()) return;
        try {
            write_size(file, window_->size());
        } catch (const Error& error) {
            remark(options_.quiet, "{}", error.what());
        }
    }

    /// Whether the user wants to know what the timestep costs.
    [[nodiscard]] bool measures() const { return !options_.quiet || options_.inspector; }

    void restart() {
        restarted_at_ = playback_.steps();
        was_back_ = has_diverged_ = false;
        AnyGame& game = playback_.game();
        if (measures()) along_.repeat(playback_.steps());
        failure_.reset();
        if (game.takes_input()) return live_.queue.restart();
        game.restart();
        if (rewind_) rewind_->forget(playback_.steps());
    }

    void draw_frame(const Input& keys, std::chrono::nanoseconds start) {
        const bool back = goes_back_ || seeked_;
        live_.queue.set_paused(clock_.paused() || back);
        if (!knows_steps_) catch_up_at_most(2 * duration_of_step());
        const StepClock::Frame owed = clock_.advance(start);
        const std::int64_t steps = owed.steps;
        if (rewind_ && !failure_) rewind_->keep(playback_.steps());
        if (seeked_)
            go_to(*seeked_);
        else if (back && steps > 0)
            go_to(playback_.steps() - steps);
        if (!back && steps > 0 && was_back_) measure_from_here();
        // What is shown after a step back is a whole step, until play goes on.
        whole_ = back || (whole_ && clock_.paused());
        inspector_.begin_frame();
        const std::chrono::nanoseconds before_picture = now();
        Picture& picture = next_picture(back);
        const std::chrono::nanoseconds show_time = now() - before_picture;
        if (steps > 0) limit_steps_of_frame(steps);
        play_along();
        if (inspects_) {
            const Span span(profile_, "inspector");
            inspector_.follow(picture, keys, live_.shown,
                              std::chrono::duration<double>(start).count());
            add_overlays(picture);
        }
        window_->take_text(playback_.loop().takes_text());
        live_.shown = picture.camera;
        const Picture overlay = overlay_of(keys, back);
        const std::chrono::nanoseconds before_drawing = now();
        show(picture, overlay, keys, start);
        if (!clock_.paused()) inspector_.add_times(show_time, now() - before_drawing);
        if (knows_steps_) kept_pace_.add(now() - start, start - last_start_, owed.dropped);
        last_start_ = start;
    }

    /// What the loop says, over the picture and above it.
    Picture overlay_of(const Input& keys, bool back) {
        const Span span(profile_, "overlay");
        const OverlayArea area(beside_inspector(window_->size()));
        Picture overlay;
        if (has_verdict() && !helps_) add_verdict(overlay, area, verdict());
        if (helps_)
            add_help(overlay, area, title_, controls_, key_names(), !uses_escape(controls_));
        if (failure_)
            add_notice(overlay, area, failure_->what(),
                       fmt::format("F1 changes rate and method, {}F9 restarts, Escape quits",
                                   has_past() ? "F4 goes back, " : ""));
        else if (!complaint_.empty())
            add_notice(overlay, area, complaint_,
                       "What was shown goes on. F9 restarts it and closes this.");
        add_status(overlay, area, status(keys, back));
        return overlay;
    }

    [[nodiscard]] bool has_verdict() const { return !options_.quiet && !inspects_; }
    [[nodiscard]] Size beside_inspector(Size size) const {
        return inspects_ ? Inspector::view(size) : size;
    }
    /// The part of the frame that the inspector and the verdict leave to the picture.
    [[nodiscard]] Size view(Size size) const {
        Size view = beside_inspector(size);
        if (has_verdict()) view.height -= verdict_height(OverlayArea(view));
        return view;
    }
    [[nodiscard]] float share_of(int Size::*side) const {
        const Size size = window_->size();
        if (size.width == 0 || size.height == 0) return 1;
        return static_cast<float>(view(size).*side) / static_cast<float>(size.*side);
    }
    void show(Picture& picture, const Picture& overlay, const Input& keys,
              std::chrono::nanoseconds start) {
        const Size size = window_->size();
        if (size.width == 0 || size.height == 0) return;  // minimised
        {
            const Span span(profile_, "draw");
            keep_legible(picture, OverlayArea(view(size)));
            renderer_.draw(picture, size, view(size));
            renderer_.draw_over(overlay, beside_inspector(size));
        }
        if (inspects_) {
            const Span span(profile_, "inspector");
            wishes_ = inspector_.show(
                along_, keys, size, view(size),
                {.seconds = std::chrono::duration<double>(start - last_start_).count(),
                 .dropped = std::chrono::duration<double>(dropped_time()).count(),
                 .is_paused = clock_.paused(),
                 .past = past(),
                 .other_moment = other_moment(),
                 .pace = pace_.text()});
            renderer_.draw_over(inspector_.overlay());
        }
        const Span span(profile_, "present");
        renderer_.blit();
        window_->present();
    }

    /// s of real time
    [[nodiscard]] double duration_of_step() const {
        return static_cast<double>(pace_.denominator()) /
               (static_cast<double>(clock_.rate()) * pace_.numerator());
    }
    void catch_up_at_most(double seconds) {
        const std::chrono::duration<double> limit(std::min(seconds, 0.25));
        clock_.set_longest_frame(std::chrono::ceil<std::chrono::nanoseconds>(limit));
    }
    /// Steps that take longer than the time they simulate would hold a frame for seconds.
    void limit_steps_of_frame(std::int64_t steps) {
        constexpr double most = 0.1;  // s, of a frame's steps
        if (!std::exchange(knows_steps_, true)) dropped_ -= clock_.dropped_time();
        const double took = std::chrono::duration<double>(inspector_.time_of_steps()).count();
        const double step = duration_of_step();
        catch_up_at_most(took > 0 ? std::max(step, most / took * static_cast<double>(steps) * step)
                                  : 1);
    }

    void add_overlays(Picture& picture) {
        if (playback_.shows_before_cut()) return;
        // A frame at the time of a step shows that step, others the way to it.
        const bool at_step = playback_.steps() == clock_.ticks() - undone_;
        const double alpha = at_step ? 1 : clock_.alpha();
        std::vector<Ghost> ghosts;
        if (!was_back_) ghosts = along_.ghosts(playback_.steps(), alpha);
        inspector_.add_overlays(picture, ghosts, alpha, magnifies_ ? 10 : 1);
    }

    void play_along() {
        const Span span(profile_, "play along");
        along_.play_until(was_back_ ? rewind_->last() : playback_.steps());
    }

    /// The picture to show now; after a divergence, that of the last step before.
    Picture& next_picture(bool back) {
        try {
            if (!back && !failure_) change_until(clock_.ticks() - undone_);
            if (!failure_)
                return playback_.show(clock_.ticks() - undone_, whole_ ? 0 : clock_.alpha(),
                                      *inputs_);
        } catch (const Error& error) {
            if (error.exit() != Exit::diverged) throw;
            failure_ = error;
            clock_.pause();
        }
        return playback_.show_last();
    }

    void measure_from_here() {
        was_back_ = has_diverged_ = false;
        if (!measures()) return;
        if (about_.changes_in_play)
            along_.start_from(playback_.game(), playback_.steps());
        else
            along_.stop("what the timestep costs is no longer measured: you went back");
    }

    [[nodiscard]] bool has_past() const { return rewind_ && rewind_->has_past(); }
    [[nodiscard]] std::optional<Inspected::Past> past() const {
        if (!has_past()) return std::nullopt;
        return Inspected::Past{rewind_->first(), playback_.steps(),
                               std::max(rewind_->last(), playback_.steps())};
    }
    /// Shows a step of the past, or the last one again. What plays along stays where it is, for as
    /// long as no other step is taken.
    void go_to(std::int64_t step) {
        step = std::clamp(step, rewind_->first(), rewind_->last());
        has_diverged_ = has_diverged_ || failure_;
        if (step != playback_.steps() || failure_) {
            live_.queue.continue_after(rewind_->go_to(step));
            playback_.go_to(step);
        }
        failure_.reset();
        was_back_ = has_diverged_ || step < rewind_->last();
        undone_ = clock_.ticks() - step;
    }
    /// Why what plays along does not show this moment; empty: it does.
    [[nodiscard]] std::string other_moment() const {
        if (!was_back_ || !measures()) return {};
        return about_.changes_in_play
                   ? "what the timestep costs is measured again when you play on"
                   : "what the timestep costs is not measured when you play on from here";
    }
    [[nodiscard]] Verdict verdict() {
        const std::string other = other_moment();
        return other.empty() ? along_.verdict() : Verdict{.text = other};
    }

    [[nodiscard]] std::string status(const Input& keys, bool back) const {
        std::string text;
        if (keys.held(Key::f4) && !has_past())
            text = fmt::format("F4: no way back with {}",
                               rewind_ ? "so many bodies" : no_way_back(options_));
        else if (failure_)
            text = "stopped";
        else if (change_.wanted())
            text = fmt::format("{} Hz begins when both rates have a step",
                               change_.wanted()->rate.steps);
        else if (clock_.paused())
            text =
                fmt::format("paused: F3 resumes, {}F5 steps", has_past() ? "F4 steps back, " : "");
        else if (back)
            text = fmt::format("back at {:.2f} s{}", playback_.world().time(),
                               playback_.steps() == rewind_->first() ? ", no further" : "");
        else
            text = kept_pace_.text();
        if (inspects_ && magnifies_)
            text += (text.empty() ? "" : "   ") + std::string("errors ×10");
        if (!pace_.text().empty()) text += (text.empty() ? "" : "   ") + pace_.text();
        return text;
    }
    /// Keys with a letter or a sign have the name of the user's keyboard.
    [[nodiscard]] NameButton key_names() const {
        return [this](Button button) {
            const bool has_sign =
                button.id() <= Button(Key::n0).id() ||
                (button.id() >= Button(Key::minus).id() && button.id() <= Button(Key::slash).id());
            const std::string name =
                has_sign ? window_->name_on_layout(static_cast<Key>(button.id())) : "";
            return name.empty() ? name_of(button) : name;
        };
    }

    Playback& playback_;
    const MakeGame& make_;
    Shelf* shelf_;
    Profile* profile_;
    LiveInput& live_;
    const Options& options_;
    const About& about_;
    std::string title_;
    std::span<const Control> controls_;
    std::unique_ptr<Window> window_;
    Size opened_size_;
    Renderer renderer_;
    StepClock clock_;
    PlayAlong along_;
    GameInspector inspector_;
    Wishes wishes_;
    Pace pace_;
    KeptPace kept_pace_;
    InputQueue keys_;  ///< of the loop
    std::optional<Rewind> rewind_;
    InputSource* inputs_ = nullptr;
    std::int64_t restarted_at_ = -1;  ///< the steps before the last restart
    std::int64_t undone_ = 0;         ///< steps of the clock that the game has not taken
    std::optional<Error> failure_;    ///< a divergence that holds the run
    LiveChange change_;
    std::string complaint_;                ///< why the game cannot have the setting that was chosen
    std::chrono::nanoseconds dropped_{0};  ///< with earlier settings
    std::chrono::nanoseconds last_start_ = now();
    bool inspects_;
    bool magnifies_ = false;
    bool helps_ = false;
    bool fills_ = false;  ///< the screen
    bool goes_back_ = false;
    bool knows_steps_ = false;  ///< how long the steps of the setting take
    bool whole_ = false;
    std::optional<std::int64_t> seeked_;  ///< the step that the time line shows
    bool was_back_ = false;               ///< what plays along is of later steps than the one shown
    bool has_diverged_ = false;           ///< they include steps that no game can go to
};

}  // namespace

Played run_window(Playback& playback, LiveInput& live, InputSource& inputs, const Options& options,
                  const About& about, const MakeGame& make, Shelf* shelf, Profile* profile) {
    return Session(playback, live, inputs, options, about, make, shelf, profile).run();
}

}  // namespace oiler
