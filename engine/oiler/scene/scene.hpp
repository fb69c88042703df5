// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "oiler/picture/palette.hpp"
#include "oiler/sim/body.hpp"
#include "oiler/physics/stepping.hpp"

namespace oiler {

/// The most bodies of a scene, those that grids and scatters make among them.
inline constexpr std::int64_t most_bodies = 1'000'000;
/// The most forces of a scene: every body has room for as many anchored springs as the body that
/// has the most, and for every attractor.
inline constexpr std::int64_t most_forces = 10'000'000;

/// What moving things of a scene have in common.
struct SceneMatter {
    double mass = 1;            ///< kg, of each body
    double linear_drag = 0;     ///< N·s/m
    double quadratic_drag = 0;  ///< N·s²/m²
    Colour colour = palette::blue;
    std::optional<double> radius{};  ///< m; decided by the picture where there is none
    friend bool operator==(const SceneMatter&, const SceneMatter&) = default;
};

struct SceneBody {
    std::string name{};  ///< empty where nothing refers to it
    SceneMatter matter{};
    Vec3 position{};  ///< m
    Vec3 velocity{};  ///< m/s
    friend bool operator==(const SceneBody&, const SceneBody&) = default;
};

/// From a body to a fixed anchor or to another body.
struct SceneSpring {
    std::size_t body = 0;             ///< which of the scene's bodies
    std::optional<std::size_t> to{};  ///< another of them; where there is none, the anchor counts
    Vec3 anchor{};                    ///< m
    double stiffness = 0;             ///< N/m
    double damping = 0;               ///< N·s/m
    double rest_length = 0;           ///< m
    Colour colour = palette::grey;
    friend bool operator==(const SceneSpring&, const SceneSpring&) = default;
};

/// A point that attracts every body of the scene.
struct SceneAttractor {
    Vec3 position{};  ///< m
    double gm = 1;    ///< m³/s²
    Colour colour = palette::orange;
    std::optional<double> radius{};  ///< m
    friend bool operator==(const SceneAttractor&, const SceneAttractor&) = default;
};

/// Which nodes of a grid hang on springs of the grid's own kind, each where it starts.
enum class Hang { none, corners, top };

/// A row of bodies, or a net of `count[1]` rows upwards from the first one, with a spring between
/// neighbours.
struct SceneGrid {
    std::array<std::int64_t, 2> count{1, 1};  ///< bodies in a row, rows
    Vec3 origin{};                            ///< m, of the lower left body
    Vec3 velocity{};                          ///< m/s
    double spacing = 1;                       ///< m
    SceneMatter matter{};
    double stiffness = 0;                 ///< N/m
    double damping = 0;                   ///< N·s/m
    std::optional<double> rest_length{};  ///< m; the spacing where there is none
    bool diagonals = false;               ///< as well, √2 as long
    Hang hang = Hang::none;               ///< corners: both ends of the uppermost row
    friend bool operator==(const SceneGrid&, const SceneGrid&) = default;

    [[nodiscard]] std::int64_t size() const { return count[0] * count[1]; }
};

/// Bodies at random, evenly in a box of positions and a box of velocities. Which ones is decided by
/// the seed alone, on every machine.
struct SceneScatter {
    std::int64_t count = 0;
    std::int64_t seed = 0;
    Vec3 position_from{};  ///< m
    Vec3 position_to{};    ///< m
    Vec3 velocity_from{};  ///< m/s
    Vec3 velocity_to{};    ///< m/s
    SceneMatter matter{.colour = palette::sky_blue};
    friend bool operator==(const SceneScatter&, const SceneScatter&) = default;
};

/// Where the picture looks; what is left out fits what the scene starts with.
struct SceneCamera {
    std::optional<Vec3> centre{};    ///< m
    std::optional<double> height{};  ///< m
    friend bool operator==(const SceneCamera&, const SceneCamera&) = default;
};

/// What the scene may at most be wrong by.
struct SceneBudget {
    std::optional<double> position_error{};  ///< m, largest over the run
    std::optional<double> energy_drift{};    ///< relative
    friend bool operator==(const SceneBudget&, const SceneBudget&) = default;
};

/// A scene as its file describes it, all of whose numbers are within the limits of the table of
/// keys. Grids and scatters stay what they are until a world is made.
struct Scene {
    std::string title{};
    Stepping stepping{};  ///< the rate in whole steps per second
    int axes = 1;
    double duration = 10;           ///< s
    std::optional<Vec3> gravity{};  ///< m/s²
    std::vector<SceneBody> bodies{};
    std::vector<SceneSpring> springs{};
    std::vector<SceneAttractor> attractors{};
    std::vector<SceneGrid> grids{};
    std::vector<SceneScatter> scatters{};
    SceneCamera camera{};
    SceneBudget budget{};
    friend bool operator==(const Scene&, const Scene&) = default;

    /// Those that grids and scatters make among them.
    [[nodiscard]] std::int64_t body_count() const {
        std::int64_t count = static_cast<std::int64_t>(bodies.size());
        for (const SceneGrid& grid : grids) count += grid.size();
        for (const SceneScatter& scatter : scatters) count += scatter.count;
        return count;
    }
    /// How a body is called, "body 3" where it has no name.
    [[nodiscard]] std::string name_of_body(std::size_t row) const {
        return row < bodies.size() && !bodies[row].name.empty() ? bodies[row].name
                                                                : "body " + std::to_string(row);
    }
};

}  // namespace oiler
