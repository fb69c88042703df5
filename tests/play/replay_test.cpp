// SPDX-License-Identifier: MIT
// A replay that ends as its recording does, or says what differs.
#include "oiler/app/options.hpp"
#include "oiler/app/run_game.hpp"
#include "oiler/game/game.hpp"
#include "oiler/play/recording.hpp"
#include "support/folder.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// What the game of a test does, so that it can be another one when it is replayed.
std::int64_t quits_at;
std::size_t bodies;
std::int64_t pushed_at;
bool has_colours;

struct Colouring {
    float red = 0;
};

struct Changing {
    static constexpr About about{.name = "changing", .title = "Changing", .rate = 60};
    World world;
    explicit Changing(const Settings& settings) : world(1, settings) {
        for (std::size_t i = 0; i < bodies; ++i) (void)world.spawn(Body{});
        if (has_colours) world.add(world.create(), Colouring{});
    }
    void update(const Input&, Loop& loop) {
        if (world.tick() == quits_at) loop.quit();
        if (world.tick() == pushed_at) world.apply_impulse(world.entity_of_row(0), {1});
    }
};

class Replays : public ::testing::Test {
protected:
    Replays() {
        quits_at = pushed_at = -1;
        bodies = 1;
        has_colours = false;
    }
    void record(std::int64_t steps) const {
        Options options;
        options.steps = steps;
        options.record = folder_ / "a";
        run(options);
    }
    /// Returns the remarks.
    [[nodiscard]] std::string replay(std::int64_t steps, bool anyway = false) const {
        Options options;
        options.replay_anyway = anyway;
        options.steps = steps;
        options.replay = recording();
        options.replay_file = "a";
        testing::internal::CaptureStderr();
        try {
            run(options, anyway ? Exit::comparison_failed : Exit::done);
        } catch (...) {
            (void)testing::internal::GetCapturedStderr();
            throw;
        }
        return testing::internal::GetCapturedStderr();
    }
    [[nodiscard]] std::string difference(std::int64_t steps) const {
        return line_of_error(Exit::comparison_failed, [&] { (void)replay(steps); });
    }
    [[nodiscard]] Recording recording() const { return read_recording(folder_ / "a"); }
    void cut_the_last_byte() const {
        std::filesystem::resize_file(folder_ / "a", std::filesystem::file_size(folder_ / "a") - 1);
    }

private:
    static void run(Options options, Exit expected = Exit::done) {
        options.settings.stepping.rate = {60};
        EXPECT_EQ(run_game(options, Changing::about,
                           [](const Settings& settings) {
                               return std::make_unique<AnyGameOf<Changing>>(settings);
                           }),
                  expected);
    }

    Folder folder_;
};

TEST_F(Replays, EndWhereTheGameQuits) {
    quits_at = 30;
    record(100);
    EXPECT_EQ(recording().steps, 30);
    EXPECT_TRUE(recording().quits);
    EXPECT_TRUE(holds(replay(30), "equals the recording: 30 of 30 steps\n"));
    EXPECT_TRUE(holds(replay(100), "equals the recording: 30 of 30 steps\n"));
    EXPECT_TRUE(holds(replay(20), "equals the recording: 20 of 30 steps\n"));
}

TEST_F(Replays, NameAGameThatQuitsAtAnotherStep) {
    quits_at = 30;
    record(100);
    const std::string goes_on =
        "a: the replay differs in that the game goes on after step 30, where it quits in the "
        "recording; if the game was changed, --replay-anyway plays on";
    quits_at = 29;
    EXPECT_EQ(difference(30),
              "a: the replay differs in that the game quits after step 29, in the recording after "
              "step 30; if the "
              "game was changed, --replay-anyway plays on");
    quits_at = 31;
    EXPECT_EQ(difference(30), goes_on);
    EXPECT_EQ(difference(100), goes_on);
    quits_at = -1;
    record(30);
    EXPECT_FALSE(recording().quits);
    quits_at = 29;
    EXPECT_EQ(difference(30),
              "a: the replay differs in that the game quits after step 29, in the recording it "
              "does not; if the "
              "game was changed, --replay-anyway plays on");
}

TEST_F(Replays, NameTheTypesThatAreNotCompared) {
    has_colours = true;
    record(9);
    const std::string remarks = replay(9);
    EXPECT_TRUE(holds(remarks, "not compared, because they have no hash(): "));
    EXPECT_TRUE(holds(remarks, "Colouring"));
    has_colours = false;
    EXPECT_FALSE(holds(replay(9), "not compared"));
}

TEST_F(Replays, OfAChangedGamePlayOnIfAsked) {
    record(60);
    pushed_at = 20;
    EXPECT_EQ(
        difference(60),
        "a: the replay differs in the bodies after step 21; it is equal after 20; if the game "
        "was changed, --replay-anyway plays on");
    const std::string remarks = replay(60, true);
    EXPECT_TRUE(holds(remarks,
                      "a: the replay differs in the bodies after step 21; it is equal after 20\n"));
    EXPECT_FALSE(holds(remarks, "equals"));
    pushed_at = -1;
    quits_at = 40;
    EXPECT_TRUE(holds(replay(60, true), "quits after step 40"));
}

// 2500 bodies are hashed after each third step, at the end of each second, and at the end.
TEST_F(Replays, OfManyBodiesCompareTheEnd) {
    bodies = 2500;
    record(62);
    EXPECT_EQ(recording().states.size(), 20U + 1U);
    EXPECT_EQ(recording().states.count(61), 1U);
    EXPECT_TRUE(holds(replay(62), "62 of 62 steps, of which 21 were compared"));
    EXPECT_EQ(difference(2),
              "a: none of the 2 steps was compared, because the recording has no state of them; "
              "replay more of it");
    pushed_at = 61;
    EXPECT_TRUE(holds(difference(62), "differs in the bodies after step 62; it is equal after 60"));
    bodies = 100'000;
    pushed_at = -1;
    record(62);
    EXPECT_EQ(recording().states.size(), 2U);
}

// Nothing equals a recording of which nothing is replayed.
TEST_F(Replays, OfNoStepFail) {
    record(62);
    EXPECT_EQ(difference(0),
              "a: no step was replayed, so that no state was compared; replay more of it");
    EXPECT_TRUE(holds(replay(1), "the replay equals the recording: 1 of 62 steps"));
}

// A file that is cut after a second has no end, as that of a killed program.
TEST_F(Replays, OfARecordingThatWasCutTellThatItHasNoEnd) {
    record(130);
    const std::string remark =
        ", where the recording has no end: it was cut, or its program killed";
    EXPECT_FALSE(holds(replay(130), "no end"));
    cut_the_last_byte();
    const std::int64_t left = recording().steps;
    EXPECT_LT(left, 130);
    EXPECT_TRUE(holds(replay(left),
                      fmt::format("equals the recording: {} of {} steps{}", left, left, remark)));
}

}  // namespace
}  // namespace oiler::test
