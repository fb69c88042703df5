// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "oiler/game/game.hpp"
#include "oiler/inspector/inspector.hpp"
#include "oiler/overlay/follower.hpp"
#include "oiler/overlay/motion_overlay.hpp"
#include "oiler/stability/stiffest.hpp"
#include "oiler/whatif/play_along.hpp"

namespace oiler {

/// Gathers the contents of the inspector from a game.
class GameInspector {
public:
    /// The loop's data on a frame.
    struct Frame {
        double seconds = 0;  ///< since the last one
        double dropped = 0;  ///< s, since the start
        bool is_paused = false;
        std::optional<Inspected::Past> past{};
        /// Why there is no verdict on the shown step; empty: there is one.
        std::string no_verdict{};
        std::string status{};                ///< of the loop
        Colour background = palette::paper;  ///< of the game
        bool waits = false;                  ///< until all values are known
    };

    /// Whether the setting can be changed.
    struct Fixed {
        std::string reason{};        ///< why it cannot; empty: it can
        bool hides_setting = false;  ///< the picture has others: only `reason` is shown
    };
    GameInspector(AnyGame& game, Fixed fixed, std::span<const char> font);

    /// Forgets the methods and the followed body of the last game.
    void begin_game();
    /// Counts the times of a frame. `show` is the time of steps and picture.
    void add_times(const StepTimes& steps, std::chrono::nanoseconds show,
                   std::chrono::nanoseconds draw);
    /// Follows the body that the user double-clicks, see Follower.
    void follow(Picture& picture, const Input& mouse, const Camera& shown, double time);
    /// Adds the bodies' true positions and the overlays that the user chose to a picture at `alpha`
    /// between the game's last two steps. Errors are drawn `factor` times as long.
    void add_overlays(Picture& picture, const std::vector<Ghost>& ghosts, double alpha,
                      double factor);
    /// Lays out the panel and returns the user's requests. `figures` are null if the error of
    /// the timestep is not measured.
    [[nodiscard]] Requests show(const LiveFigures* figures, const Input& mouse, Size size,
                                Size view, const Frame& frame);
    [[nodiscard]] const Overlay& overlay() const { return inspector_.overlay(); }
    [[nodiscard]] bool has_mouse() const { return inspector_.has_mouse(); }
    [[nodiscard]] bool has_menu() const { return inspector_.has_menu(); }

private:
    [[nodiscard]] std::string figures_of(Entity body) const;
    /// Renews the spring that is closest to the method's limit, some times a second.
    void find_stiffest(bool waits);

    AnyGame& game_;
    Fixed fixed_;
    Inspector inspector_;
    StiffestFinder finder_;  ///< used by the thread of finding_
    std::future<std::optional<Stiffest>> finding_;
    Stepping found_for_;  ///< the setting that finding_ judges
    std::optional<Inspected::Gauge> stiffest_;
    std::chrono::steady_clock::time_point next_stiffest_{};
    Follower follower_;
    Shown shown_;
    MotionOverlay motion_;
    FrameCosts costs_;
    std::vector<const Method*> methods_;  ///< that can step the bodies; empty: not yet listed
    std::jthread thread_;                 ///< of finding_
};

}  // namespace oiler
