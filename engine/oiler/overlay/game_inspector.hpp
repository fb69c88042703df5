// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "oiler/game/game.hpp"
#include "oiler/inspector/inspector.hpp"
#include "oiler/overlay/follower.hpp"
#include "oiler/overlay/motion_overlay.hpp"
#include "oiler/stability/stiffest.hpp"
#include "oiler/whatif/live_what_if.hpp"

namespace oiler {

/// Gathers what the inspector shows of a game.
class GameInspector {
public:
    /// What the loop knows of a frame.
    struct Frame {
        double seconds = 0;  ///< since the last one
        double dropped = 0;  ///< s, since the start
        bool is_paused = false;
        std::optional<Inspected::Past> past{};
        /// Why the verdict does not tell of the step that is shown; empty: it does.
        std::string no_verdict{};
        std::string pace{};
        bool waits = false;  ///< until all that it shows is known
    };

    /// `fixed` tells why the setting cannot be changed; empty: it can.
    GameInspector(AnyGame& game, std::string fixed, std::span<const char> font);

    /// The game was replaced: it has other bodies.
    void begin_game();
    /// Counts the times of a frame. `show` is the time of steps and picture.
    void add_times(const StepTimes& steps, std::chrono::nanoseconds show,
                   std::chrono::nanoseconds draw);
    /// Follows the body that the user double-clicks, see Follower.
    void follow(Picture& picture, const Input& mouse, const Camera& shown, double time);
    /// Adds the true places of the bodies, and what else the user wants to see, to a picture of the
    /// game `alpha` of the way to its last step. Distances are drawn `factor` times as long.
    void add_overlays(Picture& picture, const std::vector<Ghost>& ghosts, double alpha,
                      double factor);
    /// Lays out the panel, and returns what the user asks for. `what_if` is null if the costs of
    /// the timestep are not measured.
    [[nodiscard]] Requests show(LiveWhatIf* what_if, const Input& mouse, Size size, Size view,
                                const Frame& frame);
    [[nodiscard]] const Overlay& overlay() const { return inspector_.overlay(); }
    [[nodiscard]] bool has_mouse() const { return inspector_.has_mouse(); }
    [[nodiscard]] bool has_menu() const { return inspector_.has_menu(); }

private:
    [[nodiscard]] std::string figures_of(Entity body) const;
    /// Renews the spring that is closest to the method's limit, some times a second.
    void find_stiffest(bool waits);

    AnyGame& game_;
    std::string fixed_;
    Inspector inspector_;
    StiffestFinder finder_;  ///< of the thread that finds
    std::future<std::optional<Stiffest>> finding_;
    Stepping found_for_;  ///< the setting that finding_ judges
    std::optional<Inspected::Gauge> stiffest_;
    std::chrono::steady_clock::time_point next_stiffest_{};
    Follower follower_;
    Shown shown_;
    MotionOverlay motion_;
    FrameCosts costs_;
    std::vector<const Method*> methods_;  ///< that the bodies can have; empty: not yet listed
};

}  // namespace oiler
