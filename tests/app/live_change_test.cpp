// SPDX-License-Identifier: MIT
// A game that is played goes on with another setting at a tick that both rates have.
#include "oiler/app/live_change.hpp"

#include "oiler/sim/bodies.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

struct Fall {
    static constexpr About about{.name = "fall", .title = "Fall"};
    World world;
    explicit Fall(const Settings& settings) : world(1, settings) { (void)world.spawn(Body{}); }
    [[nodiscard]] Picture picture() const { return {}; }
};

class LiveChangeTest : public testing::Test {
protected:
    AnyGameOf<Fall> game{Settings{.stepping = {.rate = {12}}}};
    Recorder none{{}, {}, game.world()};
    Playback playback{game, none, Keep::nothing};
    LiveInput input;
    LiveChange change;
};

TEST_F(LiveChangeTest, WithoutAWishNothingIsStepped) {
    EXPECT_FALSE(change.make(playback, 100, input));
    EXPECT_EQ(playback.steps(), 0);
}

// 12 Hz and 8 Hz meet every 0.25 s. Of these, 0.25 s is tick 2 of 8 Hz, which 4 Hz has, too.
TEST_F(LiveChangeTest, WaitsForATickOfBothRates) {
    playback.step_to(1, input);
    change.want({.rate = {8}});
    EXPECT_FALSE(change.make(playback, 2, input)) << "the player has not come so far";
    EXPECT_EQ(playback.steps(), 2);
    EXPECT_TRUE(change.wanted());
    EXPECT_TRUE(change.make(playback, 90, input));
    EXPECT_EQ(playback.steps(), 3);
    EXPECT_EQ(game.world().tick(), 2);
    EXPECT_EQ(game.world().time(), 0.25);
    EXPECT_FALSE(change.wanted());
}

// 12 Hz and 20 Hz meet every 0.25 s, too, but at tick 5 of 20 Hz 10 Hz has none.
TEST_F(LiveChangeTest, WaitsUntilHalfOfTheRateHasATick) {
    playback.step_to(1, input);
    change.want({.rate = {20}});
    EXPECT_TRUE(change.make(playback, 90, input));
    EXPECT_EQ(game.world().time(), 0.5);
}

// Half of 15 Hz is no whole rate and plays never along: 12 Hz and 15 Hz meet at 1/3 s.
TEST_F(LiveChangeTest, AnOddRateHasNoHalf) {
    playback.step_to(1, input);
    change.want({.rate = {15}});
    EXPECT_TRUE(change.make(playback, 90, input));
    EXPECT_EQ(game.world().tick(), 5);
}

struct Brake {
    static constexpr About about{.name = "brake", .title = "Brake"};
    World world;
    explicit Brake(const Settings& settings) : world(1, settings) {
        (void)world.spawn({.mass = 1, .velocity = {1}}, LinearDrag{2});
    }
    [[nodiscard]] Picture picture() const { return {}; }
};

// c = 2/s at 4 Hz: a kick multiplies the speed by 1 - c·dt = 1/2, a drift by e^(-c·dt) = e^(-1/2).
TEST(LiveChange, DampsInTheDriftFromTheNextStepOn) {
    AnyGameOf<Brake> game{
        {.stepping = {.method = &find_method("semi_implicit_euler"), .rate = {4}}}};
    Recorder none{{}, {}, game.world()};
    Playback playback{game, none, Keep::nothing};
    LiveInput input;
    LiveChange change;
    const auto speed = [&] { return game.world().bodies().velocity(0)[0]; };
    playback.step_to(2, input);
    EXPECT_EQ(speed(), 0.25);
    Stepping stepping = game.world().settings().stepping;
    stepping.damping = Damping::in_drift;
    change.want(stepping);
    EXPECT_TRUE(change.make(playback, 2, input));
    playback.step_to(3, input);
    EXPECT_NEAR(speed(), 0.25 * std::exp(-0.5), 1e-15) << "some roundings of 1.1e-16";
}

TEST_F(LiveChangeTest, ForgetsWhatIsImpossible) {
    change.want({.rate = {12}, .precision = Precision::single});
    EXPECT_THROW((void)change.make(playback, 90, input), Error);
    EXPECT_FALSE(change.wanted());
    EXPECT_FALSE(change.make(playback, 90, input));
    EXPECT_EQ(game.world().settings().stepping.precision, Precision::double_);
}

}  // namespace
}  // namespace oiler::test
