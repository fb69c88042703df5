// SPDX-License-Identifier: MIT
#include "oiler/compare/captures/changes.hpp"

#include "oiler/plot/plot.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// At this size a unit of the canvas is two pixels.
constexpr Size size{1280, 720};

/// The canvas shows 36 m, so that a metre is ten units: 20 pixels.
Picture picture() {
    Picture picture{.camera = {.height = 36}};
    picture.polylines = {{.key = {1}, .points = {{0, 0}, {1, 1}}, .width = 2, .colour = {9, 9, 9}},
                         {.points = {{5, 5}, {6, 6}}, .width = 1}};
    picture.discs = {{.key = {1}, .centre = {1, 1}, .radius = 0.5F, .colour = {0, 114, 178}},
                     {.key = {2}, .centre = {3, 4}, .radius = 0.25F},
                     {.centre = {10, 10}, .radius = 4, .space = Space::canvas}};
    picture.labels = {{.at = {1, 1}, .text = "0.0"},
                      {.at = {2, 1}, .text = "0.5"},
                      {.at = {3, 1}, .text = "1.0"},
                      {.key = {7}, .at = {4, 4}, .text = "name"}};
    return picture;
}

template <class Change>
std::string words_of(const Change& change) {
    Picture actual = picture();
    change(actual);
    return describe_picture_change(picture(), actual, size);
}

TEST(PictureChanges, OfEqualPicturesAreEmpty) {
    EXPECT_EQ(words_of([](Picture&) {}), "");
    EXPECT_EQ(describe_picture_change({}, {}, size), "");
}

TEST(PictureChanges, NameAColour) {
    EXPECT_EQ(words_of([](Picture& p) { p.discs[0].colour.b += 3; }),
              "1 disc of another colour, by at most 3/255");
    EXPECT_EQ(words_of([](Picture& p) {
                  p.discs[0].colour.g -= 4;
                  p.discs[1].colour.a -= 100;
              }),
              "2 discs of another colour, by at most 100/255");
    EXPECT_EQ(words_of([](Picture& p) { p.background.r -= 3; }),
              "background of another colour, by at most 3/255");
    EXPECT_EQ(words_of([](Picture& p) { p.polylines[1].colour.r = 255; }),
              "1 line of another colour, by at most 255/255");
}

TEST(PictureChanges, NameAThinnerLine) {
    EXPECT_EQ(words_of([](Picture& p) { p.polylines[0].width *= 0.95F; }), "1 line: width 2 → 1.9");
    EXPECT_EQ(words_of([](Picture& p) { p.polylines[1].width *= 0.95F; }),
              "1 line: width 1 → 0.95");
    EXPECT_EQ(words_of([](Picture& p) { p.discs[1].radius = 0.125F; }),
              "1 disc: radius 0.25 → 0.125");
    EXPECT_EQ(words_of([](Picture& p) { p.labels[0].size = 13; }), "1 label: size 12 → 13");
}

TEST(PictureChanges, NameAMissingLabel) {
    EXPECT_EQ(words_of([](Picture& p) { p.labels.erase(p.labels.begin() + 1); }),
              "1 label missing: '0.5'");
    EXPECT_EQ(words_of([](Picture& p) { p.labels.resize(1); }),
              "3 labels missing: '0.5', '1.0', 'name'");
    EXPECT_EQ(words_of([](Picture& p) {
                  p.labels.push_back({.at = {9, 9}, .text = "1.5"});
              }),
              "1 label new: '1.5'");
    EXPECT_EQ(words_of([](Picture& p) { p.labels[3].text = "nom"; }),
              "1 label: text 'name' → 'nom'");
    EXPECT_EQ(words_of([](Picture& p) { p.labels[1].text = "0.4"; }),
              "1 label: text '0.5' → '0.4'");
}

// The labels of a real plot: one tick fewer.
TEST(PictureChanges, NameAMissingTickOfAPlot) {
    const Plot plot{.box = {{80, 60}, {600, 300}},
                    .x = {0, 1},
                    .y = {0, 2},
                    .series = {{.points = {{0, 0}, {1, 2}}}}};
    Picture whole;
    plot.draw(whole, {.object = 1});
    ASSERT_GE(whole.labels.size(), 8U);
    for (std::size_t i = 0; i < whole.labels.size(); ++i) {
        if (whole.labels[i].text.empty()) continue;
        Picture without = whole;
        without.labels.erase(without.labels.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_EQ(describe_picture_change(whole, without, size),
                  "1 label missing: '" + whole.labels[i].text + "'");
    }
}

TEST(PictureChanges, MeasureMovesInPixels) {
    EXPECT_EQ(words_of([](Picture& p) {
                  p.discs[1].centre = {3.03F, 4.04F};
              }),
              "1 disc moved by at most 1 px");
    EXPECT_EQ(words_of([](Picture& p) { p.discs[2].centre.x += 3; }),
              "1 disc moved by at most 6 px");
    EXPECT_EQ(words_of([](Picture& p) {
                  p.polylines[0].points[1].x += 0.1F;
                  p.polylines[1].points[0].y -= 0.5F;
              }),
              "2 lines moved by at most 10 px");
    EXPECT_EQ(words_of([](Picture& p) { p.labels[2].at.y += 1; }), "1 label moved by at most 2 px");
}

TEST(PictureChanges, NameTheCamera) {
    EXPECT_EQ(words_of([](Picture& p) {
                  p.camera = {{1, 2}, 18};
              }),
              "camera: centre (0, 0) → (1, 2); camera: height 36 → 18 m");
    EXPECT_EQ(words_of([](Picture& p) { p.camera.height = 18; }), "camera: height 36 → 18 m");
    EXPECT_EQ(words_of([](Picture& p) {
                  p.camera.centre = {1, 2};
              }),
              "camera: centre (0, 0) → (1, 2)");
    EXPECT_EQ(words_of([](Picture& p) {
                  p.camera.centre = {1, 0};
                  p.discs[1].centre.x += 3;
              }),
              "camera: centre (0, 0) → (1, 0); 1 disc moved by at most 40 px");
}

TEST(PictureChanges, NamePointsPlacesAndOrder) {
    EXPECT_EQ(words_of([](Picture& p) {
                  p.polylines[0].points.push_back({2, 2});
              }),
              "1 line: 2 → 3 points");
    EXPECT_EQ(words_of([](Picture& p) { p.labels[0].align = Align::right; }),
              "1 label placed in another way");
    EXPECT_EQ(words_of([](Picture& p) { std::swap(p.discs[0], p.discs[1]); }),
              "discs in another order");
    EXPECT_EQ(words_of([](Picture& p) { p.discs.clear(); }), "3 discs missing");
}

// An element without a key that moved is still the same element.
TEST(PictureChanges, MatchElementsByKeyAndElseByOrder) {
    EXPECT_EQ(words_of([](Picture& p) {
                  std::swap(p.discs[0], p.discs[1]);
                  p.discs[0].radius = 1;
              }),
              "1 disc: radius 0.25 → 1");
    EXPECT_EQ(words_of([](Picture& p) {
                  p.polylines[1].points = {{7, 7}, {8, 8}};
                  p.polylines[1].width = 3;
              }),
              "1 line moved by at most 57 px; 1 line: width 1 → 3");
}

TEST(PictureChanges, AreJoined) {
    EXPECT_EQ(words_of([](Picture& p) {
                  p.background.g = 0;
                  p.polylines[0].width = 1;
                  p.discs.pop_back();
                  p.labels[0].size = 1;
              }),
              "background of another colour, by at most 255/255; 1 line: width 2 → 1; 1 disc "
              "missing; 1 label: size 12 → 1");
}

using Bodies = std::vector<BodyState>;

const Bodies bodies{{"a", {1, 2, 3}, {4, 5, 6}},
                    {"b", {-1, -2, -3}, {-4, -5, -6}},
                    {"c", {0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}}};

template <class Real>
Real moved(Real value, int steps) {
    for (; steps > 0; --steps) value = std::nextafter(value, Real(1000));
    return value;
}

TEST(StateChanges, OfEqualBodiesAreEmpty) {
    EXPECT_EQ(describe_state_change(bodies, bodies, "double"), "");
    EXPECT_EQ(describe_state_change({}, {}, "float"), "");
}

TEST(StateChanges, NameEachField) {
    const char* const names[] = {"x", "y", "z", "vx", "vy", "vz"};
    for (std::size_t i = 0; i < 6; ++i) {
        Bodies actual = bodies;
        double& value = i < 3 ? actual[0].position[i] : actual[0].velocity[i - 3];
        value = moved(value, 7);
        const std::string words = describe_state_change(bodies, actual, "double");
        const std::string start =
            std::string("body 'a', ") + names[i] + ": " + std::to_string(i + 1) + " → ";
        EXPECT_TRUE(words.starts_with(start)) << words;
        EXPECT_TRUE(words.ends_with(", 7 ulp")) << words;
    }
}

// The change of b is larger in metres, the change of c in units in the last place.
TEST(StateChanges, NameTheLargestInUlps) {
    Bodies actual = bodies;
    actual[1].position[2] = moved(-3.0, 2);
    actual[2].velocity[1] = moved(0.5, 3);
    actual[0].position[0] = moved(1.0, 1);
    EXPECT_EQ(describe_state_change(bodies, actual, "double"),
              "body 'c', vy: 0.5 → 0.5000000000000003, 3 ulp");
}

TEST(StateChanges, CountUlpsOfFloat) {
    const auto before = static_cast<double>(0.1F);
    const Bodies golden{{"a", {before}, {}}};
    const Bodies actual{{"a", {static_cast<double>(moved(0.1F, 5))}, {}}};
    EXPECT_EQ(describe_state_change(golden, actual, "float"),
              "body 'a', x: 0.1 → 0.10000004, 5 ulp");
}

TEST(StateChanges, ASignOfZeroIsAChange) {
    const Bodies golden{{"a", {0.0}, {}}};
    const Bodies actual{{"a", {-0.0}, {}}};
    EXPECT_EQ(describe_state_change(golden, actual, "double"), "body 'a', x: 0 → -0, 0 ulp");
}

TEST(StateChanges, NameMissingAndNewBodies) {
    const Bodies one{bodies[1]};
    EXPECT_EQ(describe_state_change(bodies, one, "double"), "body 'a' and 1 more are missing");
    EXPECT_EQ(describe_state_change({bodies[0], bodies[1]}, one, "double"), "body 'a' is missing");
    EXPECT_EQ(describe_state_change(one, {bodies[1], bodies[2]}, "double"), "body 'c' is new");
    EXPECT_EQ(describe_state_change(one, bodies, "double"), "body 'a' and 1 more are new");
}

TEST(StateChanges, NameSwappedBodies) {
    Bodies actual = bodies;
    std::swap(actual[0].position, actual[2].position);
    std::swap(actual[0].velocity, actual[2].velocity);
    EXPECT_EQ(describe_state_change(bodies, actual, "double"), "bodies 'a' and 'c' are swapped");
}

// Only positions are exchanged, or one bit of a third body differs.
TEST(StateChanges, DoNotTakeOtherExchangesForASwap) {
    Bodies half = bodies;
    std::swap(half[0].position, half[2].position);
    EXPECT_TRUE(describe_state_change(bodies, half, "double").starts_with("body '"));
    for (const auto& [first, second, third] :
         {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}) {
        Bodies actual = bodies;
        std::swap(actual.at(first).position, actual.at(second).position);
        std::swap(actual.at(first).velocity, actual.at(second).velocity);
        double& bit = actual.at(third).velocity[2];
        bit = moved(bit, 1);
        EXPECT_TRUE(describe_state_change(bodies, actual, "double").starts_with("body '"));
    }
}

const std::vector<ObstacleState> obstacles{{"lift", "box", {{"x", 1}, {"y", 2}, {"width", 3}}},
                                           {"peg", "circle", {{"x", 4}, {"radius", 0.5}}},
                                           {"edge", "segment", {{"to x", 2}}}};

TEST(ObstacleChanges, NameTheFirstNumberOfTheFirstObstacle) {
    EXPECT_EQ(describe_obstacle_change(obstacles, obstacles), "");
    auto actual = obstacles;
    actual[1].numbers["radius"] = moved(0.5, 1);
    EXPECT_EQ(describe_obstacle_change(obstacles, actual),
              "obstacle 'peg', radius: 0.5 → 0.5000000000000001");
    actual[0].numbers.erase("y");
    EXPECT_EQ(describe_obstacle_change(obstacles, actual),
              "obstacle 'lift', y: 2 → 0; 1 more obstacle");
    actual[0].shape = "circle";
    EXPECT_EQ(describe_obstacle_change(obstacles, actual),
              "obstacle 'lift': box → circle; 1 more obstacle");
}

TEST(ObstacleChanges, NameMissingAndNewObstacles) {
    const std::vector<ObstacleState> one{obstacles[1]};
    EXPECT_EQ(describe_obstacle_change(obstacles, one), "obstacle 'edge' and 1 more are missing");
    EXPECT_EQ(describe_obstacle_change(one, {obstacles[0], obstacles[1]}),
              "obstacle 'lift' is new");
}

TEST(StateChanges, NameAnotherOrder) {
    EXPECT_EQ(describe_state_change(bodies, {bodies[1], bodies[0], bodies[2]}, "double"),
              "bodies in another order");
}

}  // namespace
}  // namespace oiler::test
