// SPDX-License-Identifier: MIT
#include "oiler/app/window.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "oiler/app/kept_size.hpp"
#include "oiler/overlay/legible.hpp"
#include "oiler/overlay/overlays.hpp"
#include "oiler/process/console.hpp"
#include "oiler/whatif/what_if.hpp"

namespace oiler {
namespace {

/// The keys of the loop that the remark at the start names.
constexpr std::size_t first_keys = 4;

std::chrono::nanoseconds time_now() { return std::chrono::steady_clock::now().time_since_epoch(); }

double in_seconds(std::chrono::nanoseconds time) {
    return std::chrono::duration<double>(time).count();
}

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

/// Sleeps until the frame's period ends, unless the display has already waited.
void limit_frame_rate(std::chrono::nanoseconds frame_start, int fps) {
    const std::chrono::nanoseconds period = std::chrono::nanoseconds(std::chrono::seconds(1)) / fps;
    const std::chrono::nanoseconds spent = time_now() - frame_start;
    if (spent < period * 4 / 5) std::this_thread::sleep_for(period - spent);
}

}  // namespace

GameWindow::GameWindow(GameRun& run)
    : run_(run),
      title_(run.about.title),
      controls_(controls_of(run.options, run.about)),
      window_(open_window(first_size(run.options, run.about), title_,
                          run.options.has_size ? Fit::none : Fit::display)),
      opened_size_(window_->size()),
      fps_(run.options.fps.value_or(window_->refresh_rate())),
      renderer_([this](const char* name) { return window_->procedure(name); }),
      play_(run),
      inspector_(run.playback.game(),
                 {.reason = why_fixed(run.options, run.about),
                  .hides_setting = !run.about.fixed_setting.empty()},
                 Renderer::font()),
      panels_{.inspector = run.options.inspector},
      last_frame_(time_now()) {
    remark(run.options.quiet, "drawing with {} ({}): {}{}", window_->provider(),
           renderer_.gl_renderer(), list_of_loop_keys(first_keys),
           uses_escape(controls_) ? "" : ", Escape quits");
}

bool GameWindow::show_frame() {
    const std::chrono::nanoseconds start = time_now();
    const Span span(run_.profile, "frame");
    if (!frame(start)) return false;
    if (window_->paces_frames()) return true;
    const Span wait(run_.profile, "wait");
    limit_frame_rate(start, fps_);
    return true;
}

bool GameWindow::frame(std::chrono::nanoseconds now) {
    const Layout parts = layout();
    const Window::State state =
        window_->poll(run_.live.queue, keys_,
                      {.width = parts.share(&Size::width),
                       .height = parts.share(&Size::height),
                       .mouse = !panels_.inspector || !inspector_.has_mouse(),
                       .escape = !panels_.help});
    is_lost_ = state == Window::State::lost;
    if (is_lost_) return false;
    const Input keys = keys_.take({});
    const bool closes_menu = panels_.inspector && inspector_.has_menu();
    Requests requests = std::exchange(requests_, {});
    const bool filled = panels_.full_screen;
    const bool helped = panels_.help;
    add_requests(requests, panels_, keys);
    if (panels_.help != helped) wait_for_help(requests);
    if (panels_.full_screen != filled) window_->fill_screen(panels_.full_screen);
    take_wish(requests);
    control(requests, keys);
    draw(requests, keys, now);
    ++frames_;
    return state != Window::State::closed && !is_last_frame(requests, closes_menu);
}

/// A game that plays pauses until the help that covers it is closed.
void GameWindow::wait_for_help(Requests& requests) {
    if (panels_.help) help_pauses_ = !play_.clock().is_paused();
    if (help_pauses_ && play_.clock().is_paused() != panels_.help) requests.pauses ^= true;
}

bool GameWindow::is_last_frame(const Requests& requests, bool closes_menu) const {
    const Options& options = run_.options;
    const bool escape_quits = play_.divergence() || !uses_escape(controls_);
    return (escape_quits && requests.quits && !closes_menu) ||
           (options.frames && frames_ >= *options.frames) ||
           (options.replay && run_.playback.steps() >= options.replay->steps) ||
           run_.playback.loop().quits();
}

RunEnd GameWindow::finish() {
    const std::chrono::nanoseconds dropped = play_.clock().dropped_time();
    if (is_lost_) return {Exit::no_display, dropped};
    if (!panels_.full_screen && window_->size() != opened_size_)
        keep_size(run_.options, run_.about, window_->size());
    if (play_.divergence()) throw Error(*play_.divergence());
    return {.dropped = dropped};
}

void GameWindow::control(const Requests& requests, const Input& keys) {
    play_.set_pace(requests);
    take_from_shelf();
    play_.control(requests, wants_restart(controls_, keys));
}

/// Adds the setting that the user wants through what is around a canvas.
void GameWindow::take_wish(Requests& requests) {
    const std::optional<std::string> wish = window_->take_wish();
    if (!wish || !why_fixed(run_.options, run_.about).empty()) return;
    try {
        requests.stepping = parse_what_if(*wish, run_.playback.world().settings().stepping).front();
    } catch (const Error& error) {
        play_.complain(error.what());
    }
}

/// Shows another game of the shelf, or why it cannot be shown.
void GameWindow::take_from_shelf() {
    const std::optional<std::string> dropped = window_->take_dropped();
    if (!run_.shelf) {
        if (dropped)
            play_.complain(fmt::format("{}: this run shows no other scene; start `oiler play {}`",
                                       *dropped, *dropped));
        return;
    }
    try {
        const std::optional<Shelf::Taken> taken = run_.shelf->take(run_.playback.game(), dropped);
        if (!taken) return;
        title_ = taken->title;
        window_->set_title(title_);
        play_.change_to(taken->stepping, true);
        inspector_.begin_game();
    } catch (const Error& error) {
        play_.complain(error.what());
    }
}

void GameWindow::draw(const Requests& requests, const Input& keys, std::chrono::nanoseconds now) {
    // A game whose setting cannot change in play is measured from its start or not at all.
    if (panels_.inspector || has_line() || !run_.about.changes_in_play) play_.measure();
    Picture& picture = play_.play(now);
    const std::size_t bodies = run_.playback.world().body_count();
    is_measured_ = bodies <= most_measured_bodies && (is_measured_ || bodies > 0);
    if (panels_.inspector) add_game_overlays(picture, keys, now);
    window_->take_text(run_.playback.loop().takes_text());
    run_.live.shown = picture.camera;
    const std::string state = status(requests);
    const Stepping& stepping = play_.next_stepping();
    window_->tell({.line = play_.verdict().text,
                   .setting = fmt::format("{}@{}", stepping.method->name, stepping.rate.steps),
                   .is_paused = play_.clock().is_paused()});
    const Picture above = overlay(picture.background, state);
    const std::chrono::nanoseconds before = time_now();
    present(picture, above, state, keys, now);
    if (!play_.clock().is_paused())
        inspector_.add_times(run_.times, play_.show_time(), time_now() - before);
    play_.clock().end_frame(time_now() - now, now - last_frame_);
    last_frame_ = now;
}

/// Follows the chosen body and adds the inspector's overlays to the picture.
void GameWindow::add_game_overlays(Picture& picture, const Input& keys,
                                   std::chrono::nanoseconds now) {
    const Span span(run_.profile, "inspector");
    inspector_.follow(picture, keys, run_.live.shown, in_seconds(now));
    if (!run_.playback.shows_before_cut())
        inspector_.add_overlays(picture, play_.ghosts(), play_.alpha(),
                                panels_.large_errors ? 10 : 1);
}

/// The texts of the loop, over the picture and above it.
Picture GameWindow::overlay(Colour background, const std::string& status) {
    const Span span(run_.profile, "overlay");
    const Layout parts = layout();
    const OverlayArea area(parts.beside_inspector());
    Picture overlay{.background = background};
    if (parts.has_verdict && !panels_.help) add_verdict(overlay, area, play_.verdict(), status);
    if (panels_.help)
        add_help(overlay, area, title_, controls_, key_names(),
                 help_on_loop_keys(!uses_escape(controls_)));
    if (play_.divergence())
        add_notice(overlay, area,
                   {.heading = caption(run_.playback.world().settings().stepping),
                    .text = play_.divergence()->what(),
                    .remedy = fmt::format("F1 changes rate and method, {}F9 restarts, Escape quits",
                                          play_.has_past() ? "F4 goes back, " : "")});
    else if (!play_.complaint().empty())
        add_notice(overlay, area,
                   {.heading = {},
                    .text = play_.complaint(),
                    .remedy = "What was shown goes on. F9 restarts it and closes this."});
    if (!parts.has_verdict && !parts.has_inspector && !panels_.help)
        add_status(overlay, area, status);
    return overlay;
}

std::string GameWindow::status(const Requests& requests) {
    std::string text = play_.status();
    if (requests.rewinds && !play_.has_past())
        text = fmt::format("F4: no way back with {}",
                           play_.has_way_back() ? "so many bodies" : no_way_back(run_.options));
    const auto add = [&](const std::string& more) {
        if (!more.empty()) text += (text.empty() ? "" : "   ") + more;
    };
    if (panels_.inspector && panels_.large_errors) add("errors ×10");
    add(play_.clock().pace().text());
    return text;
}

void GameWindow::present(Picture& picture, const Picture& overlay, const std::string& status,
                         const Input& keys, std::chrono::nanoseconds now) {
    const Layout parts = layout();
    if (parts.is_minimised()) return;
    {
        const Span span(run_.profile, "draw");
        keep_legible(picture, OverlayArea(parts.view()));
        renderer_.draw(picture, parts.window, parts.view());
        renderer_.draw_over(overlay, parts.beside_inspector());
    }
    if (parts.has_inspector) {
        const Span span(run_.profile, "inspector");
        requests_ = inspector_.show(play_.figures(), keys, parts.window, parts.view(),
                                    {.seconds = in_seconds(now - last_frame_),
                                     .dropped = in_seconds(play_.clock().dropped_time()),
                                     .is_paused = play_.clock().is_paused(),
                                     .past = play_.past(),
                                     .no_verdict = play_.no_verdict(),
                                     .status = status,
                                     .background = picture.background});
        renderer_.draw_over(inspector_.overlay());
    }
    const Span span(run_.profile, "present");
    renderer_.blit();
    window_->present();
}

/// Whether the player sees what the timestep costs while the inspector is closed.
bool GameWindow::has_line() const {
    return !run_.options.quiet && !run_.options.no_line && run_.about.has_line &&
           run_.about.fixed_setting.empty();
}

GameWindow::Layout GameWindow::layout() const {
    const bool has_verdict = is_measured_ && has_line() && !panels_.inspector;
    return {window_->size(), panels_.inspector, has_verdict};
}

Size GameWindow::Layout::beside_inspector() const {
    return has_inspector ? Inspector::view(window) : window;
}

Size GameWindow::Layout::view() const {
    Size view = beside_inspector();
    if (has_verdict) view.height -= verdict_height(OverlayArea(view));
    return view;
}

float GameWindow::Layout::share(int Size::*side) const {
    return is_minimised() ? 1 : static_cast<float>(view().*side) / static_cast<float>(window.*side);
}

/// Keys with a letter or a sign are named as on the user's keyboard.
NameButton GameWindow::key_names() const {
    return [this](Button button) {
        const bool has_sign =
            button.id() <= Button(Key::n0).id() ||
            (button.id() >= Button(Key::minus).id() && button.id() <= Button(Key::slash).id());
        const std::string name =
            has_sign ? window_->name_on_layout(static_cast<Key>(button.id())) : "";
        return name.empty() ? name_of(button) : name;
    };
}

}  // namespace oiler
