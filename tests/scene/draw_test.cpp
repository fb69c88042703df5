// SPDX-License-Identifier: MIT
#include "oiler/scene/draw.hpp"

#include "oiler/scene/make_world.hpp"
#include "oiler/scene/read.hpp"
#include "scene/everything.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

Scene parsed(const std::string& text) { return parse_scene(text, "test.toml"); }

Picture drawn(const Scene& scene) {
    const World world = make_world(scene, Settings{scene.stepping});
    return draw_scene(scene, world, camera_of(scene, world));
}

bool holds_disc(const Picture& picture, Point centre, float radius, Colour colour) {
    return std::ranges::any_of(picture.discs, [&](const Disc& disc) {
        return disc.centre == centre && disc.radius == radius && disc.colour == colour;
    });
}

TEST(DrawScene, ShowsBodiesAttractorsAndAnchors) {
    const Picture picture = drawn(parsed(everything));
    EXPECT_EQ(picture.discs.size(), 12U + 1 + 1);
    EXPECT_TRUE(holds_disc(picture, {0.5F, 0.25F}, 0.3F, palette::orange));
    EXPECT_TRUE(holds_disc(picture, {5, 5}, 0.2F, palette::black));
    EXPECT_TRUE(holds_disc(picture, {0, 1}, 12 / 200.0F, palette::ink));
    EXPECT_TRUE(holds_disc(picture, {2, 0}, 12 / 40.0F, palette::blue));
    EXPECT_TRUE(holds_disc(picture, {8, 1}, 0.05F, palette::purple));
    EXPECT_EQ(picture.labels.at(0).text, "Everything");
    EXPECT_EQ(picture.labels.at(1).text, "velocity_verlet at 100 Hz, double   t = 0.00 s");
}

// A plane and two springs. A grid of 3 × 2 bodies has threads for two rows, three columns and four
// diagonals.
TEST(DrawScene, ShowsSpringsFromEndToEnd) {
    const Picture picture = drawn(parsed(everything));
    ASSERT_EQ(picture.polylines.size(), 1U + 2 + 2 + 3 + 2 + 2);
    EXPECT_EQ(picture.polylines[1].points.front(), (Point{0, 1}));
    EXPECT_EQ(picture.polylines[1].points.back(), (Point{0.5F, 0.25F}));
    EXPECT_EQ(picture.polylines[2].points.front(), (Point{2, 0}));
    EXPECT_EQ(picture.polylines[3].points, (std::vector<Point>{{6, 0}, {7, 0}, {8, 0}}));
    EXPECT_EQ(picture.polylines[5].points, (std::vector<Point>{{6, 0}, {6, 1}}));
    EXPECT_EQ(picture.polylines[8].points, (std::vector<Point>{{6, 0}, {7, 1}}));
    EXPECT_EQ(picture.polylines[10].points, (std::vector<Point>{{7, 0}, {6, 1}}));
}

template <class Element>
void expect_distinct_keys(const std::vector<Element>& elements) {
    for (auto a = elements.begin(); a != elements.end(); ++a)
        for (auto b = a + 1; b != elements.end(); ++b)
            if (a->key.object != 0) {
                EXPECT_NE(a->key, b->key);
            }
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
    EXPECT_NE(half.polylines[1].points.back(), before.polylines[1].points.back());
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
