// SPDX-License-Identifier: MIT
// What is compared of two plays, and what is drawn between two moments of one.
#include "oiler/whatif/moment.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

const Entity one{1, 1};
const Entity two{2, 1};
const Entity three{3, 1};

TEST(Moments, AreDrawnOnStraightLinesBetweenThem) {
    const Moment before{.cuts = 1, .bodies = {{one, 0, {0, 2}}, {two, 0, {5}}}};
    const Moment after{.cuts = 2,
                       .quits = true,
                       .bodies = {{one, 0, {8, 2}}, {two, 1, {6}}, {three, 0, {7}}},
                       .readings = {{"score", 3}}};
    const Moment quarter = between(before, after, 0.25);
    ASSERT_EQ(quarter.bodies.size(), 1U) << "two was thrown, three is new";
    EXPECT_EQ(quarter.bodies[0].entity, one);
    EXPECT_EQ(quarter.bodies[0].position, (Vec3{2, 2}));
    EXPECT_EQ(quarter.cuts, 2);
    EXPECT_TRUE(quarter.quits);
    EXPECT_EQ(quarter.readings.at(0).value, 3);
}

TEST(Moments, OfAGameThatQuitAreOfAnotherPlay) {
    EXPECT_TRUE(is_same_play({.quits = true}, {.quits = true}));
    EXPECT_FALSE(is_same_play({.quits = true}, {.quits = false}));
}

TEST(Moments, NameTheirFirstDifference) {
    const auto name = [](Entity body, bool) { return "body " + std::to_string(body.index); };
    const auto difference = [&](const Moment& play, const Moment& truth) {
        return describe_difference(play, truth, name);
    };
    const Moment truth{.bodies = {{one, 0, {}}, {two, 2, {}}},
                       .readings = {{"speed", 0.5, "m/s"}, {"coins", 3}}};
    EXPECT_EQ(difference(truth, truth), "");
    Moment play = truth;
    play.readings[0].value = 0.75;
    EXPECT_EQ(difference(play, truth), "") << "no count";
    play.bodies.push_back({three, 0, {}});
    EXPECT_EQ(difference(play, truth), "body 3 is not in the true motion");
    EXPECT_EQ(difference(truth, play), "body 3 is only in the true motion");
    play.bodies[1].jumps = 1;
    EXPECT_EQ(difference(play, truth), "teleports of body 2: 1, true 2");
    play.readings[1].value = 2;
    EXPECT_EQ(difference(play, truth), "coins 2, true 3");
    play.cuts = 1;
    EXPECT_EQ(difference(play, truth), "restarts 1, true 0");
    play.quits = true;
    EXPECT_EQ(difference(play, truth), "the game ends, the true motion goes on");
    EXPECT_EQ(difference(truth, play), "the true motion has ended");
}

TEST(Moments, PairTheirBodies) {
    const Moment a{.bodies = {{one, 0, {1}}, {two, 0, {2}}, {three, 4, {3}}}};
    const Moment b{.bodies = {{two, 0, {20}}, {three, 4, {30}}, {{4, 1}, 0, {40}}}};
    const auto pairs = same_bodies(a, b);
    ASSERT_EQ(pairs.size(), 2U);
    EXPECT_EQ(pairs[0].first->position, (Vec3{2}));
    EXPECT_EQ(pairs[0].second->position, (Vec3{20}));
    EXPECT_EQ(pairs[1].first->position, (Vec3{3}));
    EXPECT_EQ(pairs[1].second->position, (Vec3{30}));
}

}  // namespace
}  // namespace oiler::test
