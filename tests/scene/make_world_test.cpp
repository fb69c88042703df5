// SPDX-License-Identifier: MIT
#include "oiler/scene/make_world.hpp"
#include "oiler/core/random.hpp"
#include "oiler/scene/draw.hpp"
#include "oiler/scene/read.hpp"
#include "scene/everything.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

Scene parsed(const std::string& text) { return parse_scene(text, "test.toml"); }

World world_of(const std::string& text) {
    const Scene scene = parsed(text);
    return make_world(scene, Settings{scene.stepping});
}

template <class Force>
std::optional<Force> force_on(const World& world, std::size_t row, std::size_t index = 0) {
    return std::get<std::optional<Force>>(world.bodies().forces_per_mass(row, index));
}

TEST(MakeWorld, OrdersRowsAsTheSceneDoes) {
    const World world = world_of(everything);
    const Bodies& bodies = world.bodies();
    ASSERT_EQ(bodies.size(), 12U);
    EXPECT_EQ(bodies.position(0), (Vec3{0.5, 0.25}));
    EXPECT_EQ(bodies.velocity(0), (Vec3{1, 2}));
    EXPECT_EQ(bodies.mass(0), 1.5);
    EXPECT_EQ(bodies.position(2), (Vec3{3, 1}));
    EXPECT_EQ(bodies.position(3), (Vec3{6, 0}));
    EXPECT_EQ(bodies.position(4), (Vec3{7, 0}));
    EXPECT_EQ(bodies.position(6), (Vec3{6, 1}));
    EXPECT_EQ(bodies.position(8), (Vec3{8, 1}));
    EXPECT_EQ(bodies.velocity(8), (Vec3{0, 1}));
    EXPECT_EQ(bodies.mass(8), 0.5);
    for (std::size_t row = 9; row < 12; ++row) {
        for (int i = 0; i < 2; ++i) {
            EXPECT_GE(bodies.position(row)[i], i == 0 ? -1 : 0);
            EXPECT_LT(bodies.position(row)[i], i == 0 ? 1 : 2);
            EXPECT_GE(bodies.velocity(row)[i], 0);
            EXPECT_LT(bodies.velocity(row)[i], i == 0 ? 3 : 4);
        }
    }
}

// Also to an anchor: the body then has no force of its own.
TEST(MakeWorld, LinksBodiesByRopes) {
    const World world = world_of(
        "[scene]\naxes = 2\n[[body]]\nname = 'a'\n[[body]]\nname = 'b'\nposition = [1, 0]\n"
        "[[spring]]\nbody = 'a'\nanchor = [0, 3]\nstiffness = 5\ndamping = 0.5\n"
        "rest_length = 2\npulls_only = true\n"
        "[[spring]]\nbody = 'a'\nto = 'b'\nstiffness = 6\nrest_length = 1.5\n"
        "pulls_only = true\n");
    const Bodies& bodies = world.bodies();
    ASSERT_EQ(bodies.link_count(), 2U);
    EXPECT_EQ(bodies.most_forces_of_a_kind(), 0U);
    EXPECT_EQ(bodies.link_ends(0), (LinkEnds{0, 1}));
    EXPECT_EQ(bodies.link_at(0).stiffness, 6);
    EXPECT_EQ(bodies.link_ends(1), (LinkEnds{0, std::nullopt, {0, 3}}));
    EXPECT_EQ(bodies.link_at(1).damping, 0.5);
    EXPECT_EQ(bodies.link_at(1).rest_length, 2);
    EXPECT_TRUE(bodies.link_at(0).pulls_only && bodies.link_at(1).pulls_only);
}

// Forces are stored per unit mass: 1.5 kg for the body, 0.5 kg in grid and scatter.
TEST(MakeWorld, GivesEachBodyTheForcesThatTheSceneNames) {
    const World world = world_of(everything);
    const auto coil = force_on<CoilSpring>(world, 0);
    ASSERT_TRUE(coil);
    EXPECT_EQ(coil->anchor, (Vec3{0, 1}));
    EXPECT_EQ(coil->stiffness, 15 / 1.5);
    EXPECT_EQ(coil->damping, 0.1 / 1.5);
    EXPECT_EQ(coil->rest_length, 0.4);
    for (const auto& [row, mass] : {std::pair{0, 1.5}, {3, 0.5}, {11, 0.5}}) {
        EXPECT_EQ(force_on<LinearDrag>(world, row)->coefficient, 0.1 / mass);
        EXPECT_EQ(force_on<QuadraticDrag>(world, row)->coefficient, 0.2 / mass);
        EXPECT_EQ(force_on<Attractor>(world, row)->gm, 2);
        EXPECT_EQ(force_on<Attractor>(world, row)->centre, (Vec3{5, 5}));
    }
    EXPECT_EQ(force_on<LinearDrag>(world, 1)->coefficient, 0);
    EXPECT_EQ(force_on<Wind>(world, 1), (Wind{{4, -1}, 0.3}));
    EXPECT_EQ(force_on<Wind>(world, 2)->coefficient, 0);
    EXPECT_EQ(force_on<Drive>(world, 2), (Drive{{6, 0.5}, 2.5, 0.5}));
    const Bodies& bodies = world.bodies();
    std::size_t link = bodies.link_count() - 2;
    for (const std::size_t hung : {6, 8}) {
        EXPECT_EQ(bodies.link_ends(link), (LinkEnds{hung, {}, bodies.position(hung)}));
        EXPECT_EQ(bodies.link_at(link).stiffness, 100);
        EXPECT_EQ(bodies.link_at(link).damping, 0.3);
        EXPECT_EQ(bodies.link_at(link++).rest_length, 0);
    }
}

TEST(MakeWorld, AddsNoUnusedForce) {
    const World world = world_of(
        "[scene]\naxes = 2\n[[body]]\n[[grid]]\ncount = [2, 2]\n"
        "spacing = 1\nstiffness = 1\n[[scatter]]\ncount = 2\n"
        "position_from = [0, 0]\nposition_to = [1, 1]\n");
    const bool any = std::apply([](const auto&... force) { return (force.has_value() || ...); },
                                world.bodies().forces_per_mass(0));
    EXPECT_FALSE(any);
}

TEST(MakeWorld, ABodyMayHaveSeveralSpringsAndSeveralAttractors) {
    const World world = world_of(
        "[scene]\naxes = 1\n[[body]]\nname = 'a'\n[[body]]\nname = 'b'\nposition = [9]\n"
        "[[spring]]\nbody = 'a'\nanchor = [1]\nstiffness = 2\n"
        "[[spring]]\nbody = 'b'\nanchor = [2]\nstiffness = 3\n"
        "[[spring]]\nbody = 'a'\nanchor = [3]\nstiffness = 4\n"
        "[[spring]]\nbody = 'a'\nanchor = [4]\nstiffness = 5\nrest_length = 1\n"
        "[[spring]]\nbody = 'a'\nanchor = [5]\nstiffness = 6\nrest_length = 2\n"
        "[[wind]]\nbody = 'b'\nvelocity = [1]\ndrag = 8\n"
        "[[wind]]\nbody = 'b'\nvelocity = [2]\ndrag = 9\n"
        "[[attractor]]\nposition = [-5]\ngm = 6\n[[attractor]]\nposition = [20]\ngm = 7\n");
    EXPECT_EQ(force_on<Spring>(world, 0, 0)->stiffness, 2);
    EXPECT_EQ(force_on<Spring>(world, 0, 1)->stiffness, 4);
    EXPECT_EQ(force_on<Spring>(world, 0, 1)->anchor, (Vec3{3}));
    EXPECT_EQ(force_on<CoilSpring>(world, 0, 0)->stiffness, 5);
    EXPECT_EQ(force_on<CoilSpring>(world, 0, 1)->stiffness, 6);
    EXPECT_EQ(force_on<Spring>(world, 1, 0)->stiffness, 3);
    EXPECT_EQ(force_on<Wind>(world, 1, 0)->coefficient, 8);
    EXPECT_EQ(force_on<Wind>(world, 1, 1), (Wind{{2}, 9}));
    for (const std::size_t row : {0, 1}) {
        EXPECT_EQ(force_on<Attractor>(world, row, 0)->gm, 6);
        EXPECT_EQ(force_on<Attractor>(world, row, 1)->gm, 7);
        EXPECT_EQ(force_on<Attractor>(world, row, 1)->centre, (Vec3{20}));
    }
}

TEST(MakeWorld, LinksBodies) {
    const World world = world_of(everything);
    EXPECT_EQ(world.bodies().link_ends(0), (LinkEnds{0, 1}));
    EXPECT_EQ(world.bodies().link_at(0).stiffness, 15);
    EXPECT_EQ(world.bodies().link_at(0).rest_length, 0);
}

// 3 × 2 bodies: 0 1 2 below, 3 4 5 above.
TEST(MakeWorld, LinksAGridRowByRowAndKindByKind) {
    const World world = world_of(
        "[scene]\naxes = 2\n[[grid]]\ncount = [3, 2]\nspacing = 0.5\nstiffness = 7\n"
        "damping = 0.25\ndiagonals = true\n");
    const std::vector<std::array<std::size_t, 2>> expected{
        {0, 1}, {1, 2}, {3, 4}, {4, 5}, {0, 3}, {1, 4}, {2, 5}, {0, 4}, {1, 5}, {1, 3}, {2, 4}};
    const Bodies& bodies = world.bodies();
    ASSERT_EQ(bodies.link_count(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(bodies.link_ends(i), (LinkEnds{expected[i][0], expected[i][1]})) << i;
        EXPECT_EQ(bodies.link_at(i).stiffness, 7);
        EXPECT_EQ(bodies.link_at(i).damping, 0.25);
        EXPECT_EQ(bodies.link_at(i).rest_length, i < 7 ? 0.5 : 0.5 * std::sqrt(2.0)) << i;
    }
    EXPECT_NEAR(bodies.energy().potential, 0, 1e-30);
}

// The diagonal of a square of springs at their rest length.
TEST(MakeWorld, AGridOfStretchedSpringsHasDiagonalsOfTheirRestLength) {
    const World world = world_of(
        "[scene]\naxes = 2\n[[grid]]\ncount = [2, 2]\nspacing = 0.5\nrest_length = 0.25\n"
        "stiffness = 7\ndiagonals = true\n");
    ASSERT_EQ(world.bodies().link_count(), 6U);
    EXPECT_EQ(world.bodies().link_at(0).rest_length, 0.25);
    EXPECT_EQ(world.bodies().link_at(5).rest_length, 0.25 * std::sqrt(2.0));
}

TEST(MakeWorld, AGridWithoutDiagonalsHasNone) {
    EXPECT_EQ(world_of("[scene]\naxes = 2\n[[grid]]\ncount = [4, 3]\nspacing = 1\nstiffness = 1\n")
                  .bodies()
                  .link_count(),
              3U * 3 + 4U * 2);
    EXPECT_EQ(world_of("[scene]\naxes = 1\n[[grid]]\ncount = [4]\nspacing = 1\nstiffness = 1\n")
                  .bodies()
                  .link_count(),
              3U);
}

TEST(Grid, AnchorsNoneCornersOrTop) {
    using Nodes = std::vector<std::size_t>;
    SceneGrid grid{.count = {3, 2}};
    EXPECT_EQ(anchored_nodes(grid), Nodes{});
    grid.hang = Hang::top;
    EXPECT_EQ(anchored_nodes(grid), (Nodes{3, 4, 5}));
    grid.hang = Hang::corners;
    EXPECT_EQ(anchored_nodes(grid), (Nodes{3, 5}));
    grid.count = {1, 4};
    EXPECT_EQ(anchored_nodes(grid), Nodes{3});
}

// The published first number of SplitMix64 from seed 0.
TEST(Random, IsSplitMix64) {
    EXPECT_EQ(Random(0).next(), 0xe220a8397b1dcdafU);
    EXPECT_EQ(Random(0).fraction(),
              static_cast<double>(0xe220a8397b1dcdafU >> 11) / 9007199254740992.0);
    Random random(1);
    double least = 1;
    double most = 0;
    double sum = 0;
    constexpr int count = 1'000'000;
    for (int i = 0; i < count; ++i) {
        const double u = random.fraction();
        least = std::min(least, u);
        most = std::max(most, u);
        sum += u;
    }
    // The mean of n uniform numbers has a standard deviation of 1/√(12·n); the bound is six of
    // them. The ends are missed by 1/n on average, and by 20/n with a probability of e^(−20).
    EXPECT_NEAR(sum / count, 0.5, 6 / std::sqrt(12.0 * count));
    EXPECT_LT(least, 20.0 / count);
    EXPECT_GT(most, 1 - 20.0 / count);
    EXPECT_GE(least, 0);
    EXPECT_LT(most, 1);
}

const std::string scatter =
    "[scene]\naxes = 2\n[[scatter]]\ncount = 2\nseed = 0\nposition_from = [-1, 2]\n"
    "position_to = [1, 2]\nvelocity_from = [0, 0]\nvelocity_to = [0, 8]\n";

TEST(MakeWorld, ScattersByTheSeed) {
    const World world = world_of(scatter);
    Random random(0);
    for (std::size_t row = 0; row < 2; ++row) {
        EXPECT_EQ(world.bodies().position(row)[0], -1 + 2 * random.fraction());
        EXPECT_EQ(world.bodies().position(row)[1], 2 + 0 * random.fraction());
        EXPECT_EQ(world.bodies().velocity(row)[0], 0 * random.fraction());
        EXPECT_EQ(world.bodies().velocity(row)[1], 8 * random.fraction());
    }
}

TEST(MakeWorld, AnotherSeedOfTheSceneOrOfTheRunScattersDifferently) {
    const Scene scene = parsed(scatter);
    Settings settings = Settings{scene.stepping};
    const std::uint64_t first = make_world(scene, settings).state_hash();
    EXPECT_EQ(make_world(scene, settings).state_hash(), first);
    settings.seed = 1;
    const std::uint64_t second = make_world(scene, settings).state_hash();
    EXPECT_NE(second, first);
    settings.seed = 0;
    const Scene other = parsed(altered(scatter, "scatter", "seed", "1"));
    const std::uint64_t third = make_world(other, settings).state_hash();
    EXPECT_NE(third, first);
    EXPECT_NE(third, second);
}

// A run with seed 0 keeps the seeds of the scene.
TEST(MakeWorld, ASceneWithTheSeedOfARunScattersAsTheRunDoes) {
    const Scene scene = parsed(altered(scatter, "scatter", "seed", "5"));
    static_assert(Random::mixed(0) == 0);
    EXPECT_EQ(with_seed(scene, 0).scatters[0].seed, 5);
    for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}}) {
        Settings settings = Settings{scene.stepping};
        const std::uint64_t of_scene = make_world(with_seed(scene, seed), settings).state_hash();
        settings.seed = seed;
        EXPECT_EQ(of_scene, make_world(scene, settings).state_hash()) << seed;
    }
}

TEST(MakeWorld, TheSeedOfARunChangesEveryScatter) {
    const Scene scene =
        parsed(scatter +
               "[[scatter]]\ncount = 3\nseed = 7\nposition_from = [0, 0]\nposition_to = [1, 1]\n");
    const Scene changed = with_seed(scene, 9);
    EXPECT_NE(changed.scatters[0].seed, scene.scatters[0].seed);
    EXPECT_NE(changed.scatters[1].seed, scene.scatters[1].seed);
}

TEST(MakeWorld, TakesThePrecisionOfTheRun) {
    const Scene scene = parsed(scatter);
    Settings settings = Settings{scene.stepping};
    settings.stepping.precision = Precision::single;
    EXPECT_EQ(make_world(scene, settings).bodies().precision(), Precision::single);
    const Scene far = parsed(altered(scatter, "scatter", "position_from", "[-1e39, 2]"));
    EXPECT_TRUE(holds(line_of_error(Exit::usage, [&] { (void)make_world(far, settings); }),
                      "a position of -"));
}

std::vector<Obstacle> obstacles_in(const World& world) {
    std::vector<Obstacle> all;
    for (const ObstacleHandle handle : world.bodies().obstacles())
        all.push_back(world.bodies().obstacle(handle));
    return all;
}

const std::string obstacle_scene = "[scene]\naxes = 2\n[[body]]\nposition = [0, 9]\n";

// A triangle has three sides, an open chain of three points two.
TEST(MakeWorld, AChainIsItsSegments) {
    for (const bool closed : {false, true}) {
        const std::string text = obstacle_scene +
                                 "[[chain]]\npoints = [[0, 0], [4, 0], [0, 3]]\nfriction = 0.25\n" +
                                 (closed ? "closed = true\n" : "");
        const std::vector<Obstacle> sides = obstacles_in(world_of(text));
        std::vector<Shape> expected{SegmentShape{{0, 0}, {4, 0}}, SegmentShape{{4, 0}, {0, 3}}};
        if (closed) expected.emplace_back(SegmentShape{{0, 3}, {0, 0}});
        ASSERT_EQ(sides.size(), expected.size());
        for (std::size_t i = 0; i < sides.size(); ++i)
            EXPECT_EQ(sides[i], (Obstacle{.shape = expected[i], .friction = 0.25})) << i;
    }
}

TEST(MakeWorld, TilesAreBoxesFromTheTopRowOn) {
    const World world = world_of(obstacle_scene +
                                 "[[tiles]]\norigin = [10, -1]\ntile = 0.5\n"
                                 "rows = [\"x\", \" =.\", \"#. x\"]\none_way = \"=\"\n"
                                 "restitution = 0.75\n");
    const auto tile = [](double x, double y, bool one_way) {
        Obstacle box{.shape = BoxShape{.centre = {x, y}, .size = {0.5, 0.5}}, .restitution = 0.75};
        if (one_way) box.one_way = Vec3{0, 1};
        return box;
    };
    EXPECT_EQ(obstacles_in(world),
              (std::vector<Obstacle>{tile(10.25, 0.25, false), tile(10.75, -0.25, true),
                                     tile(10.25, -0.75, false), tile(11.75, -0.75, false)}));
}

TEST(MakeWorld, TilesWithThreeAxesAreCubes) {
    const World world = world_of(
        "[scene]\naxes = 3\n[[body]]\n[[tiles]]\norigin = [0, 0, 5]\ntile = 2\nrows = [\"#\"]\n");
    EXPECT_EQ(obstacles_in(world),
              (std::vector<Obstacle>{{.shape = BoxShape{.centre = {1, 1, 6}, .size = {2, 2, 2}}}}));
}

TEST(MakeWorld, OrdersObstaclesByTables) {
    const std::vector<Obstacle> all = obstacles_in(world_of(everything));
    std::vector<std::size_t> kinds;
    for (const Obstacle& one : all) kinds.push_back(one.shape.index());
    const std::vector<std::size_t> plane_circle_box_segment_chain_tiles{0, 1, 3, 2, 2, 2, 3, 3, 3};
    EXPECT_EQ(kinds, plane_circle_box_segment_chain_tiles);
}

// A ball of radius 0.25 m falls 1 m from rest onto a tile of top 0.5 m, which returns half of its
// speed: it rises to a quarter of the height, after 3/2 of the time of its fall.
TEST(MakeWorld, BodiesBounceOffTiles) {
    World world = world_of(
        "[scene]\naxes = 2\nrate = 200\nmethod = 'velocity_verlet'\n[gravity]\n"
        "acceleration = [0, -8]\n[[body]]\nposition = [0.75, 1.75]\ncontact = 0.25\n"
        "[[tiles]]\ntile = 0.5\nrows = [\"##\"]\nrestitution = 0.5\n");
    world.step(150);  // the fall takes √(2/8) = 0.5 s
    EXPECT_NEAR(world.bodies().position(0)[1], 0.75 + 0.25, 1e-12);
    EXPECT_NEAR(world.bodies().velocity(0)[1], 0, 1e-12);
    EXPECT_NEAR(world.bodies().position(0)[0], 0.75, 1e-12);
}

// The balls fall from 1 m for 1 s at 2 m/s²: those that meet no layer of the floor are at 0.
TEST(MakeWorld, BodiesMeetTheObstaclesOfTheirLayers) {
    const std::string floors[] = {
        "[[plane]]\nnormal = [0, 1]\noffset = 0.25\n",
        "[[obstacle]]\nshape = 'box'\ncentre = [0, -0.75]\nsize = [9, 2]\n",
        "[[chain]]\npoints = [[-9, 0.25], [9, 0.25]]\n",
        "[[tiles]]\norigin = [-2, -3.75]\ntile = 4\nrows = [\"##\"]\n"};
    for (const std::string& floor : floors) {
        World world = world_of(
            "[scene]\naxes = 2\nmethod = 'velocity_verlet'\n[gravity]\nacceleration = [0, -2]\n"
            "[[body]]\nposition = [0, 1]\ncontact = 0.25\n"
            "[[body]]\nposition = [0, 1]\ncontact = 0.25\nmeets = ['solid']\n"
            "[[body]]\nposition = [0, 1]\ncontact = 0.25\nmeets = ['b', 'solid']\n" +
            floor + "layers = ['a', 'b']\n");
        world.step(100);
        for (const auto& [row, height] : {std::pair{0, 0.5}, {1, 0.0}, {2, 0.5}})
            EXPECT_NEAR(world.bodies().position(std::size_t(row))[1], height, 1e-12)
                << "body " << row << ", " << floor;
    }
}

Picture drawn(const Scene& scene) {
    const World world = make_world(scene, Settings{scene.stepping});
    return draw_scene(scene, world, camera_of(scene, world));
}

bool holds_disc(const Picture& picture, Point centre, float radius, Colour colour) {
    return std::ranges::any_of(picture.discs, [&](const Disc& disc) {
        return disc.centre == centre && disc.radius == radius && disc.colour == colour;
    });
}

template <class Element>
void expect_distinct_keys(const std::vector<Element>& elements) {
    for (auto a = elements.begin(); a != elements.end(); ++a)
        for (auto b = a + 1; b != elements.end(); ++b)
            if (a->key.object != 0) {
                EXPECT_NE(a->key, b->key);
            }
}

TEST(DrawScene, ShowsBodiesAttractorsAndAnchors) {
    const Picture picture = drawn(parsed(altered(everything, "view", "fastest", "")));
    EXPECT_EQ(picture.discs.size(), 12U + 1 + 1 + 1);
    EXPECT_TRUE(holds_disc(picture, {0.5F, 0.25F}, 0.3F, palette::orange));
    EXPECT_TRUE(holds_disc(picture, {5, 5}, 0.2F, palette::black));
    EXPECT_TRUE(holds_disc(picture, {0, 1}, 12 / 200.0F, palette::ink));
    EXPECT_TRUE(holds_disc(picture, {2, 0}, 12 / 40.0F, palette::blue));
    EXPECT_TRUE(holds_disc(picture, {8, 1}, 0.05F, palette::purple));
    EXPECT_EQ(picture.labels.at(0).text, "Everything");
    EXPECT_EQ(picture.labels.at(1).text, "velocity_verlet at 100 Hz, double   t = 0.00 s");
}

bool holds_line(const Picture& picture, const std::vector<Point>& points, Colour colour) {
    return std::ranges::any_of(picture.polylines, [&](const Polyline& line) {
        return line.points == points && line.colour == colour;
    });
}
bool holds_polygon(const Picture& picture, const std::vector<Point>& points, Colour colour) {
    return std::ranges::any_of(picture.polygons, [&](const Polygon& polygon) {
        return polygon.colour == colour && polygon.points == points;
    });
}

TEST(DrawScene, ShowsObstacles) {
    const Picture picture = drawn(
        parsed(obstacle_scene +
               "[[obstacle]]\nshape = 'circle'\ncentre = [1, 2]\nradius = 0.5\ncolour = 'green'\n"
               "[[obstacle]]\nshape = 'box'\ncentre = [4, 2]\nsize = [2, 1]\n"
               "[[obstacle]]\nshape = 'segment'\nfrom = [0, 5]\nto = [2, 6]\n"
               "[[chain]]\npoints = [[0, 0], [4, 0], [0, 3]]\nclosed = true\ncolour = 'ink'\n"
               "[[tiles]]\norigin = [8, 0]\ntile = 1\nrows = [\"##.#\"]\n"));
    EXPECT_TRUE(holds_disc(picture, {1, 2}, 0.5F, palette::green));
    EXPECT_TRUE(
        holds_polygon(picture, {{3, 1.5F}, {5, 1.5F}, {5, 2.5F}, {3, 2.5F}}, palette::grey));
    EXPECT_TRUE(holds_line(picture, {{0, 5}, {2, 6}}, palette::grey));
    EXPECT_TRUE(holds_line(picture, {{0, 0}, {4, 0}, {0, 3}, {0, 0}}, palette::ink));
    EXPECT_TRUE(holds_polygon(picture, {{8, 0}, {10, 0}, {10, 1}, {8, 1}}, palette::grey));
    EXPECT_TRUE(holds_polygon(picture, {{11, 0}, {12, 0}, {12, 1}, {11, 1}}, palette::grey));
    EXPECT_EQ(picture.polygons.size(), 3U) << "tiles beside each other are one polygon";
    EXPECT_FLOAT_EQ(picture.camera.centre.x, 6) << "the camera sees the obstacles from 0 to 12 m";
}

// Rows that are equal and solid are one block: a wall of 3 m, and a floor of two widths. One-way
// tiles keep a line in each row.
TEST(DrawScene, JoinsEqualRunsOfTiles) {
    const Picture picture =
        drawn(parsed(obstacle_scene +
                     "[[tiles]]\norigin = [8, 0]\ntile = 1\nrows = [\"#.==\", \"#.==\", \"#.##\", "
                     "\"..##\", \".###\"]\none_way = '='\n"));
    EXPECT_TRUE(holds_polygon(picture, {{8, 2}, {9, 2}, {9, 5}, {8, 5}}, palette::grey));
    EXPECT_TRUE(holds_polygon(picture, {{10, 1}, {12, 1}, {12, 3}, {10, 3}}, palette::grey));
    EXPECT_TRUE(holds_polygon(picture, {{9, 0}, {12, 0}, {12, 1}, {9, 1}}, palette::grey));
    EXPECT_EQ(picture.polygons.size(), 3U + 2);
    EXPECT_EQ(picture.polylines.size(), 2U);
}

// The picture is 10 m high around (0, 0); the ground is below 1 m.
TEST(DrawScene, ShowsPlanesWithTheirGround) {
    const Picture picture =
        drawn(parsed("[scene]\naxes = 2\n[[body]]\n[camera]\ncentre = [0, 0]\nheight = 10\n"
                     "[[plane]]\nnormal = [0, 2]\noffset = 2\ncolour = 'green'\n"));
    ASSERT_EQ(picture.polygons.size(), 1U);
    ASSERT_EQ(picture.polylines.size(), 1U);
    EXPECT_EQ(picture.polylines[0].colour, palette::green);
    for (const Point& end : picture.polylines[0].points) EXPECT_FLOAT_EQ(end.y, 1);
    const auto [low, high] = std::ranges::minmax(picture.polygons[0].points, {}, &Point::y);
    EXPECT_FLOAT_EQ(high.y, 1);
    EXPECT_LT(low.y, -5);
    const auto [left, right] = std::ranges::minmax(picture.polygons[0].points, {}, &Point::x);
    EXPECT_LT(left.x, -9);
    EXPECT_GT(right.x, 9);
}

TEST(DrawScene, ShowsTheSideFromWhichOneWayObstaclesAreMet) {
    const Picture picture = drawn(
        parsed(obstacle_scene +
               "[[obstacle]]\nshape = 'box'\ncentre = [4, 2]\nsize = [2, 1]\none_way = [0, 1]\n"
               "[[obstacle]]\nshape = 'circle'\ncentre = [0, 0]\nradius = 2\none_way = [0, 3]\n"
               "[[chain]]\npoints = [[0, 5], [2, 5], [2, 8]]\none_way = [0, 1]\n"
               "[[tiles]]\norigin = [8, 0]\ntile = 1\nrows = [\"#==\"]\none_way = '='\n"));
    const Colour faded = palette::faded(palette::grey, 90);
    EXPECT_TRUE(holds_polygon(picture, {{3, 1.5F}, {5, 1.5F}, {5, 2.5F}, {3, 2.5F}}, faded));
    EXPECT_TRUE(holds_line(picture, {{5, 2.5F}, {3, 2.5F}}, palette::grey)) << "the top only";
    EXPECT_TRUE(holds_disc(picture, {0, 0}, 2, faded));
    // An arc of 60° on both sides of the top.
    const auto arc = std::ranges::find_if(
        picture.polylines, [](const Polyline& line) { return line.points.size() == 25; });
    ASSERT_NE(arc, picture.polylines.end());
    EXPECT_NEAR(arc->points.front().x, std::sqrt(3.0), 1e-6);
    EXPECT_NEAR(arc->points.front().y, 1, 1e-6);
    EXPECT_NEAR(arc->points[12].y, 2, 1e-6);
    // Below the level part of the chain there is a strip; none beside the steep one.
    const float shade = picture.camera.height / 60;
    EXPECT_TRUE(holds_polygon(picture, {{0, 5}, {2, 5}, {2, 5 - shade}, {0, 5 - shade}}, faded));
    EXPECT_TRUE(holds_polygon(picture, {{8, 0}, {9, 0}, {9, 1}, {8, 1}}, palette::grey));
    EXPECT_TRUE(holds_polygon(picture, {{9, 0}, {11, 0}, {11, 1}, {9, 1}}, faded));
    EXPECT_EQ(picture.polygons.size(), 1U + 1 + 2);
    EXPECT_EQ(picture.polylines.size(), 1U + 1 + 1 + 1);
}

// In one step of 1/100 s each obstacle moves by 0.03 m to the right and 0.04 m down.
TEST(DrawScene, MovingObstaclesAreDrawnWhereTheyAreAndInterpolated) {
    const std::string moves = "velocity = [3, -4]\n";
    const Scene scene =
        parsed(obstacle_scene + "[[obstacle]]\nshape = 'circle'\ncentre = [1, 2]\nradius = 0.5\n" +
               moves + "[[obstacle]]\nshape = 'box'\ncentre = [4, 2]\nsize = [2, 1]\n" + moves +
               "[[chain]]\npoints = [[0, 0], [4, 0], [0, 3]]\n" + moves);
    World world = make_world(scene, Settings{scene.stepping});
    const Camera camera = camera_of(scene, world);
    const Picture before = draw_scene(scene, world, camera);
    world.step();
    const Picture after = draw_scene(scene, world, camera);
    const Picture half = between(before, after, 0.5F);
    const auto expect_moved = [](Point from, Point at, float share) {
        EXPECT_NEAR(at.x, from.x + 0.03F * share, 1e-6F);
        EXPECT_NEAR(at.y, from.y - 0.04F * share, 1e-6F);
    };
    for (const auto& [picture, share] : {std::pair{&after, 1.0F}, {&half, 0.5F}}) {
        expect_moved(before.discs[0].centre, picture->discs[0].centre, share);
        for (std::size_t i = 0; i < 4; ++i)
            expect_moved(before.polygons[0].points[i], picture->polygons[0].points[i], share);
        for (std::size_t i = 0; i < 3; ++i)
            expect_moved(before.polylines[0].points[i], picture->polylines[0].points[i], share);
    }
    expect_distinct_keys(before.polylines);
}

// A plane, an arc, a segment, a chain, the top of a tile, and two springs. A grid of 3 × 2 bodies
// has threads for two rows, three columns and four diagonals.
TEST(DrawScene, ShowsSpringsFromEndToEnd) {
    const Picture picture = drawn(parsed(everything));
    ASSERT_EQ(picture.polylines.size(), 1U + 4 + 2 + 2 + 3 + 2 + 2);
    EXPECT_EQ(picture.polylines[5].points.front(), (Point{0, 1}));
    EXPECT_EQ(picture.polylines[5].points.back(), (Point{0.5F, 0.25F}));
    EXPECT_EQ(picture.polylines[6].points.front(), (Point{2, 0}));
    EXPECT_EQ(picture.polylines[7].points, (std::vector<Point>{{6, 0}, {7, 0}, {8, 0}}));
    EXPECT_EQ(picture.polylines[9].points, (std::vector<Point>{{6, 0}, {6, 1}}));
    EXPECT_EQ(picture.polylines[12].points, (std::vector<Point>{{6, 0}, {7, 1}}));
    EXPECT_EQ(picture.polylines[14].points, (std::vector<Point>{{7, 0}, {6, 1}}));
}

TEST(DrawScene, GivesEachMovingElementItsOwnKey) {
    const Picture picture = drawn(parsed(everything));
    expect_distinct_keys(picture.discs);
    expect_distinct_keys(picture.polylines);
    EXPECT_EQ(
        std::ranges::count_if(picture.discs, [](const Disc& disc) { return disc.key.object == 0; }),
        2);
}

TEST(DrawScene, InterpolatesBetweenTwoSteps) {
    const Scene scene = parsed(everything);
    World world = make_world(scene, Settings{scene.stepping});
    const Camera camera = camera_of(scene, world);
    const Picture before = draw_scene(scene, world, camera);
    world.step();
    const Picture after = draw_scene(scene, world, camera);
    const Picture half = between(before, after, 0.5F);
    for (std::size_t i = 0; i < half.discs.size(); ++i)
        EXPECT_FLOAT_EQ(half.discs[i].centre.x,
                        before.discs[i].centre.x / 2 + after.discs[i].centre.x / 2);
    EXPECT_NE(half.polylines[5].points.back(), before.polylines[5].points.back());
}

TEST(Camera, FitsTheStartOfTheScene) {
    const Scene scene = parsed(
        "[scene]\naxes = 2\n[[body]]\nname = 'a'\nposition = [-8, 1]\n[[body]]\nposition = [8, 3]\n"
        "[[spring]]\nbody = 'a'\nanchor = [0, -1]\nstiffness = 1\n"
        "[[attractor]]\nposition = [0, 5]\ngm = 1\n");
    const Camera camera = camera_of(scene, make_world(scene, Settings{scene.stepping}));
    EXPECT_EQ(camera.centre, (Point{0, 2}));
    // The box is 16 m wide and 6 m high. In 16:9 with 25 % more this is 11.25 m.
    EXPECT_FLOAT_EQ(camera.height, 9 * 1.25F);
}

TEST(Camera, HasADefaultHeightForOnePoint) {
    const Scene scene = parsed("[scene]\naxes = 1\n[[body]]\nposition = [3]\n");
    const Camera camera = camera_of(scene, make_world(scene, Settings{scene.stepping}));
    EXPECT_EQ(camera.centre, (Point{3, 0}));
    EXPECT_EQ(camera.height, 10);
}

TEST(Camera, IsAsTheSceneSays) {
    const Scene scene = parsed(everything);
    const Camera camera = camera_of(scene, make_world(scene, Settings{scene.stepping}));
    EXPECT_EQ(camera.centre, (Point{1, 1}));
    EXPECT_EQ(camera.height, 12);
}

}  // namespace
}  // namespace oiler::test
