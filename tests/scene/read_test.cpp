// SPDX-License-Identifier: MIT
#include "oiler/scene/read.hpp"

#include <sys/stat.h>

#include <filesystem>

#include "oiler/scene/draw.hpp"
#include "oiler/scene/keys.hpp"
#include "oiler/scene/make_world.hpp"
#include "scene/everything.hpp"
#include "support/folder.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double none = 0;

Scene parsed(const std::string& text) { return parse_scene(text, "test.toml"); }

std::string name_of(const SceneKey& key) {
    return std::string(key.table) + "." + std::string(key.name);
}

bool is(const SceneKey& key, std::string_view table, std::string_view name) {
    return key.table == table && key.name == name;
}

/// A valid value that differs from the one in `everything`.
std::string other_value(const SceneKey& key) {
    if (key.name == "body") return key.table == "drive" ? "\"a\"" : "\"c\"";
    if (is(key, "spring", "to")) return "\"c\"";
    if (is(key, "scene", "method")) return "\"rk4\"";
    if (is(key, "scene", "precision")) return "\"float\"";
    if (is(key, "scene", "damping")) return "\"drift\"";
    if (is(key, "grid", "hang")) return "\"top\"";
    if (is(key, "chain", "closed") || is(key, "spring", "pulls_only")) return "true";
    if (is(key, "tiles", "one_way")) return "\"#\"";
    if (key.name == "meets") return "[\"solid\"]";
    if (key.name == "layers") return "[\"out of reach\"]";
    switch (key.kind) {
        case KeyKind::text:
            return "\"other\"";
        case KeyKind::whole:
            return "2";
        case KeyKind::number:
            return "0.75";
        case KeyKind::flag:
            return "false";
        case KeyKind::vector:
            return "[0.625, 0.125]";
        case KeyKind::points:
            return "[[0.0, 0.25], [0.125, 0.75]]";
        case KeyKind::lines:
            return "[\"=#\", \"#\"]";
        case KeyKind::counts:
            return "[2, 3]";
        case KeyKind::word:
        case KeyKind::colour:
            break;
    }
    return "\"#123456\"";
}

/// State hash and picture of the scene after three steps.
struct Shown {
    std::uint64_t state_hash;
    Picture picture;
};

Shown shown(const Scene& scene) {
    World world = make_world(scene, Settings{scene.stepping});
    const Camera camera = camera_of(scene, world);
    SceneTrails trails(scene, world);
    for (int step = 0; step < 3; ++step) {
        world.step();
        trails.sample(world);
    }
    return {world.state_hash(), draw_scene(scene, world, camera, trails)};
}

bool look_the_same(const Picture& a, const Picture& b) {
    const auto same_disc = [](const Disc& one, const Disc& other) {
        return one.centre == other.centre && one.radius == other.radius &&
               one.colour == other.colour;
    };
    const auto same_line = [](const Polyline& one, const Polyline& other) {
        return one.points == other.points && one.colour == other.colour;
    };
    const auto same_polygon = [](const Polygon& one, const Polygon& other) {
        return one.points == other.points && one.colour == other.colour;
    };
    return a.background == b.background && a.camera.centre == b.camera.centre &&
           a.camera.height == b.camera.height && a.labels.at(0).text == b.labels.at(0).text &&
           std::ranges::equal(a.discs, b.discs, same_disc) &&
           std::ranges::equal(a.polygons, b.polygons, same_polygon) &&
           std::ranges::equal(a.polylines, b.polylines, same_line);
}

/// Keys without effect on the state or the picture: they limit a run, are for messages, or make a
/// rope of a spring that is longer than at rest.
bool shows_nothing(const SceneKey& key) {
    return key.table == "budget" || key.name == "duration" || key.name == "pulls_only" ||
           (key.name == "name" && key.table != "body");
}
/// Keys that springs refer to, or on which other keys depend.
bool cannot_change_alone(const SceneKey& key) {
    return is(key, "body", "name") || is(key, "scene", "axes") || is(key, "obstacle", "shape");
}
/// Keys that a table may have to have, as others say.
bool is_needed_by_some(const SceneKey& key) {
    constexpr std::array<std::string_view, 5> of_shapes{"centre", "radius", "size", "from", "to"};
    return is(key, "spring", "anchor") || is(key, "spring", "to") || key.name == "swing" ||
           key.name == "contact" ||
           (key.table == "obstacle" && std::ranges::count(of_shapes, key.name) > 0);
}

TEST(Read, ReadsTheStepping) {
    const Stepping given =
        parse_scene(
            "[scene]\naxes = 1\nrate = 240\nmethod = 'rk4'\nprecision = 'float'\n"
            "damping = 'kick'\n[[body]]\n",
            "test.toml")
            .stepping;
    EXPECT_EQ(given, (Stepping{&find_method("rk4"), {240}, Precision::single, Damping::in_kick}));
    const Stepping own = parse_scene("[scene]\naxes = 1\n[[body]]\n", "test.toml").stepping;
    EXPECT_EQ(own, (Stepping{&find_method("semi_implicit_euler"), {100}, Precision::double_, {}}));
}

TEST(Read, EveryKeyHasAnEffect) {
    // A scale of speeds has the bodies' own colours only where it is absent.
    const std::string coloured = altered(everything, "view", "fastest", "");
    for (const SceneKey& key : scene_keys()) {
        if (cannot_change_alone(key)) continue;
        const std::string& text = key.name == "colour" ? coloured : everything;
        const Scene scene = parsed(text);
        const Scene other = parsed(altered(text, key.table, key.name, other_value(key)));
        EXPECT_FALSE(scene == other) << name_of(key);
        if (shows_nothing(key)) continue;
        const Shown before = shown(scene);
        const Shown after = shown(other);
        EXPECT_FALSE(before.state_hash == after.state_hash &&
                     look_the_same(before.picture, after.picture))
            << name_of(key);
    }
}

TEST(Read, EveryDefaultIsThatOfTheList) {
    for (const SceneKey& key : scene_keys()) {
        if (key.required() || is(key, "body", "name") || is_needed_by_some(key)) continue;
        const Scene without = parsed(altered(everything, key.table, key.name, ""));
        const Scene with = parsed(altered(everything, key.table, key.name, key.value));
        EXPECT_EQ(without == with, key.absent.empty()) << name_of(key);
    }
}

// The reader finds the numbers of a force by the keys of its fields.
TEST(Read, TablesOfForcesHaveTheKeysOfTheirFields) {
    int tables = 0;
    for_each_index<force_count>([&](auto kind) {
        using Force = std::tuple_element_t<kind, ForceList<double, 3>>;
        std::vector<std::string_view> of_fields{"body"};
        for_each_field<Force>([&](const auto& field) { of_fields.push_back(field.key); });
        std::vector<std::string_view> keys;
        for (const SceneKey& key : scene_keys())
            if (key.table == Force::name) keys.push_back(key.name);
        if (keys.empty() || !scene_table(Force::name).is_force()) return;
        EXPECT_EQ(keys, of_fields);
        ++tables;
    });
    EXPECT_EQ(tables, std::ranges::count(scene_tables(), true, &SceneTable::is_force));
}

TEST(Read, EveryRangeIsThatOfTheList) {
    for (const SceneKey& key : scene_keys()) {
        const bool bounded = key.range.low > -1e300;
        if (!bounded || (key.kind != KeyKind::number && key.kind != KeyKind::whole)) continue;
        if (is(key, "scene", "axes")) continue;
        const auto read = [&](const std::string& value) {
            (void)parsed(altered(everything, key.table, key.name, value));
        };
        const std::string low = key.kind == KeyKind::whole ? fmt::format("{:.0f}", key.range.low)
                                                           : fmt::format("{}", key.range.low);
        if (key.range.without_low)
            EXPECT_TRUE(holds(line_of_error(Exit::usage, [&] { read(low); }), name_of(key)));
        else
            EXPECT_NO_THROW(read(low)) << name_of(key);
        const std::string below = key.kind == KeyKind::whole
                                      ? fmt::format("{:.0f}", key.range.low - 1)
                                      : fmt::format("-{}", 1e-300);
        EXPECT_TRUE(holds(line_of_error(Exit::usage, [&] { read(below); }), name_of(key)));
    }
}

void expect_obstacles(const Scene& scene) {
    Obstacle surface{.restitution = 0.5,
                     .friction = 0.3,
                     .belt = 0.5,
                     .velocity = {0.1, -0.2},
                     .swing = Swing{{0.001, 0.0005}, 20, 0.2},
                     .one_way = Vec3{0, -1},
                     .layers = 1 << 2};
    surface.shape = CircleShape{{-0.7, 1.2313}, 0.3};
    surface.friction = 0.03;
    EXPECT_EQ(scene.obstacles,
              (std::vector<SceneObstacle>{
                  {"peg", surface, palette::green},
                  {"", {.shape = BoxShape{{-3, -1}, {1, 0.5}, 0.5}, .layers = 31}, palette::grey},
                  {"", {.shape = SegmentShape{{-3, 1}, {-2, 1.5}}}, palette::grey}}));
    surface.shape = SegmentShape{{0, 0.3}, {0.02, 0.8}};
    surface.one_way = Vec3{-1, 0};
    surface.friction = 0.3;
    surface.layers = 1 << 3;
    EXPECT_EQ(scene.chains,
              (std::vector<SceneChain>{
                  {"hill", {{0, 0.3}, {0.02, 0.8}, {1, 1}}, false, surface, palette::green}}));
    EXPECT_EQ(scene.tiles, (std::vector<SceneTiles>{{"rock",
                                                     {-0.35, -0.0624},
                                                     0.2,
                                                     {"##......=", ". "},
                                                     "=",
                                                     0.5,
                                                     0.3,
                                                     1 << 4,
                                                     palette::green}}));
    EXPECT_EQ(
        scene.planes,
        (std::vector<ScenePlane>{{"wall", {{-1, 0.25}, -0.5, 0.5, 0.3}, 1 << 1, palette::green}}));
    EXPECT_EQ(scene.layers, (std::vector<std::string>{"solid", "front", "pegs", "slope", "level"}));
}

TEST(Read, ReadsEveryValueOfAFile) {
    const Scene scene = parsed(everything);
    EXPECT_EQ(scene.title, "Everything");
    EXPECT_EQ(scene.axes, 2);
    EXPECT_EQ(scene.stepping.rate.steps, 100);
    EXPECT_EQ(scene.stepping.method->name, "velocity_verlet");
    EXPECT_EQ(scene.stepping.precision, Precision::double_);
    EXPECT_EQ(scene.stepping.damping, Damping::in_kick);
    EXPECT_EQ(scene.duration, 4);
    EXPECT_EQ(scene.gravity, (Vec3{0.5, -9.81}));
    ASSERT_EQ(scene.bodies.size(), 3U);
    EXPECT_EQ(scene.bodies[0].name, "a");
    EXPECT_EQ(scene.bodies[0].matter.mass, 1.5);
    EXPECT_EQ(scene.bodies[0].matter.linear_drag, 0.1);
    EXPECT_EQ(scene.bodies[0].matter.quadratic_drag, 0.2);
    EXPECT_EQ(scene.bodies[0].matter.contact, 0.25);
    EXPECT_EQ(scene.bodies[0].matter.meets, 2U | 4 | 8 | 16);
    EXPECT_EQ(scene.bodies[1].matter.contact, std::nullopt);
    EXPECT_EQ(scene.bodies[1].matter.meets, ~0U);
    expect_obstacles(scene);
    EXPECT_EQ(scene.bodies[0].matter.radius, 0.3);
    EXPECT_EQ(scene.bodies[0].matter.colour, palette::orange);
    EXPECT_EQ(scene.bodies[0].position, (Vec3{0.5, 0.25}));
    EXPECT_EQ(scene.bodies[0].velocity, (Vec3{1, 2}));
    EXPECT_EQ(scene.springs[0], (SceneSpring{.body = 0,
                                             .anchor = {0, 1},
                                             .stiffness = 15,
                                             .damping = 0.1,
                                             .rest_length = 0.4,
                                             .colour = palette::green}));
    EXPECT_EQ(scene.springs[1].to, 1U);
    EXPECT_EQ(scene.forces,
              (std::vector<SceneForce>{{1, Wind{.velocity = {4, -1}, .coefficient = 0.3}},
                                       {2, Drive{{6, 0.5}, 2.5, 0.5}}}));
    EXPECT_EQ(
        scene.attractors[0],
        (SceneAttractor{.position = {5, 5}, .gm = 2, .colour = palette::black, .radius = 0.2}));
    EXPECT_EQ(scene.grids[0].count, (std::array<std::int64_t, 2>{3, 2}));
    EXPECT_EQ(scene.grids[0].origin, (Vec3{6, 0}));
    EXPECT_EQ(scene.grids[0].rest_length, 0.8);
    EXPECT_EQ(scene.grids[0].hang, Hang::corners);
    EXPECT_EQ(scene.scatters[0].position_from, (Vec3{-1, 0}));
    EXPECT_EQ(scene.scatters[0].position_to, (Vec3{1, 2}));
    EXPECT_EQ(scene.scatters[0].velocity_to, (Vec3{3, 4}));
    EXPECT_EQ(scene.scatters[0].seed, 7);
    EXPECT_EQ(scene.camera.centre, (Vec3{1, 1}));
    EXPECT_EQ(scene.budget, (SceneBudget{1.0, 0.01}));
    EXPECT_EQ(scene.body_count(), 3 + 6 + 3);
}

// Its obstacles are a plane, a circle, a box, a segment, a chain of two segments, and three tiles.
TEST(Read, NamesObstaclesInTheOrderOfTheWorld) {
    const Scene scene = parsed(everything);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < 9; ++i) names.push_back(scene.name_of_obstacle(i));
    EXPECT_EQ(names, (std::vector<std::string>{"wall", "peg", "obstacle 2", "obstacle 3", "hill 1",
                                               "hill 2", "rock 1", "rock 2", "rock 3"}));
    EXPECT_EQ(scene.name_of_obstacle(9), "obstacle 9");
}

TEST(Read, ASceneHas32Layers) {
    std::string text = "[scene]\naxes = 2\n[[body]]\ncontact = 0.5\nmeets = [\"layer 31\"]\n";
    for (int i = 1; i < 32; ++i)
        text += fmt::format("[[plane]]\nnormal = [0, 1]\nlayers = [\"layer {}\"]\n", i);
    const Scene scene = parsed(text);
    EXPECT_EQ(scene.planes.back().layers, 1U << 31);
    EXPECT_EQ(scene.bodies[0].matter.meets, 1U << 31);
    const std::string more = "[[plane]]\nnormal = [0, 1]\nlayers = [\"layer 32\"]\n";
    EXPECT_EQ(line_of_error(Exit::usage, [&] { (void)parsed(text + more); }),
              "test.toml:101: plane.layers: \"layer 32\" and \"solid\" are more than 32 layers; "
              "give fewer");
}

TEST(Read, ReadsASceneOfTwoTables) {
    const Scene scene = parsed("[scene]\naxes = 3\n[[body]]\n");
    Scene expected;
    expected.axes = 3;
    expected.bodies.resize(1);
    EXPECT_EQ(scene, expected);
    EXPECT_EQ(scene.bodies[0].matter.mass, 1);
    EXPECT_EQ(scene.bodies[0].matter.linear_drag, none);
    EXPECT_FALSE(scene.gravity);
}

TEST(Read, ReadsEquivalentTomlAsTheSameScene) {
    const Scene scene = parsed(
        "scene.axes = 1\nscene.rate = 1_000\n"
        "body = [{ name = 'a', mass = 2 }, { name = \"\\u00e9\", colour = \"#0072B2\" }]\n"
        "# brackets [[[ and dots .................................... in a comment\n"
        "spring = [{ body = 'a', to = \"\\u00e9\", stiffness = 1e1 }]\r\n");
    EXPECT_EQ(scene.stepping.rate.steps, 1000);
    EXPECT_EQ(scene.bodies[0].matter.mass, 2);
    EXPECT_EQ(scene.bodies[1].name, "é");
    EXPECT_EQ(scene.bodies[1].matter.colour, palette::blue);
    EXPECT_EQ(scene.springs[0].to, 1U);
    EXPECT_EQ(scene.springs[0].stiffness, 10);
}

TEST(Read, ASpringMayComeBeforeItsBodies) {
    const Scene scene = parsed(
        "[scene]\naxes = 1\n[[spring]]\nbody = 'a'\nanchor = [0]\nstiffness = 1\n"
        "[[body]]\nname = 'b'\n[[body]]\nname = 'a'\n");
    EXPECT_EQ(scene.springs[0].body, 1U);
}

TEST(Read, ReadsAFileAtTheLimitsOfBytesAndBodies) {
    std::string text =
        "[scene]\naxes = 2\n[[grid]]\ncount = [1000, 1000]\nspacing = 1\nstiffness = 1\n#";
    text.resize(64 * 1024, '#');
    EXPECT_EQ(parsed(text).body_count(), 1'000'000);
}

TEST(Read, CountsNestingAndDotsAsTomlDoes) {
    const auto line = [](const std::string& text) {
        return line_of_error(Exit::usage, [&] { (void)parsed(text); });
    };
    const std::string start = "[scene]\naxes = 1\n[[body]]\n";
    // At the limits the guard lets them through, and the reader refuses the values and keys.
    EXPECT_TRUE(holds(line(start + "position = " + std::string(64, '[') + std::string(64, ']')),
                      "body.position"));
    EXPECT_TRUE(holds(line(start + "position = " + std::string(65, '[') + std::string(65, ']')),
                      "deeper than 64"));
    std::string parts = "x";
    for (int i = 0; i < 32; ++i) parts += ".x";
    EXPECT_TRUE(holds(line(start + parts + " = 1"), "body.x: [body] has no such key"));
    EXPECT_TRUE(holds(line(start + parts + ".x = 1"), "more than 32 parts"));
    EXPECT_TRUE(holds(line(start + "position = [1.5, \"" + parts + parts + "\"]"), "a list of 2"));
}

TEST(Read, RefusesANumberTooLargeForTheColumnsWithItsLine) {
    const std::string text = altered(everything, "body", "position", "[1e39, 0]");
    EXPECT_NO_THROW((void)parsed(text));
    const std::string line = line_of_error(
        Exit::usage, [&] { (void)parsed(altered(text, "scene", "precision", "\"float\"")); });
    EXPECT_TRUE(holds(line, "test.toml:17: body.position: position of 1e+39"));
}

TEST(ReadFile, NamesAPathThatIsNotAFile) {
    const Folder folder;
    for (const std::string& path :
         {folder.path().string(), std::string("/dev/zero"), (folder / "none.toml").string()}) {
        const std::string line = line_of_error(Exit::usage, [&] { (void)read_scene(path); });
        EXPECT_TRUE(holds(line, path + ": "));
    }
}

TEST(ReadFile, DoesNotWaitForAPipe) {
    const Folder folder;
    const std::string path = (folder / "pipe").string();
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    EXPECT_TRUE(holds(line_of_error(Exit::usage, [&] { (void)read_scene(path); }), "not a file"));
}

TEST(ReadFile, ReadsAllScenesOfTheRepository) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(OILER_SOURCE "/assets/scenes")) {
        if (entry.path().extension() != ".toml") continue;
        const Scene scene = read_scene(entry.path().string());
        EXPECT_GE(scene.body_count(), 1) << entry.path();
        EXPECT_NE(scene.title, "") << entry.path();
        ++count;
    }
    EXPECT_GE(count, 10);
}

}  // namespace
}  // namespace oiler::test
