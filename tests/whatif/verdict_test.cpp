// SPDX-License-Identifier: MIT
// The sentence that a window shows: what it names, what it calls good, and what it does not claim.
#include "oiler/whatif/verdict.hpp"

#include <chrono>
#include <thread>

#include "oiler/app/playback.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/whatif/play_along.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Grade = Verdict::Grade;

std::string name_of(Entity entity) { return "body " + std::to_string(entity.index); }

WhatIfRun run_of(const char* method, int rate, double distance, double nanoseconds) {
    WhatIfRun run;
    run.stepping = {.method = &find_method(method), .rate = {rate}};
    run.distance = distance;
    run.furthest = Entity{3, 0};
    run.costs.step = nanoseconds;
    return run;
}

/// A pixel is 1 cm. Euler at 60 Hz is off by `distance`; velocity Verlet and 120 Hz are rivals.
WhatIf measured(double distance, double of_verlet, double of_twice) {
    WhatIf result;
    result.duration = result.certain_until = 4;
    result.uncertainty = 1e-6;
    result.pixel = 0.01;
    result.runs = {run_of("semi_implicit_euler", 60, distance, 1'000'000),
                   run_of("velocity_verlet", 60, of_verlet, 1'300'000),
                   run_of("semi_implicit_euler", 120, of_twice, 2'000'000)};
    return result;
}
Verdict judge(const WhatIf& result, const std::vector<Reading>& before = {}, double begin = 0) {
    return judge_setting(result, before, begin, name_of);
}

TEST(Verdict, NamesTheBodyThePixelsAndTheCheapestCure) {
    const Verdict verdict = judge(measured(0.04, 0.002, 0.001));
    EXPECT_EQ(verdict.grade, Grade::visible);
    EXPECT_EQ(verdict.text,
              "body 3 up to 4 cm off, 4 px, at 60 Hz semi_implicit_euler. velocity_verlet: 2 mm "
              "off, +300 µs a frame.");
    EXPECT_EQ(judge(measured(0.073, 0.02, 0.001)).grade, Grade::bad) << "a hundredth of 720 lines";
    EXPECT_TRUE(
        holds(judge(measured(0.073, 0.02, 0.001)).text, ". 120 Hz: 1 mm off, +1000 µs a frame."));
    EXPECT_TRUE(judge(measured(0.073, 0.04, 0.04)).text.ends_with("semi_implicit_euler."))
        << "nothing mends it";
    EXPECT_TRUE(holds(judge(measured(0.073, 5e-6, 0.02)).text, "velocity_verlet: exact,"));
}

// With ten uncertainties of 2.5 cm, an error of 4 cm is known, and one of 2 mm is not.
TEST(Verdict, ClaimsNothingThatTheReferenceDoesNotKnow) {
    WhatIf result = measured(0.04, 0.001, 0.002);
    result.uncertainty = 0.0025;
    EXPECT_TRUE(judge(result).text.ends_with("semi_implicit_euler.")) << judge(result).text;
    result.uncertainty = 0.002;
    EXPECT_TRUE(holds(judge(result).text, "velocity_verlet: less than 2 cm off,"));
    result.uncertainty = 0.005;
    EXPECT_EQ(judge(result).grade, Grade::unknown);
    EXPECT_EQ(judge(result).text,
              "Off by less than 5 cm at 60 Hz semi_implicit_euler. The true motion is not known "
              "better.");
    result = measured(0.04, 5e-6, 0.02);
    result.uncertainty = 1.1e-5;
    EXPECT_TRUE(holds(judge(result).text, "less than 0.11 mm off,")) << "a pixel is 1 cm";
}

TEST(Verdict, SaysWhereACureIsOffOnlyBetweenSteps) {
    WhatIf result = measured(0.04, 0.002, 0.02);
    result.runs[1].distance_at_steps = 5e-6;
    EXPECT_TRUE(holds(judge(result).text, "velocity_verlet: exact at the steps, "));
    result.runs[1].distance_at_steps = 5e-5;
    EXPECT_TRUE(holds(judge(result).text, "velocity_verlet: 2 mm off, "));
    result = measured(0.04, 0.012, 0.03);
    result.runs[1].distance_at_steps = 5e-6;
    EXPECT_TRUE(holds(judge(result).text, "velocity_verlet: 1.2 cm off, ")) << "a pixel is seen";
}

TEST(Verdict, TellsTimesOfTheGame) {
    WhatIf result = measured(0.04, 0.002, 0.001);
    result.certain_until = 2.5;
    EXPECT_TRUE(holds(judge(result).text, "After 2.5 s the"));
    EXPECT_TRUE(holds(judge(result, {}, 3).text, "After 5.5 s the"));
    result.runs[0].other_play_from = 0.5;
    EXPECT_TRUE(judge(result, {}, 3).text.starts_with("From 3.5 s on"));
}

TEST(Verdict, IsGoodBelowAPixelAndUnknownWithoutAReference) {
    const Verdict good = judge(measured(0.009, 0, 0));
    EXPECT_EQ(good.grade, Grade::good);
    EXPECT_EQ(good.text,
              "Drawn within 9 mm of the true motion, less than a pixel, at 60 Hz "
              "semi_implicit_euler.");
    EXPECT_TRUE(holds(judge(measured(1e-7, 0, 0)).text, "within 10 µm")) << "no more is known";
    WhatIf unsure = measured(0.001, 0, 0);
    unsure.uncertainty = 0.003;
    EXPECT_EQ(judge(unsure).grade, Grade::unknown) << "it may be off by three pixels";
    EXPECT_EQ(judge(unsure).text,
              "Off by less than 3 cm at 60 Hz semi_implicit_euler. The true motion is not known "
              "better.");
    WhatIf still = measured(0, 0, 0);
    still.uncertainty = 0;
    EXPECT_EQ(judge(still).text, "No error so far at 60 Hz semi_implicit_euler.");
    WhatIf unknown = measured(1, 0, 0);
    unknown.certain_until = 0;
    EXPECT_EQ(judge(unknown).grade, Grade::unknown);
    EXPECT_FALSE(holds(judge(unknown).text, "1 m")) << "never a guess";
    WhatIf early = measured(0.009, 0, 0);
    early.certain_until = 2.25;
    EXPECT_TRUE(judge(early).text.ends_with(" After 2.2 s the true motion is not known."));
}

TEST(Verdict, NamesTheBestSettingIfNoneIsBelowAPixel) {
    EXPECT_TRUE(
        judge(measured(0.9, 0.5, 0.3)).text.ends_with(" 120 Hz: 30 cm off, +1000 µs a frame."));
    EXPECT_TRUE(judge(measured(0.9, 0.5, 0.6)).text.ends_with(" semi_implicit_euler."))
        << "less than half is no cure";
    EXPECT_TRUE(judge(measured(900, 7.1, 8)).text.ends_with(" 7.1 m off, +300 µs a frame."));
    EXPECT_TRUE(judge(measured(900, 7.3, 8)).text.ends_with(" semi_implicit_euler."))
        << "beyond the 720 lines of the picture";
    WhatIf cheap = measured(0.9, 0.001, 0.002);
    cheap.runs[0].costs.step = 500;
    cheap.runs[1].costs.step = 10'000;
    EXPECT_TRUE(judge(cheap).text.ends_with("1 mm off, for about the same time."));
    cheap.runs[1].costs.step = cheap.runs[2].costs.step = 9'999;
    cheap.runs[1].evaluations = 120;
    cheap.runs[2].evaluations = 119;
    EXPECT_TRUE(judge(cheap).text.ends_with(" 120 Hz: 2 mm off, below 10 µs a frame."))
        << "fewer forces";
    EXPECT_TRUE(holds(judge(measured(1e9, 1e9, 1e9)).text, "1.0e+09 m off, more than 99999 px"));
}

TEST(Verdict, LengthsHaveUnitsOfTheirSize) {
    EXPECT_EQ(length_text(0), "0 m");
    EXPECT_EQ(length_text(3e-13), "3e-13 m");
    EXPECT_EQ(length_text(1.06e-10), "0.11 nm");
    EXPECT_EQ(length_text(2.5e-8), "25 nm");
    EXPECT_EQ(length_text(4.9e-7), "0.49 µm");
    EXPECT_EQ(length_text(2.5e-6), "2.5 µm");
    EXPECT_EQ(length_text(1.3e-5), "13 µm");
    EXPECT_EQ(length_text(0.0025), "2.5 mm");
    EXPECT_EQ(length_text(0.075), "7.5 cm");
    EXPECT_EQ(length_text(0.997), "0.997 m");
    EXPECT_EQ(length_text(3.14159), "3.14 m");
    EXPECT_EQ(length_text(999.7), "1000 m");
    EXPECT_EQ(length_text(12345.6), "12346 m");
    EXPECT_EQ(length_text(5e96), "5.0e+96 m");
}

TEST(Verdict, NamesReadingsAtRestFirst) {
    WhatIf result = measured(0.04, 0.002, 0.001);
    result.runs[0].readings = {{"apex", 1.95, "m"}, {"score", 3}, {"speed", 5, "m/s"}};
    result.reference.readings = {{"apex", 2.025, "m"}, {"score", 4}, {"speed", 5.001, "m/s"}};
    result.check.readings = result.reference.readings;
    EXPECT_FALSE(holds(judge(result).text, "apex")) << "it may still grow";
    EXPECT_EQ(judge(result, result.runs[0].readings).text,
              "apex 1.95 m, true 2.025 m: 7.5 cm too low at 60 Hz semi_implicit_euler. "
              "velocity_verlet: 2 mm off, +300 µs a frame.");
    result.reference.readings[0].value = 1.9;
    result.check.readings[0].value = 1.9;
    EXPECT_TRUE(holds(judge(result, result.runs[0].readings).text, "5 cm too high"));
    result.check.readings[0].value = 1.906;
    EXPECT_FALSE(holds(judge(result, result.runs[0].readings).text, "apex"))
        << "the reference is unsure by 6 mm";
    result.reference.readings[0].value = result.check.readings[0].value = 1.955;
    EXPECT_FALSE(holds(judge(result, result.runs[0].readings).text, "apex"))
        << "no more than a pixel";
    result.reference.readings[2].value = result.check.readings[2].value = 4;
    EXPECT_TRUE(
        holds(judge(result, result.runs[0].readings).text, "speed 5 m/s, true 4 m/s: 1 m/s too"));
}

TEST(Verdict, NamesTheFailureOfTheGameAndItsCure) {
    WhatIf result = measured(0.001, 0.002, 0.001);
    result.runs[0].failure = "diverged at step 8";
    EXPECT_EQ(judge(result).grade, Grade::bad);
    EXPECT_EQ(judge(result).text, "diverged at step 8 velocity_verlet: 2 mm off, +300 µs a frame.");
    result.runs[1].failure = "diverged, too";
    EXPECT_EQ(judge(result).text, "diverged at step 8 120 Hz: 1 mm off, +1000 µs a frame.");
}

TEST(Verdict, SaysWhenThePlayIsAnotherOne) {
    WhatIf result = measured(0.001, 0.002, 0.001);
    result.runs[0].other_play_from = 3.25;
    result.runs[1].other_play_from = 1;
    EXPECT_EQ(judge(result).grade, Grade::bad);
    EXPECT_EQ(
        judge(result).text,
        "From 3.2 s on, other things happen at 60 Hz semi_implicit_euler than in the true motion. "
        "120 Hz: 1 mm off, +1000 µs a frame.");
}

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

// Semi-implicit Euler falls g·dt·t/2 too deep: 20/60·2/2 = 33 cm in 2 s, of which the push at 0.5 s
// takes nothing back.
TEST(PlayAlong, MeasuresTheGameThatItNeverTouches) {
    const Settings settings{
        .stepping = {.method = &find_method("semi_implicit_euler"), .rate = {60}}};
    AnyGameOf<Fall> game(settings);
    AnyGameOf<Fall> alone(settings);
    OnePress player;
    OnePress other;
    const MakeGame make = make_fall;
    PlayAlong along(player, {settings}, make);
    EXPECT_EQ(along.verdict().grade, Grade::unknown);
    for (const std::int64_t second : {0, 1}) {
        game.step(60 * second, 60, along);
        alone.step(60 * second, 60, other);
        const std::int64_t now = 60 * (second + 1);
        for (int i = 0; i < 10'000 && along.behind(now) > 0; ++i) along.play_until(now);
        ASSERT_EQ(along.behind(now), 0);
    }
    EXPECT_EQ(game.state_hash(), alone.state_hash());
    const WhatIf result = along.result();
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
    EXPECT_EQ(along.errors().size(), 121U) << "the beginning, and each step";
    EXPECT_NEAR(along.errors().back(), 1 / 3.0, 1e-6);
    along.stop("went back");
    EXPECT_TRUE(along.ghosts(120, 1).empty());
    EXPECT_EQ(along.verdict().text, "went back");
    EXPECT_EQ(along.verdict().grade, Grade::unknown);
}

// Semi-implicit Euler falls g·dt/2·t too deep in the time t since its start. A run that begins at 1
// s with velocity Verlet's state is off by the second after it only. The reference rounds positions
// below 64 m, to 2⁻⁴⁷ m at most, 1920 times: 14 pm.
TEST(PlayAlong, BeginsAgainWithTheGameAsItIs) {
    const Settings settings{.stepping = {.method = &find_method("velocity_verlet"), .rate = {60}}};
    AnyGameOf<Fall> game(settings);
    OnePress player;
    const MakeGame make = make_fall;
    PlayAlong along(player, {settings}, make, PlayAlong::Pace::own);
    EXPECT_EQ(along.begin()->time, 0);
    game.step(0, 60, along);
    game.set_stepping({.method = &find_method("semi_implicit_euler"), .rate = {120}});
    const double energy = game.world().bodies().energy().total();
    along.start_from(game, 60);
    EXPECT_EQ(along.begin()->time, 1);
    EXPECT_EQ(along.begin()->energy, energy);
    game.step(60, 120, along);
    along.play_until(180);
    const WhatIf result = along.result();
    EXPECT_NEAR(result.runs[0].distance, 20 * 1 / 120.0 / 2, 14e-12);
    ASSERT_EQ(result.runs[1].stepping.rate, Rate{60});
    EXPECT_NEAR(result.runs[1].distance, 20 * 1 / 60.0 / 2, 14e-12);
    ASSERT_EQ(result.runs[2].stepping.rate, Rate{240});
    EXPECT_EQ(along.ghosts(180, 1).at(0).at[0], game.world().bodies().position(0)[0]);
}

// Euler at 60 Hz falls 20/60·0.2/2 = 3.3 cm too deep in 0.2 s, and half of it at 120 Hz. Half of a
// pixel of 1 cm needs 120·1.67/0.5 = 400 Hz, and the next multiple of 60 that is offered is 480.
TEST(PlayAlong, ProvesTheAdvisedRateInTheNextRun) {
    const Settings settings{
        .stepping = {.method = &find_method("semi_implicit_euler"), .rate = {60}}};
    AnyGameOf<Fall> game(settings);
    OnePress player;
    const MakeGame make = make_fall;
    PlayAlong along(player, {settings}, make, PlayAlong::Pace::own);
    const std::size_t usual = along.result().runs.size();
    game.step(0, 12, along);
    along.play_until(12);
    along.repeat(12);
    const std::vector<WhatIfRun> runs = along.result().runs;
    ASSERT_EQ(runs.size(), usual + 1);
    EXPECT_EQ(runs.back().stepping.rate, Rate{480});
    EXPECT_EQ(runs.back().stepping.method, settings.stepping.method);
    EXPECT_EQ(rate_advice_text(*along.measured()),
              "About 480 Hz of this method would be within a pixel so far.");
    game.step(12, 12, along);
    along.play_until(24);
    (void)along.verdict();
    EXPECT_EQ(rate_advice_text(*along.measured()),
              "480 Hz of this method is within a pixel so far.");
    along.start(24, {.method = settings.stepping.method, .rate = {120}});
    EXPECT_EQ(along.result().runs.size(), usual) << "of another setting, nothing is known";
}

struct MovesTheMouse final : InputSource {
    InputQueue queue;
    Input next(std::int64_t step) override {
        queue.point_at(Point{static_cast<float>(step), 100});
        return queue.take({});
    }
};

TEST(PlayAlong, AMouseThatMovesAndTheRestartMakeNoOtherRound) {
    const Settings settings{
        .stepping = {.method = &find_method("semi_implicit_euler"), .rate = {60}}};
    AnyGameOf<Fall> game(settings);
    MovesTheMouse player;
    const MakeGame make = make_fall;
    PlayAlong along(player, {settings}, make, PlayAlong::Pace::own);
    for (const std::int64_t from : {0, 12}) {
        game.step(from, 12 - from / 2, along);
        along.play_until(12 + from / 2);
        (void)along.verdict();
        EXPECT_NEAR(along.measured()->runs.front().distance, 20 * 0.2 / 60 / 2, 1e-12);
        if (from > 0) continue;
        along.repeat(12);
        player.queue.restart();
    }
    EXPECT_TRUE(along.repeats());
    EXPECT_NEAR(along.energy_scale(), 20 * 20 / 3600.0 * 78, 1e-12) << "g·h of the whole round";
    player.queue.restart();
    game.step(18, 1, along);
    along.play_until(19);
    (void)along.verdict();
    EXPECT_FALSE(along.repeats()) << "a restart in a round";
}

// What a round of 12 steps found stands in the next one until that has found as much.
TEST(PlayAlong, ARoundWithoutInputStandsUntilTheNextOneHasBeenMeasured) {
    const Settings settings{
        .stepping = {.method = &find_method("semi_implicit_euler"), .rate = {60}}};
    AnyGameOf<Fall> game(settings);
    OnePress player;  // in step 30
    const MakeGame make = make_fall;
    PlayAlong along(player, {settings}, make, PlayAlong::Pace::own);
    const auto play = [&](std::int64_t from, std::int64_t count) {
        game.step(from, count, along);
        along.play_until(from + count);
        (void)along.verdict();
        return along.measured() ? along.measured()->runs.front().distance : -1;
    };
    const double off = play(0, 12);
    EXPECT_NEAR(off, 20 * 0.2 / 60 / 2, 1e-12);
    along.repeat(12);
    EXPECT_EQ(play(12, 6), off);
    EXPECT_TRUE(along.repeats());
    EXPECT_EQ(play(18, 6), off);
    EXPECT_FALSE(along.repeats()) << "it has found as much";
    along.repeat(24);
    EXPECT_EQ(play(24, 6), off);
    EXPECT_NEAR(play(30, 1), 20 * (7 / 60.0) / 60 / 2, 1e-12) << "a press: another round";
    EXPECT_FALSE(along.repeats());
    along.repeat(31);
    EXPECT_NEAR(play(31, 3), 20 * (3 / 60.0) / 60 / 2, 1e-12) << "the last round had input";
    along.repeat(34);
    EXPECT_NEAR(play(34, 2), 20 * (2 / 60.0) / 60 / 2, 1e-12) << "a release is input, too";
    along.start(36);
    EXPECT_NEAR(play(36, 1), 20 * (1 / 60.0) / 60 / 2, 1e-12);
    along.start_from(game, 37);
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
TEST(PlayAlong, ForgetsTheErrorAndTheWayOfABodyThatIsPutBack) {
    const Settings settings{
        .stepping = {.method = &find_method("semi_implicit_euler"), .rate = {60}}};
    AnyGameOf<FallAgain> game(settings);
    OnePress player;  // in step 30
    const MakeGame make = [](const Settings& own) {
        return std::make_unique<AnyGameOf<FallAgain>>(own);
    };
    PlayAlong along(player, {settings}, make, PlayAlong::Pace::own);
    game.step(0, 31, along);
    along.play_until(31);
    EXPECT_NEAR(along.errors().at(30), 20 * 0.5 / 60 / 2, 1e-6);
    EXPECT_NEAR(along.errors().at(31), 20 / 60.0 / 60 / 2, 1e-6);
    EXPECT_TRUE(along.ghosts(31, 0.5).empty()) << "there is no way over a cut";
    game.step(31, 1, along);
    along.play_until(32);
    EXPECT_EQ(along.ghosts(32, 0.5).size(), 1U);
}

// Euler evaluates the forces once a step, rk4 four times.
TEST(PlayAlong, CountsTheForcesOfEachSetting) {
    const Settings settings{
        .stepping = {.method = &find_method("semi_implicit_euler"), .rate = {60}}};
    AnyGameOf<Fall> game(settings);
    OnePress player;
    const MakeGame make = make_fall;
    PlayAlong along(player, {settings}, make, PlayAlong::Pace::own);
    game.step(0, 60, along);
    along.play_until(60);
    for (const WhatIfRun& run : along.result().runs) {
        const double per_step = run.stepping.method->name == "rk4"               ? 4
                                : run.stepping.method->name == "velocity_verlet" ? 2
                                                                                 : 1;
        EXPECT_NEAR(run.evaluations, per_step * static_cast<double>(run.stepping.rate.steps), 1e-9)
            << run.stepping.method->name;
    }
}

/// A game whose update takes longer than the time that is left in a frame.
struct Slow : Fall {
    using Fall::Fall;
    void update(const Input&) { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }
};

TEST(PlayAlong, EndsAfterAFewStepsIfTheyTakeTooLong) {
    const Settings settings{.stepping = {.rate = {60}}};
    AnyGameOf<Fall> game(settings);
    OnePress player;
    const MakeGame make = [](const Settings& own) {
        return std::make_unique<AnyGameOf<Slow>>(own);
    };
    PlayAlong along(player, {settings}, make);
    int frames = 0;
    while (frames < 60 &&
           along.verdict().text.find("playing along takes longer") == std::string::npos)
        along.play_until(++frames);
    EXPECT_LE(frames, 9) << "the first comparison takes no step, and may be late";
    EXPECT_EQ(along.verdict().grade, Grade::unknown);
}

/// A game without bodies.
struct Empty {
    static constexpr About about{.name = "empty", .title = "Empty", .rate = 60};
    World world;
    explicit Empty(const Settings& settings) : world(1, settings) {}
    void update(const Input&) {}
};

TEST(PlayAlong, ClaimsNoErrorOfAGameWithoutBodies) {
    const Settings settings{.stepping = {.rate = {60}}};
    AnyGameOf<Empty> game(settings);
    OnePress player;
    const MakeGame make = [](const Settings& own) {
        return std::make_unique<AnyGameOf<Empty>>(own);
    };
    PlayAlong along(player, {settings}, make, PlayAlong::Pace::own);
    game.step(0, 60, along);
    along.play_until(60);
    EXPECT_EQ(along.verdict().text, "what the timestep costs is not measured: there are no bodies");
    EXPECT_EQ(along.verdict().grade, Grade::unknown);
}

}  // namespace
}  // namespace oiler::test
