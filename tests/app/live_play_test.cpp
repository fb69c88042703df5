// SPDX-License-Identifier: MIT
// A game that a player controls: pause, way back, changes of the setting, restarts, divergence. The
// test has its own clock.
#include "oiler/app/live_play.hpp"

#include <fmt/core.h>

#include <atomic>
#include <thread>

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

class PendingSettingTest : public testing::Test {
protected:
    AnyGameOf<Fall> game{Settings{.stepping = {.rate = {12}}}};
    TraceWriter none{{}, {}, game.world()};
    Playback playback{game, none, Keep::nothing};
    LiveInput input;
    PendingSetting change;
};

TEST_F(PendingSettingTest, WithoutARequestNothingIsStepped) {
    EXPECT_FALSE(change.make(playback, 100, input));
    EXPECT_EQ(playback.steps(), 0);
}

// 12 Hz and 8 Hz meet every 0.25 s. Of these, 0.25 s is tick 2 of 8 Hz, which 4 Hz has, too.
TEST_F(PendingSettingTest, WaitsForATickOfBothRates) {
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
TEST_F(PendingSettingTest, WaitsUntilHalfOfTheRateHasATick) {
    playback.step_to(1, input);
    change.want({.rate = {20}});
    EXPECT_TRUE(change.make(playback, 90, input));
    EXPECT_EQ(game.world().time(), 0.5);
}

// Half of 15 Hz is no whole rate and plays never along: 12 Hz and 15 Hz meet at 1/3 s.
TEST_F(PendingSettingTest, AnOddRateHasNoHalf) {
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
TEST(PendingSettings, DampsInTheDriftFromTheNextStepOn) {
    AnyGameOf<Brake> game{
        {.stepping = {.method = &find_method("semi_implicit_euler"), .rate = {4}}}};
    TraceWriter none{{}, {}, game.world()};
    Playback playback{game, none, Keep::nothing};
    LiveInput input;
    PendingSetting change;
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

TEST_F(PendingSettingTest, ForgetsWhatIsImpossible) {
    change.want({.rate = {12}, .precision = Precision::single});
    EXPECT_THROW((void)change.make(playback, 90, input), Error);
    EXPECT_FALSE(change.wanted());
    EXPECT_FALSE(change.make(playback, 90, input));
    EXPECT_EQ(game.world().settings().stepping.precision, Precision::double_);
}

/// A body at 1 m/s with a drag too small to see, which has no exact flow. The game ends with an
/// error in its step `last`.
struct Walk {
    static constexpr About about{.name = "walk", .title = "Walk", .rate = 10};
    static constexpr std::int64_t last = 30;
    World world;
    Entity body;
    explicit Walk(const Settings& settings)
        : world(1, settings), body(world.spawn(Body{.velocity = {1}}, QuadraticDrag{1e-12})) {}
    void update(const Input&) {
        if (world.tick() == last) fail(Exit::diverged, "too far");
    }
    [[nodiscard]] Picture picture() const {
        return {.discs = {{.key = key_of(world, body), .centre = to_point(world.position(body))}}};
    }
};

/// A game that a player controls, without a window.
template <class G>
struct Live {
    explicit Live(Options given) : options(std::move(given)) {}

    Options options;
    MakeGame make = [](const Settings& settings) {
        return std::make_unique<AnyGameOf<G>>(settings);
    };
    AnyGameOf<G> game{options.settings};
    TraceWriter none{{}, {}, game.world()};
    Playback playback{game, none, Keep::nothing};
    LiveInput live;
    GameRun run{.options = options,
                .about = G::about,
                .make = make,
                .playback = playback,
                .live = live,
                .inputs = live};
    LivePlay play{run};
};

Options at_10_hz(Options options = {}) {
    options.settings.stepping.rate = {10};
    return options;
}
Options quiet_at_10_hz() {
    Options options;
    options.quiet = true;
    return at_10_hz(options);
}

/// A walk at 10 Hz, a step a frame.
class LivePlayTest : public testing::Test, protected Live<Walk> {
protected:
    LivePlayTest() : Live(quiet_at_10_hz()) { frame(); }  // it starts the clock

    /// Shows a frame `period` after the last one. Returns where the body is drawn, m.
    float frame(const Requests& requests = {}) {
        play.set_pace(requests);
        play.control(requests, false);
        time += period;
        return play.play(time).discs.at(0).centre.x;
    }
    void play_steps(int count) {
        for (int i = 0; i < count; ++i) frame();
    }

    std::chrono::nanoseconds time{0};
    std::chrono::milliseconds period{100};
};
using State = LivePlay::State;

TEST_F(LivePlayTest, APauseHoldsTheGameAndSingleStepsGoBothWays) {
    play_steps(5);
    EXPECT_EQ(play.state(), State::playing);
    EXPECT_EQ(play.status(), "");
    frame({.pauses = true});
    EXPECT_EQ(play.state(), State::paused);
    EXPECT_EQ(play.status(), "paused: F3 resumes, F4 steps back, F5 steps");
    const float held = frame();
    EXPECT_NEAR(held, 0.5F, 1e-6F);
    EXPECT_EQ(frame(), held);
    EXPECT_NEAR(frame({.goes_back = true}), 0.4F, 1e-6F);
    EXPECT_NEAR(frame({.goes_back = true}), 0.3F, 1e-6F);
    EXPECT_EQ(play.past()->now, 3);
    EXPECT_EQ(play.past()->last, 5);
    EXPECT_NEAR(frame({.steps = true}), 0.4F, 1e-6F);
    EXPECT_EQ(play.past()->last, 4) << "later steps are forgotten";
    frame({.pauses = true});
    EXPECT_NEAR(frame(), 0.5F, 1e-6F);
}

// A frame at 0.24 s is drawn between two steps.
TEST_F(LivePlayTest, AfterGoingBackAPauseShowsAWholeStep) {
    play_steps(2);
    period = std::chrono::milliseconds(40);
    frame();
    frame({.pauses = true});
    const float back = frame({.goes_back = true});
    EXPECT_NEAR(back, 0.2F, 1e-6F);
    EXPECT_EQ(frame(), back);
}

TEST_F(LivePlayTest, GoesBackAsLongAsTheKeyIsHeldAndPlaysOnFromThere) {
    play_steps(5);
    EXPECT_NEAR(frame({.rewinds = true}), 0.4F, 1e-6F);
    EXPECT_EQ(play.state(), State::going_back);
    EXPECT_EQ(play.status(), "back at 0.40 s");
    for (int i = 0; i < 10; ++i) frame({.rewinds = true});
    EXPECT_EQ(play.status(), "back at 0.00 s, no further");
    EXPECT_NEAR(frame(), 0.1F, 1e-6F);
    EXPECT_EQ(play.state(), State::playing);
}

TEST_F(LivePlayTest, ShowsTheStepOfTheTimeLine) {
    play_steps(8);
    EXPECT_NEAR(frame({.step = 2}), 0.2F, 1e-6F);
    EXPECT_NEAR(frame({.step = 100}), 0.8F, 1e-6F) << "the last step that was taken";
    EXPECT_NEAR(frame({.step = 5}), 0.5F, 1e-6F);
    EXPECT_NEAR(frame(), 0.6F, 1e-6F);
}

TEST_F(LivePlayTest, ADivergenceStopsTheGameUntilItGoesBackOrRestarts) {
    play_steps(40);
    EXPECT_EQ(play.state(), State::stopped);
    EXPECT_EQ(playback.steps(), Walk::last);
    EXPECT_NE(std::string(play.divergence()->what()).find("too far"), std::string::npos);
    frame({.pauses = true});
    EXPECT_EQ(play.state(), State::stopped) << "there is no step to resume with";
    EXPECT_NEAR(frame({.goes_back = true}), 2.9F, 1e-5F);
    EXPECT_EQ(play.state(), State::paused);
    EXPECT_FALSE(play.divergence());
    frame({.pauses = true});
    play_steps(3);
    EXPECT_EQ(play.state(), State::stopped);
    EXPECT_NEAR(frame({.restarts = true}), 0.05F, 0.051F) << "from the beginning";
    EXPECT_EQ(play.state(), State::playing);
}

// 10 Hz and 15 Hz meet each 0.2 s.
TEST_F(LivePlayTest, WaitsForTheSettingAndGoesOnWithIt) {
    play_steps(1);
    frame({.pauses = true});
    frame({.stepping = Stepping{.rate = {15}}});
    EXPECT_EQ(play.state(), State::waiting_for_change);
    EXPECT_EQ(play.status(), "15 Hz begins when both rates have a step");
    frame({.pauses = true});
    play_steps(2);
    EXPECT_EQ(play.state(), State::playing);
    EXPECT_EQ(game.world().settings().stepping.rate, Rate{15});
    EXPECT_EQ(play.past()->first, 2) << "no step at the old rate can be gone to";
    EXPECT_TRUE(play.complaint().empty());
    const std::int64_t steps = playback.steps();
    play_steps(2);
    EXPECT_EQ(playback.steps(), steps + 3) << "0.2 s at 15 Hz";
}

TEST_F(LivePlayTest, AStartWithAnotherSettingKeepsThePauseAndDropsAnEarlierRequest) {
    play_steps(1);
    frame({.pauses = true});
    frame({.stepping = Stepping{.rate = {15}}});
    frame({.stepping = Stepping{.rate = {20}}, .changes_from_start = true});
    EXPECT_EQ(play.state(), State::paused);
    EXPECT_EQ(game.world().time(), 0);
    frame({.pauses = true});
    play_steps(5);
    EXPECT_EQ(game.world().settings().stepping.rate, Rate{20});
}

TEST_F(LivePlayTest, AnotherSettingEndsTheStopOfADivergence) {
    play_steps(40);
    ASSERT_EQ(play.state(), State::stopped);
    frame({.stepping = Stepping{.rate = {20}}});
    EXPECT_EQ(play.state(), State::playing);
    EXPECT_FALSE(play.divergence());
}

TEST_F(LivePlayTest, TellsWhyASettingIsImpossible) {
    play_steps(3);
    frame({.stepping = Stepping{.method = &find_method("exact")}});
    play_steps(3);
    EXPECT_TRUE(holds(play.complaint(), "no exact flow"));
    EXPECT_NE(game.world().settings().stepping.method->name, "exact");
    EXPECT_EQ(playback.steps(), 7) << "the game goes on";
}

/// Asks for 20 Hz in its fifth step.
struct Switch {
    static constexpr About about{.name = "switch", .title = "Switch", .rate = 10};
    static inline std::int64_t wanted = 20;  // Hz
    World world;
    explicit Switch(const Settings& settings) : world(1, settings) {}
    void update(const Input&, Loop& loop) {
        if (world.tick() == 4) loop.change_rate(wanted);
    }
    [[nodiscard]] Picture picture() const { return {}; }
};

/// Plays ten frames of 0.1 s of a game at 10 Hz that asks for 20 Hz.
struct SwitchedPlay : Live<Switch> {
    explicit SwitchedPlay(const Options& given) : Live(at_10_hz(given)) {
        for (int i = 0; i <= 10; ++i) {
            play.control({}, false);
            (void)play.play(i * std::chrono::milliseconds(100));
        }
    }
    [[nodiscard]] std::int64_t rate() const { return game.world().settings().stepping.rate.steps; }
};

// The fifth step asks; the next frame shows the new game, and four more play it. That asks for the
// rate that it has.
TEST(GamesThatChangeTheirRate, AreMadeAnewAtIt) {
    Options options;
    options.quiet = true;
    const SwitchedPlay switched{options};
    EXPECT_EQ(switched.rate(), 20);
    EXPECT_EQ(switched.game.world().tick(), 4 * 2);
    EXPECT_TRUE(switched.play.complaint().empty());
}

TEST(GamesThatChangeTheirRate, KeepAFixedOneAndAreToldWhy) {
    Options recorded;
    recorded.record = "a.rec";
    recorded.quiet = true;
    const SwitchedPlay fixed{recorded};
    EXPECT_EQ(fixed.rate(), 10);
    EXPECT_EQ(fixed.game.world().tick(), 10);
    EXPECT_EQ(fixed.play.complaint(), "--record keeps this setting.");
}

TEST(GamesThatChangeTheirRate, AreToldWhatNoRateIs) {
    Options options;
    options.quiet = true;
    for (const std::int64_t wrong : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{1'000'001}}) {
        Switch::wanted = wrong;
        const SwitchedPlay kept{options};
        EXPECT_EQ(kept.rate(), 10);
        EXPECT_EQ(kept.play.complaint(),
                  fmt::format("the game asks for {} Hz; a rate is from 1 to 1000000 Hz", wrong));
    }
    Switch::wanted = 20;
}

// Before any step was timed, a frame that took long may be followed by no more than two steps.
TEST(GameClocks, CatchUpTwoStepsUntilStepsAreTimed) {
    GameClock clock(Rate{60});
    EXPECT_EQ(clock.advance(std::chrono::seconds(0)), 0);
    EXPECT_EQ(clock.advance(std::chrono::seconds(1)), 2);
    clock.limit_steps(2, std::chrono::microseconds(1));
    EXPECT_EQ(clock.advance(std::chrono::seconds(2)), 15) << "0.25 s";
}

// What plays along is made on another thread, but would take the time of the first frame.
// A game of which copies are counted that measure what its timestep costs.
struct MeasuredPlayTest : LivePlayTest {
    std::atomic<int> made = 0;
    std::atomic<std::int64_t> first_rate = 0;  ///< of the first copy, Hz
    MakeGame counted = [&](const Settings& settings) {
        if (made++ == 0) first_rate = settings.stepping.rate.steps;
        return std::make_unique<AnyGameOf<Walk>>(settings);
    };
    About about = Walk::about;

    GameRun measured() {
        options.quiet = false;
        return {.options = options,
                .about = about,
                .make = counted,
                .playback = playback,
                .live = live,
                .inputs = live};
    }
    /// Plays until the copies have begun.
    static void wait_for_copies(LivePlay& play, std::chrono::nanoseconds now) {
        while (!play.figures()->begin) (void)play.play(now);
    }
};

TEST_F(MeasuredPlayTest, TheFirstFrameWaitsForNoCopyThatPlaysAlong) {
    GameRun other = measured();
    LivePlay first(other);
    first.measure();
    (void)first.play(time);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(made, 0);
    first.measure();
    wait_for_copies(first, time + period);
    EXPECT_GT(made, 0);
    EXPECT_EQ(first.figures()->begin->time, 0);
}

TEST_F(MeasuredPlayTest, WhatNobodySeesIsNotMeasured) {
    GameRun other = measured();
    LivePlay unseen(other);
    for (int i = 0; i < 5; ++i) (void)unseen.play(time + i * period);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    unseen.control({.restarts = true}, false);
    (void)unseen.play(time + 5 * period);
    EXPECT_EQ(made, 0);
    EXPECT_FALSE(unseen.figures()->begin);
    unseen.measure();
    const double now = game.world().time();
    wait_for_copies(unseen, time + 5 * period);
    EXPECT_EQ(unseen.figures()->begin->time, now);
}

TEST_F(MeasuredPlayTest, AGameThatIsMadeAnewIsMeasuredFromItsNextStart) {
    about.changes_in_play = false;
    GameRun other = measured();
    LivePlay late(other);
    for (int i = 0; i < 3; ++i) (void)late.play(time + i * period);
    late.change_to({.rate = {20}}, true);
    (void)late.play(time + 3 * period);
    made = 0;
    late.measure();
    EXPECT_EQ(late.verdict().text, "What the timestep costs is not known here. F9 measures again.");
    late.control({.restarts = true}, false);
    wait_for_copies(late, time + 4 * period);
    EXPECT_EQ(late.verdict().text.find("F9"), std::string::npos);
    EXPECT_EQ(first_rate, 20);
}

/// A fall at 10 Hz whose setting may change in play, or not.
template <bool changes>
struct Falling {
    static constexpr About about{
        .name = "falling", .title = "Falling", .rate = 10, .changes_in_play = changes};
    World world;
    explicit Falling(const Settings& settings) : world(1, settings) {
        world.set_gravity({-10});
        (void)world.spawn(Body{});
    }
    void update(const Input&) {}
    [[nodiscard]] Picture picture() const { return {}; }
};

/// Plays until there is a verdict, then goes back.
template <bool changes>
struct PlayInThePast : Live<Falling<changes>> {
    using Live<Falling<changes>>::play;

    PlayInThePast() : Live<Falling<changes>>(at_10_hz()) {
        for (int i = 0; i < 5; ++i) frame();
        while (play.verdict().grade == Verdict::Grade::unknown) show();
        known = play.verdict().text;
        for (int i = 0; i < 3; ++i) frame({.rewinds = true});
    }
    void frame(const Requests& requests = {}) {
        time += std::chrono::milliseconds(100);
        show(requests);
    }
    /// Leaves time to the runs that play along.
    void show(const Requests& requests = {}) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        play.measure();
        play.control(requests, false);
        (void)play.play(time);
    }

    std::chrono::nanoseconds time{0};
    std::string known;
};

// The last verdict names a remedy, which stays true of the play until there.
TEST(VerdictsBeforeGoingBack, StayUntilThereIsANewOne) {
    PlayInThePast<true> back;
    EXPECT_TRUE(holds(back.known, "10 Hz semi_implicit_euler")) << back.known;
    EXPECT_EQ(back.play.verdict().text,
              "Before you went back: " + back.known + " Playing on measures again.");
    EXPECT_EQ(back.play.verdict().grade, Verdict::Grade::unknown);
    back.frame();
    EXPECT_FALSE(holds(back.play.verdict().text, "Before"));
}

TEST(VerdictsBeforeGoingBack, StayWhereNothingIsMeasuredFromThereOn) {
    PlayInThePast<false> back;
    for (int i = 0; i < 3; ++i) {
        const std::string text = back.play.verdict().text;
        EXPECT_EQ(text, "Before you went back: " + back.known + " F9 measures again.");
        back.frame();
    }
    back.frame({.restarts = true});
    EXPECT_FALSE(holds(back.play.verdict().text, "Before"));
}

TEST_F(LivePlayTest, AQuietRunMeasuresNothing) {
    EXPECT_EQ(play.figures(), nullptr);
    EXPECT_EQ(play.no_verdict(), "what the timestep costs is not measured with --quiet");
    EXPECT_TRUE(play.ghosts().empty());
}

}  // namespace
}  // namespace oiler::test
