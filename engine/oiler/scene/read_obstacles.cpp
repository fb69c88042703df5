// SPDX-License-Identifier: MIT
#include "oiler/scene/read_obstacles.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "oiler/core/nearest.hpp"

namespace oiler {
namespace {

using Keys = std::vector<std::string_view>;

const Keys keys_of_shapes{"centre", "radius", "size", "angle", "from", "to"};

/// Refuses keys of other shapes, and a shape without the keys that it needs.
void require_keys(const Section& section, std::string_view shape, const Keys& needed,
                  const Keys& optional = {}) {
    const auto any_of = [](const Keys& keys, std::string_view key) {
        return std::ranges::find(keys, key) != keys.end();
    };
    for (const std::string_view key : keys_of_shapes) {
        if (section.has(key) && !any_of(needed, key) && !any_of(optional, key))
            refuse(section.place(key), "obstacle.{0}: a {1} has no {0}; it has {2}", key, shape,
                   fmt::join(needed, ", "));
        if (!section.has(key) && any_of(needed, key))
            refuse(section.place(), "obstacle.{}: missing; a {} needs {}", key, shape,
                   fmt::join(needed, " and "));
    }
}

/// Reads the shape that the key `shape` names.
class ShapeReader {
public:
    ShapeReader(const Scene& scene, const Section& section) : scene_(scene), section_(section) {}

    Shape run() const {
        const std::string word = section_.word("shape");
        if (word == "circle") return read_circle();
        return word == "box" ? read_box() : read_segment();
    }

private:
    void check(std::string_view key, const Shape& shape) const {
        check_obstacle(scene_, section_, key, {.shape = shape});
    }
    [[nodiscard]] Vec3 ones() const {
        Vec3 ones{};
        for (int i = 0; i < scene_.axes; ++i) ones[i] = 1;
        return ones;
    }

    Shape read_circle() const {
        require_keys(section_, "circle", {"centre", "radius"});
        CircleShape circle;
        section_.read("centre", circle.centre);
        check("centre", circle);
        section_.read("radius", circle.radius);
        check("radius", circle);
        return circle;
    }
    Shape read_box() const {
        require_keys(section_, "box", {"centre", "size"}, {"angle"});
        BoxShape box{.size = ones()};
        section_.read("centre", box.centre);
        check("centre", box);
        section_.read("size", box.size);
        check("size", box);
        section_.read("angle", box.angle);
        check("angle", box);
        return box;
    }
    Shape read_segment() const {
        require_keys(section_, "segment", {"from", "to"});
        SegmentShape segment{.to = ones()};
        check("shape", segment);
        section_.read("from", segment.from);
        section_.read("to", segment.to);
        check_numbers(scene_, section_, "from", segment.from);
        check("to", segment);
        return segment;
    }

    const Scene& scene_;
    const Section& section_;
};

/// The names of the key, each once.
std::vector<std::string> read_names(const Section& section, std::string_view key,
                                    std::string_view remedy) {
    std::vector<std::string> names;
    section.read(key, names);
    if (names.empty())
        refuse(section.place(key), "{}.{}: expected a layer, got an empty list; {}", section.name(),
               key, remedy);
    for (auto name = names.begin(); name != names.end(); ++name) {
        if (name->empty())
            refuse(section.place(key), "{}.{}: expected a name, got an empty text", section.name(),
                   key);
        if (std::find(names.begin(), name, *name) != name)
            refuse(section.place(key), "{}.{}: \"{}\" comes twice; name it once", section.name(),
                   key, printable(*name));
    }
    return names;
}

void read_layers(Scene& scene, const Section& section, std::uint32_t& layers) {
    constexpr std::size_t most_layers = 32;
    if (!section.has("layers")) return;
    layers = 0;
    for (std::string& name : read_names(section, "layers", "leave it out")) {
        const auto found = std::ranges::find(scene.layers, name);
        if (found == scene.layers.end() && scene.layers.size() == most_layers)
            refuse(section.place("layers"),
                   "{}.layers: \"{}\" and \"solid\" are more than {} layers; give fewer",
                   section.name(), printable(name), most_layers);
        layers |= 1U << static_cast<unsigned>(found - scene.layers.begin());
        if (found == scene.layers.end()) scene.layers.push_back(std::move(name));
    }
}

void read_swing(const Scene& scene, const Section& section, Obstacle& obstacle) {
    for (const std::string_view key : {"period", "phase"})
        if (section.has(key) && !section.has("swing"))
            refuse(section.place(key), "{}.{}: without a swing; give `swing`, the way of it",
                   section.name(), key);
    if (!section.has("swing")) return;
    Swing& swing = obstacle.swing.emplace();
    section.read("swing", swing.way);
    section.read("period", swing.period);
    section.read("phase", swing.phase);
    check_obstacle(scene, section, "swing", obstacle);
}

/// Reads the keys that obstacles and chains share.
void read_surface(Scene& scene, const Section& section, Obstacle& obstacle) {
    read_layers(scene, section, obstacle.layers);
    section.read("restitution", obstacle.restitution);
    section.read("friction", obstacle.friction);
    check_obstacle(scene, section, "friction", obstacle);
    section.read("belt", obstacle.belt);
    check_obstacle(scene, section, "belt", obstacle);
    section.read("velocity", obstacle.velocity);
    check_obstacle(scene, section, "velocity", obstacle);
    read_swing(scene, section, obstacle);
    section.read("one_way", obstacle.one_way);
    check_obstacle(scene, section, "one_way", obstacle);
}

void check_points(const Scene& scene, const Section& section, const SceneChain& chain) {
    const std::size_t fewest = chain.closed ? 3 : 2;
    if (chain.points.size() < fewest)
        refuse(section.place("points"), "chain.points: expected at least {} points{}, got {}",
               fewest, chain.closed ? " of a closed chain" : "", chain.points.size());
    for (const Obstacle& segment : segments_of(chain))
        check_obstacle(scene, section, "points", segment);
}

/// Tiles are placed by bytes: a character of several bytes would be several tiles.
void check_rows(const Section& section, const SceneTiles& tiles) {
    bool has_tile = false;
    for (const std::string& row : tiles.rows)
        for (const char c : row) {
            if (static_cast<unsigned char>(c) > '~')
                refuse(section.place("rows"), "tiles.rows: byte 0x{:02x}; expected ASCII text",
                       static_cast<unsigned char>(c));
            has_tile = has_tile || is_tile(c);
        }
    if (!has_tile)
        refuse(section.place("rows"),
               "tiles.rows: no tile; give a character other than a space and a full stop");
    for (const char c : tiles.one_way)
        if (std::ranges::none_of(tiles.rows, [&](const std::string& row) {
                return is_tile(c) && row.find(c) != std::string::npos;
            }))
            refuse(section.place("one_way"), "tiles.one_way: no tile is \"{}\"; leave it out",
                   printable(std::string(1, c)));
}

}  // namespace

std::uint32_t read_meets(const Scene& scene, const Section& section) {
    if (!section.has("meets")) return ~0U;
    if (!section.has("contact"))
        refuse(section.place("meets"), "{}.meets: without a contact; give `contact`, its radius",
               section.name());
    std::uint32_t meets = 0;
    for (const std::string& name : read_names(section, "meets", "leave `contact` out")) {
        const auto found = std::ranges::find(scene.layers, name);
        if (found == scene.layers.end()) {
            const std::vector<std::string_view> known(scene.layers.begin(), scene.layers.end());
            const std::string near = did_you_mean(name, known);
            refuse(
                section.place("meets"), "{}.meets: no obstacle is in the layer \"{}\"{}",
                section.name(), printable(name),
                near.empty() ? fmt::format("; give one layers = [\"{}\"]", printable(name)) : near);
        }
        meets |= 1U << static_cast<unsigned>(found - scene.layers.begin());
    }
    return meets;
}

ScenePlane read_plane(Scene& scene, const Section& section) {
    ScenePlane read;
    section.read("name", read.name);
    section.read("normal", read.plane.normal);
    section.read("offset", read.plane.offset);
    section.read("restitution", read.plane.restitution);
    section.read("friction", read.plane.friction);
    read_layers(scene, section, read.layers);
    section.read("colour", read.colour);
    check_plane(scene, section, read.plane);
    return read;
}

SceneObstacle read_obstacle(Scene& scene, const Section& section) {
    SceneObstacle read;
    section.read("name", read.name);
    read.obstacle.shape = ShapeReader(scene, section).run();
    read_surface(scene, section, read.obstacle);
    section.read("solid", read.obstacle.solid);
    section.read("colour", read.colour);
    return read;
}

SceneChain read_chain(Scene& scene, const Section& section) {
    SceneChain chain;
    section.read("name", chain.name);
    section.read("points", chain.points);
    section.read("closed", chain.closed);
    check_points(scene, section, chain);
    chain.like = segments_of(chain).front();
    read_surface(scene, section, chain.like);
    section.read("colour", chain.colour);
    return chain;
}

SceneTiles read_tiles(Scene& scene, const Section& section) {
    if (scene.axes == 1)
        refuse(section.place(), "tiles: expected two axes or three, got one; give axes = 2");
    SceneTiles tiles;
    section.read("name", tiles.name);
    section.read("origin", tiles.origin);
    check_numbers(scene, section, "origin", tiles.origin);
    section.read("tile", tiles.tile);
    section.read("rows", tiles.rows);
    section.read("one_way", tiles.one_way);
    check_rows(section, tiles);
    section.read("restitution", tiles.restitution);
    section.read("friction", tiles.friction);
    read_layers(scene, section, tiles.layers);
    section.read("colour", tiles.colour);
    for (const Obstacle& box : boxes_of(tiles, scene.axes)) {
        Obstacle smooth = box;
        smooth.friction = 0;
        check_obstacle(scene, section, "tile", smooth);
        check_obstacle(scene, section, "friction", box);
    }
    return tiles;
}

}  // namespace oiler
