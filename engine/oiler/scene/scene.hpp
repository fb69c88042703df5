// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "oiler/physics/stepping.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/sim/body.hpp"
#include "oiler/sim/obstacle.hpp"

namespace oiler {

/// Largest number of bodies in a scene, with those of grids and scatters.
inline constexpr std::int64_t most_bodies = 1'000'000;
/// Largest number of forces in a scene. Every body has room for all attractors and for as many
/// anchored springs as the body with the most.
inline constexpr std::int64_t most_forces = 10'000'000;

/// Properties that bodies, grids and scatters share.
struct SceneMatter {
    double mass = 1;            ///< kg, per body
    double linear_drag = 0;     ///< N·s/m
    double quadratic_drag = 0;  ///< N·s²/m²
    Colour colour = palette::blue;
    std::optional<double> contact{};  ///< m; if absent, it passes through obstacles
    std::uint32_t meets = ~0U;        ///< see Contact::meets
    std::optional<double> radius{};   ///< m; if absent, the picture chooses it
    friend bool operator==(const SceneMatter&, const SceneMatter&) = default;
};

struct SceneBody {
    std::string name{};  ///< empty if no spring refers to the body
    SceneMatter matter{};
    Vec3 position{};  ///< m
    Vec3 velocity{};  ///< m/s
    friend bool operator==(const SceneBody&, const SceneBody&) = default;
};

/// A spring from a body to a fixed anchor or to another body.
struct SceneSpring {
    std::size_t body = 0;             ///< index in Scene::bodies
    std::optional<std::size_t> to{};  ///< index of the other body; if absent, `anchor` holds
    Vec3 anchor{};                    ///< m
    double stiffness = 0;             ///< N/m
    double damping = 0;               ///< N·s/m
    double rest_length = 0;           ///< m
    bool pulls_only = false;          ///< a rope
    Colour colour = palette::grey;

    /// Whether its world has a link, and no force of the body alone.
    [[nodiscard]] bool is_link() const { return to || pulls_only; }
    friend bool operator==(const SceneSpring&, const SceneSpring&) = default;
};
[[nodiscard]] Link link_of(const SceneSpring& spring);

template <class List>
struct VariantOf;
template <class... Force>
struct VariantOf<std::tuple<Force...>> {
    using type = std::variant<Force...>;
};
template <class... Force>
auto body_forces_of(const std::tuple<Force...>&) {
    using std::conditional_t, std::tuple;
    return std::tuple_cat(conditional_t<BodyForce<Force>, tuple<Force>, tuple<>>{}...);
}
/// A force of any kind on one body.
using AnyForce = VariantOf<decltype(body_forces_of(ForceList<double, 3>{}))>::type;

/// A force that a scene gives in a table with the name of the force, see SceneTable::Kind.
struct SceneForce {
    std::size_t body = 0;  ///< index in Scene::bodies
    AnyForce force{};
    friend bool operator==(const SceneForce&, const SceneForce&) = default;
};

/// A point that attracts every body of the scene.
struct SceneAttractor {
    Vec3 position{};  ///< m
    double gm = 1;    ///< m³/s²
    Colour colour = palette::orange;
    std::optional<double> radius{};  ///< m
    friend bool operator==(const SceneAttractor&, const SceneAttractor&) = default;
};

/// A plane that bodies with a contact meet.
struct ScenePlane {
    std::string name{};  ///< may be empty, as that of each obstacle
    Plane plane{};
    std::uint32_t layers = 1;  ///< see Obstacle::layers
    Colour colour = palette::grey;
    friend bool operator==(const ScenePlane&, const ScenePlane&) = default;
};

/// A circle, a segment or a box that bodies with a contact meet.
struct SceneObstacle {
    std::string name{};
    Obstacle obstacle{};
    Colour colour = palette::grey;
    friend bool operator==(const SceneObstacle&, const SceneObstacle&) = default;
};

/// A polyline of segments.
struct SceneChain {
    std::string name{};
    std::vector<Vec3> points{};  ///< m
    bool closed = false;         ///< has a segment from the last point to the first one
    Obstacle like{};             ///< the first segment; the others differ from it by their ends
    Colour colour = palette::grey;
    friend bool operator==(const SceneChain&, const SceneChain&) = default;
};

/// Equal boxes in rows of text, one for each character but " " and ".". Rows may differ in length.
struct SceneTiles {
    std::string name{};
    Vec3 origin{};                    ///< m, the lower left corner of the last row
    double tile = 1;                  ///< m, the side of a box
    std::vector<std::string> rows{};  ///< the top row first
    std::string one_way{};            ///< characters that are met only from above
    double restitution = 0;
    double friction = 0;
    std::uint32_t layers = 1;
    Colour colour = palette::grey;
    friend bool operator==(const SceneTiles&, const SceneTiles&) = default;
};

/// The segments of a chain, from its first point on.
[[nodiscard]] std::vector<Obstacle> segments_of(const SceneChain& chain);

/// The boxes of tiles, row by row from the top, each from the left. In a scene of three axes they
/// are cubes.
[[nodiscard]] std::vector<Obstacle> boxes_of(const SceneTiles& tiles, int axes);

/// Whether a character of SceneTiles::rows is a box.
[[nodiscard]] constexpr bool is_tile(char c) { return c != ' ' && c != '.'; }

/// The bodies of a grid that have an anchored spring at their initial position.
enum class Hang { none, corners, top };

/// A row of bodies, or a net of `count[1]` rows from the bottom to the top, with a spring between
/// neighbours.
struct SceneGrid {
    std::array<std::int64_t, 2> count{1, 1};  ///< bodies in a row, number of rows
    Vec3 origin{};                            ///< m, position of the lower left body
    Vec3 velocity{};                          ///< m/s
    double spacing = 1;                       ///< m
    SceneMatter matter{};
    double stiffness = 0;                 ///< N/m
    double damping = 0;                   ///< N·s/m
    std::optional<double> rest_length{};  ///< m; if absent, the spacing
    bool diagonals = false;               ///< adds diagonal springs, √2 times as long
    Hang hang = Hang::none;               ///< corners: both ends of the top row
    friend bool operator==(const SceneGrid&, const SceneGrid&) = default;

    [[nodiscard]] std::int64_t size() const { return count[0] * count[1]; }
};

/// A kind of spring in a grid. It links each body to the one `right` columns and `up` rows away.
struct GridLink {
    int right = 0;
    int up = 0;
    Link link{};
};

/// The kinds of springs of a grid, in the order of their creation.
[[nodiscard]] std::vector<GridLink> links_of(const SceneGrid& grid);

/// Initial position of a body, in m.
[[nodiscard]] Vec3 node_position(const SceneGrid& grid, std::int64_t column, std::int64_t row);

/// Index of a body, counted row by row; empty outside of the grid.
[[nodiscard]] std::optional<std::size_t> node_at(const SceneGrid& grid, std::int64_t column,
                                                 std::int64_t row);

/// Indices of the bodies with an anchored spring, each once.
[[nodiscard]] std::vector<std::size_t> anchored_nodes(const SceneGrid& grid);

/// Random bodies, uniform in a box of positions and a box of velocities. The same seed gives the
/// same bodies on every machine.
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

/// The camera of the picture. Absent values are fitted to the start of the scene.
struct SceneCamera {
    std::optional<Vec3> centre{};    ///< m
    std::optional<double> height{};  ///< m
    friend bool operator==(const SceneCamera&, const SceneCamera&) = default;
};

/// Drawn beside the bodies. The motion does not depend on it.
struct SceneView {
    Colour background = palette::paper;
    std::optional<double> trails{};   ///< s, the part of a body's path that is drawn
    std::optional<double> fastest{};  ///< m/s, the speed of the last colour of a scale
    bool wind = true;
    friend bool operator==(const SceneView&, const SceneView&) = default;
};

/// Largest errors that the scene allows.
struct SceneBudget {
    std::optional<double> position_error{};  ///< m, largest of the run
    std::optional<double> energy_drift{};    ///< largest relative change of the energy
    [[nodiscard]] bool is_empty() const { return !position_error && !energy_drift; }
    friend bool operator==(const SceneBudget&, const SceneBudget&) = default;
};

/// A scene as its file describes it. All numbers are within the limits of scene_keys().
/// make_world() expands grids and scatters into bodies, and chains and tiles into obstacles.
struct Scene {
    std::string title{};
    Stepping stepping{};  ///< the rate is a whole number of steps per second
    int axes = 1;
    double duration = 10;           ///< s
    std::optional<Vec3> gravity{};  ///< m/s²
    std::vector<SceneBody> bodies{};
    std::vector<SceneSpring> springs{};
    std::vector<SceneForce> forces{};
    std::vector<SceneAttractor> attractors{};
    std::vector<ScenePlane> planes{};
    std::vector<SceneObstacle> obstacles{};
    std::vector<SceneChain> chains{};
    std::vector<SceneTiles> tiles{};
    std::vector<SceneGrid> grids{};
    std::vector<SceneScatter> scatters{};
    SceneCamera camera{};
    SceneView view{};
    SceneBudget budget{};
    std::vector<std::string> layers{"solid"};  ///< their names, by bit
    friend bool operator==(const Scene&, const Scene&) = default;

    /// Number of bodies, with those of grids and scatters.
    [[nodiscard]] std::int64_t body_count() const {
        std::int64_t count = static_cast<std::int64_t>(bodies.size());
        for (const SceneGrid& grid : grids) count += grid.size();
        for (const SceneScatter& scatter : scatters) count += scatter.count;
        return count;
    }
    [[nodiscard]] bool has_ropes() const;
    [[nodiscard]] bool has_obstacles() const {
        return !planes.empty() || !obstacles.empty() || !chains.empty() || !tiles.empty();
    }
    /// Name of a body for messages; "body 3" if it has none.
    [[nodiscard]] std::string name_of_body(std::size_t row) const {
        return row < bodies.size() && !bodies[row].name.empty() ? bodies[row].name
                                                                : "body " + std::to_string(row);
    }
    /// Name of an obstacle for messages, in the order of make_world(): "lift", "slope 2" for the
    /// second segment or tile of that name, "obstacle 3" if it has none.
    [[nodiscard]] std::string name_of_obstacle(std::size_t index) const;
};

}  // namespace oiler
