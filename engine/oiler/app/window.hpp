// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "oiler/app/live_play.hpp"
#include "oiler/app/loop_keys.hpp"
#include "oiler/overlay/game_inspector.hpp"
#include "oiler/platform/surface.hpp"
#include "oiler/render/renderer.hpp"

namespace oiler {

/// A game in a window with the keys of the loop, in real time until the user quits, or the display
/// or a replay ends.
class GameWindow {
public:
    /// Opens the window. The run must outlive it.
    explicit GameWindow(GameRun& run);

    /// Makes a frame and waits for the next. Returns whether that follows.
    [[nodiscard]] bool show_frame();
    /// Ends the run after its last frame. Throws the divergence that stopped the game.
    [[nodiscard]] RunEnd finish();

private:
    /// The parts of the window, in pixels.
    struct Layout {
        Size window;
        bool has_inspector;
        bool has_verdict;

        [[nodiscard]] bool is_minimised() const { return window.width == 0 || window.height == 0; }
        [[nodiscard]] Size beside_inspector() const;
        /// The part that the inspector and the verdict leave to the game's picture.
        [[nodiscard]] Size view() const;
        /// The share of the window's width or height that the view has.
        [[nodiscard]] float share(int Size::*side) const;
    };

    /// Polls, controls, steps and draws, at `now` of a monotonic clock. Returns whether the next
    /// frame follows.
    [[nodiscard]] bool frame(std::chrono::nanoseconds now);
    [[nodiscard]] bool has_line() const;
    [[nodiscard]] Layout layout() const;
    void control(const Requests& requests, const Input& keys);
    void take_from_shelf();
    void take_wish(Requests& requests);
    void wait_for_help(Requests& requests);
    void draw(const Requests& requests, const Input& keys, std::chrono::nanoseconds now);
    void add_game_overlays(Picture& picture, const Input& keys, std::chrono::nanoseconds now);
    [[nodiscard]] Picture overlay(Colour background, const std::string& status);
    void present(Picture& picture, const Picture& overlay, const std::string& status,
                 const Input& keys, std::chrono::nanoseconds now);
    [[nodiscard]] bool is_last_frame(const Requests& requests, bool closes_menu) const;
    [[nodiscard]] std::string status(const Requests& requests);
    [[nodiscard]] NameButton key_names() const;

    GameRun& run_;
    std::string title_;
    std::span<const Control> controls_;  ///< of the game
    std::unique_ptr<Window> window_;
    Size opened_size_;
    int fps_;
    Renderer renderer_;
    LivePlay play_;
    GameInspector inspector_;
    Panels panels_;
    Requests requests_;  ///< through the inspector, for the next frame
    InputQueue keys_;    ///< of the loop
    std::int64_t frames_ = 0;
    bool is_measured_ = false;  ///< whether there is anything to measure
    std::chrono::nanoseconds last_frame_;
    bool help_pauses_ = false;  ///< the last help paused the game
    bool is_lost_ = false;      ///< the display has ended
};

}  // namespace oiler
