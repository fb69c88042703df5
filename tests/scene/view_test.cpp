// SPDX-License-Identifier: MIT
// What a scene's [view] draws beside the bodies: paths, colours of speeds, the air.

#include "oiler/picture/theme.hpp"
#include "oiler/scene/draw.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/scene/read.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// Two balls without forces and a cloud of three: 1 m/s to the right, 2 m/s up.
Scene scene_of(const std::string& more) {
    return parse_scene(
        "[scene]\naxes = 2\nrate = 10\n[camera]\ncentre = [0.0, 0.0]\nheight = 8.0\n"
        "[[body]]\nname = \"a\"\nvelocity = [1.0, 0.0]\ncolour = \"green\"\n"
        "[[body]]\nname = \"b\"\nvelocity = [0.0, 2.0]\n"
        "[[scatter]]\ncount = 3\nposition_from = [0.0, 0.0]\n"
        "position_to = [1.0, 1.0]\nvelocity_from = [0.0, -3.0]\n" +
            more,
        "view.toml");
}

/// A scene that is sampled after each step, or in calls of several.
struct Played {
    explicit Played(Scene taken)
        : scene(std::move(taken)),
          world(make_world(scene, Settings{scene.stepping})),
          trails(scene, world) {}
    void step(std::int64_t count) {
        for (; count > 0; --count) {
            world.step();
            trails.sample(world);
        }
    }
    void step_to_samples(std::int64_t count) {
        while (count > 0) {
            const std::int64_t steps = std::min(count, trails.steps_to_sample(world));
            world.step(steps);
            trails.sample(world);
            count -= steps;
        }
    }
    [[nodiscard]] Picture picture() const {
        return draw_scene(scene, world, camera_of(scene, world), trails);
    }
    Scene scene;
    World world;
    SceneTrails trails;
};

/// The ends of all paths.
struct Ends {
    Point oldest{1e9F, 1e9F};
    Point newest{-1e9F, -1e9F};
};
Ends ends_of(const std::vector<Polyline>& lines, std::uint64_t body) {
    Ends ends;
    for (const Polyline& line : lines)
        for (const Point& point : line.points)
            if (line.key.object == body) {
                ends.oldest = {std::min(ends.oldest.x, point.x), std::min(ends.oldest.y, point.y)};
                ends.newest = {std::max(ends.newest.x, point.x), std::max(ends.newest.y, point.y)};
            }
    return ends;
}

TEST(View, ASceneWithoutItDrawsBodiesOnly) {
    Played run(scene_of(""));
    EXPECT_GT(run.trails.steps_to_sample(run.world), 1'000'000'000);
    run.step(10);
    const Picture picture = run.picture();
    EXPECT_TRUE(picture.polylines.empty());
    EXPECT_TRUE(picture.polygons.empty());
    EXPECT_EQ(picture.background, palette::paper);
    EXPECT_EQ(picture.discs.at(0).colour, palette::green);
}

// A body of 1 m/s: its path of 2 s ends 2 m behind it, after 0.5 s at its start.
TEST(View, TrailsFollowSingleBodies) {
    Played run(scene_of("[view]\ntrails = 2.0\n"));
    const std::uint64_t first = run.world.entity_of_row(0).id();
    const std::uint64_t second = run.world.entity_of_row(1).id();
    run.step(5);
    EXPECT_NEAR(ends_of(run.picture().polylines, first).oldest.x, 0, 1e-6);
    EXPECT_NEAR(ends_of(run.picture().polylines, first).newest.x, 0.5, 1e-6);
    run.step(45);
    const Picture picture = run.picture();
    EXPECT_NEAR(ends_of(picture.polylines, first).oldest.x, 3, 1e-5);
    EXPECT_NEAR(ends_of(picture.polylines, first).newest.x, 5, 1e-5);
    EXPECT_NEAR(ends_of(picture.polylines, second).oldest.y, 6, 1e-5);
    EXPECT_NEAR(ends_of(picture.polylines, second).newest.y, 10, 1e-5);
    for (const Polyline& line : picture.polylines)
        EXPECT_TRUE(line.key.object == first || line.key.object == second) << "not the scatter";
}

// At 1 kHz a path of 4 s has fewer samples than steps.
TEST(View, TrailsDoNotDependOnTheStepsPerCall) {
    const std::string view = "[view]\ntrails = 4.0\n";
    Played single(scene_of(view)), many(scene_of(view));
    for (Played* run : {&single, &many}) {
        Settings settings{run->scene.stepping};
        settings.stepping.rate = {1000};
        run->world = make_world(run->scene, settings);
        run->trails = SceneTrails(run->scene, run->world);
    }
    EXPECT_GT(single.trails.steps_to_sample(single.world), 4);
    single.step(5003);
    many.step_to_samples(1234);
    many.step_to_samples(5003 - 1234);
    EXPECT_EQ(hash_of(single.picture()), hash_of(many.picture()));
    std::size_t points = 0;
    for (const Polyline& line : single.picture().polylines) points += line.points.size();
    EXPECT_LT(points, 2 * 300U);
    const std::uint64_t first = single.world.entity_of_row(0).id();
    EXPECT_NEAR(ends_of(single.picture().polylines, first).oldest.x, 1, 0.03) << "4 s ago";
    EXPECT_NEAR(ends_of(single.picture().polylines, first).newest.x, 5.003, 1e-5);
}

// Halfway between two steps, a body and the end of its path are at the same place, and pieces of
// the path meet.
TEST(View, TrailsSlideBetweenSteps) {
    Played run(scene_of("[view]\ntrails = 2.0\n"));
    run.step(40);
    const Picture before = run.picture();
    run.step(1);
    const Picture drawn = between(before, run.picture(), 0.5F);
    const std::uint64_t body = run.world.entity_of_row(0).id();
    EXPECT_NEAR(ends_of(drawn.polylines, body).newest.x, 4.05, 1e-5);
    EXPECT_NEAR(ends_of(drawn.polylines, body).oldest.x, 2.05, 1e-5);
    EXPECT_NEAR(drawn.discs.at(0).centre.x, 4.05, 1e-5);
    std::vector<Polyline> pieces;
    for (const Polyline& line : drawn.polylines)
        if (line.key.object == body) pieces.push_back(line);
    ASSERT_GT(pieces.size(), 3U);
    for (std::size_t i = 1; i < pieces.size(); ++i) {
        EXPECT_NEAR(pieces[i].points.back().x, pieces[i - 1].points.front().x, 1e-5);
        EXPECT_GT(contrast(pieces[i - 1].colour, palette::paper),
                  contrast(pieces[i].colour, palette::paper))
            << "older pieces are fainter";
    }
}

// A recorder: a body of 2 m/s in a picture of 10 m, which a path of 4 s reaches 4.5 m down.
TEST(View, WithOneAxisThePastMovesDown) {
    Played run(
        parse_scene("[scene]\naxes = 1\nrate = 10\n[camera]\nheight = 10.0\n"
                    "[[body]]\nvelocity = [2.0]\n[view]\ntrails = 4.0\n",
                    "view.toml"));
    run.step(20);
    const std::uint64_t body = run.world.entity_of_row(0).id();
    EXPECT_NEAR(ends_of(run.picture().polylines, body).oldest.y, -2.25, 1e-5);
    run.step(30);
    for (const Polyline& line : run.picture().polylines)
        for (const Point& point : line.points)
            EXPECT_NEAR(point.y, (point.x - 10) / 2 * 4.5 / 4, 1e-5) << "4 m are 2 s ago";
    EXPECT_NEAR(ends_of(run.picture().polylines, body).oldest.x, 2, 1e-5);
}

// A file of 64 KiB has room for thousands of bodies.
TEST(View, TrailsOfManyBodiesHaveFewPoints) {
    std::string bodies;
    for (int i = 0; i < 3000; ++i) bodies += "[[body]]\n";
    Played run(scene_of(bodies + "[view]\ntrails = 20.0\n"));
    run.step(200);
    std::size_t points = 0;
    for (const Polyline& line : run.picture().polylines) points += line.points.size();
    EXPECT_LT(points, 100'000U);
}

TEST(View, BodiesHaveTheColoursOfTheirSpeeds) {
    Played run(scene_of("[view]\nfastest = 2.0\n"));
    run.step(3);
    const Picture picture = run.picture();
    EXPECT_EQ(picture.discs.at(0).colour, palette::purple) << "half of the scale";
    EXPECT_EQ(picture.discs.at(1).colour, palette::orange) << "the end of the scale";
    EXPECT_EQ(picture.discs.at(2).colour, palette::orange) << "beyond it";
    EXPECT_EQ(picture.labels.back().text, "0 to 2 m/s");
    const Picture wider = Played(scene_of("[view]\nfastest = 4.0\n")).picture();
    EXPECT_EQ(wider.discs.at(0).colour, palette::mix(palette::blue, palette::purple, 0.5F));
    EXPECT_EQ(wider.discs.at(2).colour, palette::mix(palette::purple, palette::orange, 0.5F));
}

TEST(View, TextIsReadableOnADarkBackground) {
    const Picture picture = Played(scene_of("[view]\nbackground = \"#10141c\"\n")).picture();
    EXPECT_EQ(picture.background, (Colour{0x10, 0x14, 0x1c}));
    for (const Label& label : picture.labels)
        EXPECT_GT(contrast(label.colour, picture.background), 4.5) << label.text;
}

/// A wind of 3 m/s to the right on the body `name`.
std::string wind_on(const std::string& name, const std::string& velocity = "[3.0, 0.0]") {
    return "[[wind]]\nbody = \"" + name + "\"\nvelocity = " + velocity + "\ndrag = 0.1\n";
}

Point tip_of(const Picture& picture, const ElementKey& key) {
    for (const Polygon& arrow : picture.polygons)
        if (arrow.key == key) return *std::ranges::max_element(arrow.points, {}, &Point::x);
    ADD_FAILURE() << "no such arrow";
    return {};
}

TEST(View, ArrowsDriftWithTheWind) {
    Played run(scene_of(wind_on("a") + wind_on("b")));
    const Picture before = run.picture();
    ASSERT_GT(before.polygons.size(), 20U);
    const ElementKey key = before.polygons[before.polygons.size() / 2].key;
    run.step(2);
    EXPECT_NEAR(tip_of(run.picture(), key).x, tip_of(before, key).x + 0.6F, 1e-5);
    EXPECT_NEAR(tip_of(run.picture(), key).y, tip_of(before, key).y, 1e-5);
    run.step(1000);
    const Picture later = run.picture();
    EXPECT_NEAR(static_cast<double>(later.polygons.size()),
                static_cast<double>(before.polygons.size()), 15)
        << "others follow";
}

TEST(View, ThereAreNoArrowsWhereWindsDifferOrAreLeftOut) {
    EXPECT_TRUE(
        Played(scene_of(wind_on("a") + wind_on("b", "[0.0, 1.0]"))).picture().polygons.empty());
    EXPECT_TRUE(Played(scene_of(wind_on("a", "[0.0, 0.0]"))).picture().polygons.empty());
    EXPECT_TRUE(
        Played(scene_of(wind_on("a") + "[view]\nwind = false\n")).picture().polygons.empty());
}

// The title and the setting are from 316 to 356 units of the canvas up, the hint of a scene
// below 22.
TEST(View, NoArrowCrossesTheTexts) {
    Played run(scene_of(wind_on("a", "[0.0, 1.0]")));
    for (int i = 0; i < 40; ++i, run.step(1)) {
        const Picture picture = run.picture();
        ASSERT_GT(picture.polygons.size(), 10U);
        for (const Polygon& arrow : picture.polygons)
            for (const Label& label : picture.labels) {
                const auto up = [&](const Point& corner) {
                    return picture.camera.to_canvas(corner).y;
                };
                const auto [low, high] = std::ranges::minmax(arrow.points, {}, up);
                EXPECT_FALSE(up(low) < label.at.y + 0.5F * label.size && up(high) > label.at.y)
                    << label.text;
            }
    }
}

}  // namespace
}  // namespace oiler::test
