// SPDX-License-Identifier: MIT
// The costs of the timestep that are measured while a game is played.
#include "oiler/whatif/live_what_if.hpp"

#include "oiler/sim/bodies.hpp"
#include "oiler/whatif/rate_advice.hpp"
#include "support/test.hpp"

#include <atomic>
#include <stdexcept>

namespace oiler::test {
namespace {

using Grade = Verdict::Grade;

/// A fall from a height of 0 that Space pushes up.
struct Fall {
    static constexpr About about{.name = "fall", .title = "Fall", .rate = 60};
    World world;
    Entity body;
    explicit Fall(const Settings& settings) : world(1, settings), body(world.spawn(Body{})) {
        world.set_gravity({-20});
    }
    void update(const Input& input) {
        if (input.pressed(Key::space)) world.set_velocity(body, {9});
    }
    [[nodiscard]] Picture picture() const { return {.camera = {.height = 7.2F}}; }
};

std::unique_ptr<AnyGame> make_fall(const Settings& settings) {
    return std::make_unique<AnyGameOf<Fall>>(settings);
}

/// Presses Space in step 30.
struct OnePress final : InputSource {
    InputQueue queue;
    Input next(std::int64_t step) override {
        queue.set(Key::space, step == 30);
        return queue.take({});
    }
};

const Stepping euler{.method = &find_method("semi_implicit_euler"), .rate = {60}};

struct NoPress final : InputSource {
    Input next(std::int64_t) override { return {}; }
};

/// A game that is played while what it costs is measured, in the time that this needs.
template <class G = Fall, class Player = OnePress>
struct Measured {
    explicit Measured(const Stepping& stepping = euler) : settings{.stepping = stepping} {
        along.start(0);
    }

    Settings settings;
    AnyGameOf<G> game{settings};
    Player player;
    MakeGame make = [](const Settings& own) { return std::make_unique<AnyGameOf<G>>(own); };
    LiveWhatIf along{{settings}, make, LiveWhatIf::Pace::own};
    InputTap tap{player, along};
};

// Semi-implicit Euler falls g·dt·t/2 too deep: 20/60·2/2 = 33 cm in 2 s, of which the push at 0.5 s
// takes nothing back.
void expect_measured_untouched(LiveWhatIf::Pace pace) {
    const Settings settings{
        .stepping = {.method = &find_method("semi_implicit_euler"), .rate = {60}}};
    AnyGameOf<Fall> game(settings);
    AnyGameOf<Fall> alone(settings);
    OnePress player;
    OnePress other;
    const MakeGame make = make_fall;
    LiveWhatIf along({settings}, make, pace);
    along.start(0);
    InputTap tap(player, along);
    EXPECT_EQ(along.figures().verdict.grade, Grade::unknown);
    for (const std::int64_t second : {0, 1}) {
        game.step(60 * second, 60, tap);
        alone.step(60 * second, 60, other);
        const std::int64_t now = 60 * (second + 1);
        while (along.behind(now) > 0) along.play_until(now);
    }
    EXPECT_EQ(game.state_hash(), alone.state_hash());
    while (!along.figures().measured || along.figures().measured->measured_until < 2)
        along.play_until(120);
    const WhatIf result = *along.figures().measured;
    EXPECT_NEAR(result.runs[0].distance, 20 * 2 / 60.0 / 2, 1e-12);
    EXPECT_EQ(result.runs[0].readings.size(), 0U);
    const auto off = [&](double alpha) {
        const std::vector<Ghost> ghosts = along.ghosts(120, alpha);
        EXPECT_EQ(ghosts.size(), 1U);
        return ghosts.at(0).truth[0] - ghosts.at(0).at[0];
    };
    const double before = 20 * (119 / 60.0) / 60 / 2;
    EXPECT_NEAR(off(1), 20 * 2 / 60.0 / 2, 1e-12);
    EXPECT_NEAR(off(0), before, 1e-12);
    // The game is drawn on a straight line, from which a fall is g·dt²/8 away in the middle.
    const double sagitta = 20 / 60.0 / 60 / 8;
    EXPECT_NEAR(off(0.5), (20 * 2 / 60.0 / 2 + before) / 2 + sagitta, 1e-12);
    EXPECT_NEAR(off(0.75), (3 * 20 * 2 / 60.0 / 2 + before) / 4 + 0.75 * sagitta, 1e-12);
    // Between the sixteenths of a step, here 4 and 5, the true motion is a straight line, too:
    // 4a(1 − a) is 0.75 and 0.859375 there.
    EXPECT_NEAR(off(4.5 / 16),
                before + 4.5 / 16 * (20 * 2 / 60.0 / 2 - before) + (0.75 + 0.859375) / 2 * sagitta,
                1e-12);
    EXPECT_EQ(along.ghosts(120, 1)[0].at[0], game.world().bodies().position(0)[0]);
    EXPECT_TRUE(along.ghosts(121, 1).empty()) << "not played yet";
    EXPECT_EQ(along.figures().errors.size(), 121U) << "the beginning, and each step";
    EXPECT_NEAR(along.figures().errors.back(), 1 / 3.0, 1e-6);
    along.stop("went back");
    EXPECT_TRUE(along.ghosts(120, 1).empty());
    EXPECT_EQ(along.figures().verdict.text, "went back");
    EXPECT_EQ(along.figures().verdict.grade, Grade::unknown);
}

TEST(LiveWhatIf, MeasuresTheGameThatItNeverTouches) {
    expect_measured_untouched(LiveWhatIf::Pace::aside);
}
TEST(LiveWhatIf, NeedsNoThread) { expect_measured_untouched(LiveWhatIf::Pace::frame); }

// Semi-implicit Euler falls g·dt/2·t too deep in the time t since its start. A run that begins at 1
// s with velocity Verlet's state is off by the second after it only. The reference rounds positions
// below 64 m, to 2⁻⁴⁷ m at most, 15,360 times: by 109 pm if all were in one direction.
TEST(LiveWhatIf, BeginsAgainWithTheGameAsItIs) {
    Measured<> measured({.method = &find_method("velocity_verlet"), .rate = {60}});
    auto& [settings, game, player, make, along, tap] = measured;
    EXPECT_EQ(along.figures().begin->time, 0);
    game.step(0, 60, tap);
    game.set_stepping({.method = &find_method("semi_implicit_euler"), .rate = {120}});
    const double energy = game.world().bodies().energy().total();
    along.start_from(game, 60);
    EXPECT_EQ(along.figures().begin->time, 1);
    EXPECT_EQ(along.figures().begin->energy, energy);
    EXPECT_EQ(along.figures().energy_scale.joules(), game.world().energy().kinetic);
    game.step(60, 120, tap);
    along.play_until(180);
    const WhatIf result = *along.figures().measured;
    EXPECT_NEAR(result.runs[0].distance, 20 * 1 / 120.0 / 2, 109e-12);
    ASSERT_EQ(result.runs[1].stepping.rate, Rate{60});
    EXPECT_NEAR(result.runs[1].distance, 20 * 1 / 60.0 / 2, 109e-12);
    ASSERT_EQ(result.runs[2].stepping.rate, Rate{240});
    EXPECT_EQ(along.ghosts(180, 1).at(0).at[0], game.world().bodies().position(0)[0]);
}

// Euler at 60 Hz falls 20/60·0.2/2 = 3.3 cm too deep in 0.2 s, and half of it at 120 Hz. Half of a
// pixel of 1 cm needs 120·1.67/0.5 = 400 Hz, and the next multiple of 60 that is offered is 480.
TEST(LiveWhatIf, ProvesTheAdvisedRateInTheNextRun) {
    Measured<> measured;
    auto& [settings, game, player, make, along, tap] = measured;
    game.step(0, 12, tap);
    along.play_until(12);
    const std::size_t usual = along.figures().measured->runs.size();
    along.repeat(12);
    EXPECT_EQ(rate_advice_text(*along.figures().measured),
              "About 480 Hz of this method would be within a pixel so far.");
    game.step(12, 12, tap);
    along.play_until(24);
    const std::vector<WhatIfRun> runs = along.figures().measured->runs;
    ASSERT_EQ(runs.size(), usual + 1);
    EXPECT_EQ(runs.back().stepping.rate, Rate{480});
    EXPECT_EQ(runs.back().stepping.method, settings.stepping.method);
    EXPECT_EQ(rate_advice_text(*along.figures().measured),
              "480 Hz of this method is within a pixel so far.");
    along.set_stepping({.method = settings.stepping.method, .rate = {120}});
    along.start(24);
    along.play_until(25);
    EXPECT_EQ(along.figures().measured->runs.size(), usual)
        << "of another setting, nothing is known";
}

/// Many bodies fall side by side.
template <int bodies>
struct Rain {
    static constexpr About about{.name = "rain", .title = "Rain", .rate = 60};
    World world;
    explicit Rain(const Settings& settings) : world(1, settings) {
        for (int i = 0; i < bodies; ++i) (void)world.spawn(Body{});
        world.set_gravity({-20});
    }
    void update(const Input&) {}
    [[nodiscard]] Picture picture() const { return {.camera = {.height = 7.2F}}; }
};

template <class G>
void expect_chord_of_a_fall(std::int64_t rate) {
    Measured<G, NoPress> measured({.method = &find_method("velocity_verlet"), .rate = {rate}});
    measured.game.step(0, 2, measured.tap);
    measured.along.play_until(2);
    const double chord = 20.0 / static_cast<double>(rate * rate) / 8;
    const LiveFigures& figures = measured.along.figures();
    EXPECT_NEAR(figures.measured->runs.front().distance, chord, 1e-14);
    EXPECT_NEAR(figures.errors.back(), chord, 1e-9);
    const std::vector<Ghost> ghosts = measured.along.ghosts(2, 0.5);
    ASSERT_EQ(ghosts.size(), most_ghosts);
    EXPECT_NEAR(ghosts.front().truth[0] - ghosts.front().at[0], chord, 1e-14);
}

// A line between two steps is off by a·dt²/8 in its middle.
TEST(LiveWhatIf, ComparesManyBodiesInTheMiddleOfEachStep) {
    for (const std::int64_t rate : {50, 60, 240, 600, 1000}) {
        expect_chord_of_a_fall<Rain<101>>(rate);
        expect_chord_of_a_fall<Rain<2001>>(rate);
    }
}

// Euler is 11 cm off after 40 steps, so no offered rate is expected within half a pixel: 8, 16 and
// 32 times the rate are tried in the next round, which the press in the last one does not hinder.
TEST(LiveWhatIf, TriesRatesAfterARoundWithInput) {
    Measured<> measured;
    measured.game.step(0, 40, measured.tap);
    measured.along.play_until(40);
    measured.along.repeat(40);
    measured.game.step(40, 2, measured.tap);
    measured.along.play_until(42);
    EXPECT_FALSE(measured.along.figures().repeats);
    std::vector<std::int64_t> rates;
    for (const WhatIfRun& run : measured.along.figures().measured->runs)
        rates.push_back(run.stepping.rate.steps);
    for (const std::int64_t rate : {480, 960, 1920})
        EXPECT_EQ(std::ranges::count(rates, rate), 1) << rate;
}

struct MovesTheMouse final : InputSource {
    InputQueue queue;
    Input next(std::int64_t step) override {
        queue.point_at(Point{static_cast<float>(step), 100});
        return queue.take({});
    }
};

TEST(LiveWhatIf, AMouseThatMovesAndTheRestartMakeNoOtherRound) {
    Measured<Fall, MovesTheMouse> measured;
    auto& [settings, game, player, make, along, tap] = measured;
    for (const std::int64_t from : {0, 12}) {
        game.step(from, 12 - from / 2, tap);
        along.play_until(12 + from / 2);
        EXPECT_NEAR(along.figures().measured->runs.front().distance, 20 * 0.2 / 60 / 2, 1e-12);
        if (from > 0) continue;
        along.repeat(12);
        player.queue.restart();
    }
    EXPECT_TRUE(along.figures().repeats);
    EXPECT_NEAR(along.figures().energy_scale.joules(), 20 * 20 / 3600.0 * 78, 1e-12)
        << "g·h of the whole round";
    player.queue.restart();
    game.step(18, 1, tap);
    along.play_until(19);
    EXPECT_FALSE(along.figures().repeats) << "a restart in a round";
}

// What a round of 12 steps found stands in the next one until that has found as much.
TEST(LiveWhatIf, ARoundWithoutInputStandsUntilTheNextOneHasBeenMeasured) {
    Measured<> measured;
    LiveWhatIf& along = measured.along;
    const auto play = [&](std::int64_t from, std::int64_t count) {
        measured.game.step(from, count, measured.tap);
        along.play_until(from + count);
        return along.figures().measured ? along.figures().measured->runs.front().distance : -1;
    };
    const double off = play(0, 12);
    EXPECT_NEAR(off, 20 * 0.2 / 60 / 2, 1e-12);
    along.repeat(12);
    EXPECT_EQ(play(12, 6), off);
    EXPECT_TRUE(along.figures().repeats);
    EXPECT_EQ(play(18, 6), off);
    EXPECT_FALSE(along.figures().repeats) << "it has found as much";
    along.repeat(24);
    EXPECT_EQ(play(24, 6), off);
    EXPECT_NEAR(play(30, 1), 20 * (7 / 60.0) / 60 / 2, 1e-12) << "a press: another round";
    EXPECT_FALSE(along.figures().repeats);
    along.repeat(31);
    EXPECT_NEAR(play(31, 3), 20 * (3 / 60.0) / 60 / 2, 1e-12) << "the last round had input";
    along.repeat(34);
    EXPECT_NEAR(play(34, 2), 20 * (2 / 60.0) / 60 / 2, 1e-12) << "a release is input, too";
    along.start(36);
    EXPECT_NEAR(play(36, 1), 20 * (1 / 60.0) / 60 / 2, 1e-12);
    along.start_from(measured.game, 37);
    EXPECT_NEAR(play(37, 3), 20 * (3 / 60.0) / 60 / 2, 1e-12);
    along.repeat(40);
    EXPECT_NEAR(play(40, 2), 20 * (2 / 60.0) / 60 / 2, 1e-12) << "another beginning";
}

/// A fall that Space begins anew.
struct FallAgain : Fall {
    using Fall::Fall;
    void update(const Input& input) {
        if (input.pressed(Key::space)) *this = FallAgain(world.settings());
    }
};

// Semi-implicit Euler falls g·dt·t/2 too deep in the time t since the body was put back.
TEST(LiveWhatIf, ForgetsTheErrorAndTheWayOfABodyThatIsPutBack) {
    Measured<FallAgain> measured;
    auto& [settings, game, player, make, along, tap] = measured;
    game.step(0, 31, tap);
    along.play_until(31);
    EXPECT_NEAR(along.figures().errors.at(30), 20 * 0.5 / 60 / 2, 1e-6);
    EXPECT_NEAR(along.figures().errors.at(31), 20 / 60.0 / 60 / 2, 1e-6);
    EXPECT_TRUE(along.ghosts(31, 0.5).empty()) << "there is no way over a cut";
    game.step(31, 1, tap);
    along.play_until(32);
    EXPECT_EQ(along.ghosts(32, 0.5).size(), 1U);
}

/// A body that is faster at longer steps, which no timestep makes right.
struct Careless : Fall {
    using Fall::Fall;
    void update(const Input&) { world.set_velocity(body, {100 * world.dt()}); }
};

// In a step the body moves by (100 − 20/2)·dt². The reference and its check, whose dt is more than
// twice as long, get apart by 90·dt m/s or more, dt being 1/7680 s: by a pixel of 1 cm in 0.9 s.
TEST(LiveWhatIf, ListsErrorsAsLongAsTheReferenceIsCertain) {
    Measured<Careless> measured;
    measured.game.step(0, 60, measured.tap);
    measured.along.play_until(60);
    const double until = measured.along.figures().measured->certain_until;
    EXPECT_LT(until, 0.9);
    EXPECT_EQ(measured.along.figures().errors.size(),
              static_cast<std::size_t>(std::lround(60 * until)) + 1)
        << "the beginning, and each certain step";
}

// Euler evaluates the forces once a step, rk4 four times.
TEST(LiveWhatIf, CountsTheForcesOfEachSetting) {
    Measured<> measured;
    auto& [settings, game, player, make, along, tap] = measured;
    game.step(0, 60, tap);
    along.play_until(60);
    const std::vector<WhatIfRun> runs = along.figures().measured->runs;
    for (const WhatIfRun& run : runs) {
        const double per_step = run.stepping.method->name == "rk4"               ? 4
                                : run.stepping.method->name == "velocity_verlet" ? 2
                                                                                 : 1;
        EXPECT_NEAR(run.evaluations, per_step * static_cast<double>(run.stepping.rate.steps), 1e-9)
            << run.stepping.method->name;
    }
}

// Half the speed of 20 m/s after 1 s is 200 J; the game falls on, but nobody knows how far.
TEST(LiveWhatIf, HasNoScaleOfTheEnergyOnceItHasStopped) {
    Measured<> measured;
    measured.along.play_until(60);
    EXPECT_GT(measured.along.figures().energy_scale.joules(), 180);
    measured.along.stop("too slow");
    EXPECT_EQ(measured.along.figures().energy_scale.joules(), 0);
}

/// A game whose copies wait in their first step until the test lets them go.
struct Held : Fall {
    static inline std::atomic<bool> go = false;
    using Fall::Fall;
    void update(const Input& /*input*/, Loop& loop) {
        if (loop.is_rehearsal()) go.wait(false);
    }
};

TEST(LiveWhatIf, AGameNeverWaitsForTheRunsThatLagBehind) {
    Held::go = false;
    const Settings settings{.stepping = euler};
    const MakeGame make = [](const Settings& own) {
        return std::make_unique<AnyGameOf<Held>>(own);
    };
    LiveWhatIf along({settings}, make);
    along.start(0);
    for (int step = 1; step <= 30; ++step) along.play_until(step);
    EXPECT_GE(along.behind(30), 30);
    Held::go = true;
    Held::go.notify_all();
    while (along.behind(30) > 0 || !along.figures().measured ||
           along.figures().measured->measured_until < 0.5)
        along.play_until(30);
    EXPECT_NEAR(along.figures().measured->runs[0].distance, 20 * 0.5 / 60 / 2, 1e-12);
}

TEST(LiveWhatIf, ACopyThatFailsEndsTheMeasuringAlone) {
    const MakeGame make = [](const Settings&) -> std::unique_ptr<AnyGame> {
        throw std::length_error("too long");
    };
    LiveWhatIf along({Settings{.stepping = euler}}, make);
    along.start(0);
    while (!along.figures().has_stopped) along.play_until(1);
    EXPECT_EQ(along.figures().verdict.text, "too long");
    EXPECT_EQ(along.figures().verdict.grade, Grade::unknown);
}

/// A game of too many bodies to be copied, which counts how often it was made.
struct Crowd {
    static constexpr About about{.name = "crowd", .title = "Crowd", .rate = 60};
    static inline std::atomic<int> made = 0;
    World world;
    explicit Crowd(const Settings& settings) : world(1, settings) {
        ++made;
        for (std::size_t i = 0; i <= most_measured_bodies; ++i)
            (void)world.spawn(Body{.velocity = {2}});
    }
    void update(const Input&) {}
};

// Kinetic energy: 100,001 bodies of 1 kg at 2 m/s have 2 J each.
TEST(LiveWhatIf, AGameOfTooManyBodiesIsMadeOnceForAllItsRounds) {
    Measured<Crowd> measured;
    const int made = Crowd::made;
    for (const std::int64_t round : {10, 20, 30}) {
        measured.along.repeat(round);
        measured.along.play_until(round + 5);
        const LiveFigures& figures = measured.along.figures();
        EXPECT_TRUE(figures.has_stopped);
        EXPECT_EQ(figures.verdict.text, "");
        EXPECT_EQ(figures.begin.value().energy, 2.0 * (most_measured_bodies + 1));
    }
    EXPECT_EQ(Crowd::made, made);
    measured.along.start(40);
    EXPECT_EQ(Crowd::made, made + 1) << "it may be another game";
}

// A game that counts what leaves it, on its own thread.
struct Sounds : Fall {
    static inline int heard = 0;
    using Fall::Fall;
    void update(const Input& /*input*/, Loop& loop) {
        if (!loop.is_rehearsal()) ++heard;
    }
};

TEST(LiveWhatIf, ItsRunsAreRehearsals) {
    Sounds::heard = 0;
    Measured<Sounds> measured;
    measured.game.step(0, 20, measured.tap);
    measured.along.play_until(20);
    measured.along.start_from(measured.game, 20);
    measured.game.step(20, 10, measured.tap);
    measured.along.play_until(30);
    EXPECT_EQ(Sounds::heard, 30);
}

/// A game without bodies.
struct Empty {
    static constexpr About about{.name = "empty", .title = "Empty", .rate = 60};
    World world;
    explicit Empty(const Settings& settings) : world(1, settings) {}
    void update(const Input&) {}
};

TEST(LiveWhatIf, ClaimsNoErrorOfAGameWithoutBodies) {
    Measured<Empty> measured({.rate = {60}});
    auto& [settings, game, player, make, along, tap] = measured;
    game.step(0, 60, tap);
    along.play_until(60);
    EXPECT_EQ(along.figures().verdict.text, "");
    EXPECT_EQ(along.figures().verdict.grade, Grade::unknown);
}

}  // namespace
}  // namespace oiler::test
