// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "oiler/core/frame_costs.hpp"
#include "oiler/core/size.hpp"
#include "oiler/physics/stepping.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/theme.hpp"
#include "oiler/render/renderer.hpp"

namespace oiler {

/// "-12.5 J", "4.235 MJ".
[[nodiscard]] std::string energy_text(double joules);

/// "850 ns", "12.3 µs", "4.5 ms".
[[nodiscard]] std::string time_text(double nanoseconds);

/// The overlays over the picture while the inspector is open.
struct Shown {
    bool trails = false;
    bool springs = false;  ///< coloured by their strain
    bool velocities = false;
    bool accelerations = false;
    friend bool operator==(const Shown&, const Shown&) = default;
};

/// The contents of the inspector on a run that is played.
struct Inspected {
    /// A setting that plays along.
    struct Setting {
        Stepping stepping{};
        std::string error{};  ///< the largest distance from the true motion, such as "7.5 cm"
        Colour grade{};       ///< of that error
        /// The time of update and step per frame at 60 frames per second, such as "< 10 µs".
        std::string cost{};
        std::string forces{};  ///< their evaluations, such as "×4"; empty: not counted
    };
    /// The spring or damper that is closest to the limit of the method.
    struct Gauge {
        std::string name{};
        bool is_damper = false;
        double measure = 0;  ///< ω·dt; for a damper, c·dt
        double limit = 0;    ///< the largest stable measure; infinite: any is stable
    };

    /// The scales of the overlays.
    struct Scales {
        static constexpr Colour colour_of_velocity = palette::green;

        double velocity = 0;      ///< m/s that are drawn as 1 m
        double acceleration = 0;  ///< m/s² that are drawn as 1 m
        double strain = 0;        ///< of springs with the full colour; 0: none has a strain
        std::string stretch{};    ///< likewise, of springs without a rest length, such as "2 cm"
        std::size_t springs = 0;  ///< that are drawn
        std::size_t bodies = 0;   ///< that have trails and arrows; 0: all
    };

    /// The steps that the user can go to.
    struct Past {
        std::int64_t first = 0;
        std::int64_t now = 0;
        std::int64_t last = 0;
    };

    Stepping stepping{};
    std::span<const Method* const> methods{};  ///< those that can step the bodies
    std::string fixed{};                       ///< why the setting cannot be changed; empty: it can
    bool hides_setting = false;                ///< the picture has others: only `fixed` is shown
    std::string verdict{};                     ///< on the error of the timestep
    Colour grade{};                            ///< of the verdict
    std::vector<Setting> settings{};           ///< the run's own first; empty: nothing is known
    bool is_of_round = false;                  ///< `settings` are of the whole last round
    std::string rate_advice{};                 ///< the rate that would be within a pixel
    std::vector<float> errors{};               ///< of the run in its last steps, m
    std::string last_error{};                  ///< of these, such as "7.5 cm"
    double pixel = 0;                          ///< its height, m; 0: unknown
    std::optional<Gauge> stiffest{};
    FrameCosts costs{};                    ///< all 0: not measured
    double energy = 0;                     ///< J
    double begin = 0;                      ///< s, the start of comparing errors and energies
    std::optional<double> first_energy{};  ///< J, at `begin`; empty: unknown
    double energy_scale = 0;               ///< J, the unit of relative changes; 0: none
    bool is_scale_kinetic = false;         ///< the largest kinetic energy; else a potential range
    double time = 0;                       ///< s
    double dropped = 0;                    ///< s
    std::size_t bodies = 0;
    int threads = 1;
    int most_threads = 1;  ///< that can be chosen; 1: more change nothing
    bool is_paused = false;
    std::optional<Past> past{};
    std::string status{};    ///< of the loop, such as a pause
    std::string followed{};  ///< figures of the body that the view follows; empty: it follows none
    Scales scales{};
    Theme theme = theme_of(palette::paper);
};

/// The user's requests to the loop in a frame, through the inspector or with keys.
struct Requests {
    std::optional<Stepping> stepping{};  ///< the wanted setting
    std::optional<int> threads{};
    bool changes_from_start = false;     ///< restart with the setting; else continue with it
    bool pauses = false;                 ///< or resumes
    bool steps = false;                  ///< one step in a pause
    bool goes_back = false;              ///< one step back in a pause
    bool rewinds = false;                ///< goes back in every frame, unless paused
    std::optional<std::int64_t> step{};  ///< to show as long as the time line is held
    bool restarts = false;
    int slower = 0;  ///< how often the pace is halved
    int faster = 0;  ///< how often it is doubled, after that
    bool quits = false;
    Shown shown{};
};

/// A panel at the right of the window.
class Inspector {
public:
    /// The mouse and Escape; the mouse in pixels from the upper left corner of the frame; empty:
    /// outside.
    struct Mouse {
        std::optional<Point> at{};
        bool is_down = false;
        int wheel = 0;
        bool escapes = false;  ///< Escape was pressed
    };

    /// The part at the left of a frame that the panel leaves to the picture, pixels.
    [[nodiscard]] static Size view(Size frame);

    /// `font` is a TrueType file.
    explicit Inspector(std::span<const char> font);
    ~Inspector();
    Inspector(const Inspector&) = delete;
    Inspector& operator=(const Inspector&) = delete;

    /// Lays out a frame and returns the user's requests. `seconds`: since the last frame.
    [[nodiscard]] Requests show(const Inspected& run, const Mouse& mouse, Size frame,
                                double seconds);
    /// The triangles of the last frame.
    [[nodiscard]] const Overlay& overlay() const;
    /// Whether the mouse belongs to the panel and not to the game.
    [[nodiscard]] bool has_mouse() const;
    /// Whether a menu is open, which Escape closes.
    [[nodiscard]] bool has_menu() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace oiler
