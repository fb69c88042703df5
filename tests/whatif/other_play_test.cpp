// SPDX-License-Identifier: MIT
#include "oiler/whatif/other_play.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

std::string name(Entity body, bool) { return "body " + std::to_string(body.index); }

/// The first `count` of a row of bodies.
Moment bodies(std::uint32_t count) {
    Moment moment;
    for (std::uint32_t i = 0; i < count; ++i) moment.bodies.push_back({Entity{i, 1}, 0, {}});
    return moment;
}

TEST(OtherPlay, IsOneOnceABodyIsMissingForAQuarterOfASecond) {
    OtherPlay play;
    EXPECT_FALSE(play.compare(bodies(2), bodies(2), 0.9, 0, name));
    EXPECT_EQ(play.since(), std::numeric_limits<double>::infinity());
    EXPECT_FALSE(play.compare(bodies(1), bodies(2), 1, 0, name));
    EXPECT_EQ(play.since(), 1);
    EXPECT_FALSE(play.compare(bodies(1), bodies(3), 1.2, 0, name));
    EXPECT_FALSE(play.compare(bodies(1), bodies(3), 1.25, 0.125, name)) << "the run may be late";
    const auto found = play.compare(bodies(1), bodies(3), 1.25, 0, name);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->from, 1);
    EXPECT_EQ(found->text, "body 1 is only in the true motion");
}

TEST(OtherPlay, IsNoneWhileEachDifferenceIsShort) {
    OtherPlay play;
    for (std::uint32_t i = 1; i < 40; ++i) {
        const double time = 0.1 * i;
        EXPECT_FALSE(play.compare(bodies(i), bodies(i + 1), time, 0, name)) << i;
        EXPECT_EQ(play.since(), time);
    }
}

TEST(OtherPlay, NamesTheFirstDifferenceThatLasts) {
    OtherPlay play;
    Moment own = bodies(2), truth = bodies(2);
    own.bodies[1].jumps = 1;
    EXPECT_FALSE(play.compare(own, truth, 1, 0, name));
    truth.readings = {{"coins", 3}};
    own.readings = {{"coins", 2}};
    EXPECT_FALSE(play.compare(own, truth, 1.125, 0, name));
    EXPECT_EQ(play.compare(own, truth, 1.5, 0, name)->text, "teleports of body 1: 1, true 0");
    own.bodies[1].jumps = 0;
    EXPECT_EQ(play.compare(own, truth, 1.5, 0, name)->text, "coins 2, true 3");
    EXPECT_EQ(play.since(), 1.125);
    own.readings[0].value = 3;
    EXPECT_FALSE(play.compare(own, truth, 1.75, 0, name));
    EXPECT_FALSE(play.differs());
}

}  // namespace
}  // namespace oiler::test
