// SPDX-License-Identifier: MIT
// Runs that play along on a thread of their own, and lag behind.
#include "oiler/whatif/aside.hpp"

#include "oiler/game/game.hpp"
#include "support/test.hpp"

#include <atomic>
#include <thread>

namespace oiler::test {
namespace {

using std::chrono::milliseconds;

/// A fall that takes no step before it is let go.
struct HeldFall {
    static constexpr About about{.name = "fall", .title = "Fall", .rate = 60};
    static inline std::atomic<bool> waits = false;
    static inline std::atomic<bool> goes = false;
    static inline std::atomic<double> latest = 0;  ///< time of a step in any run, s

    World world;
    explicit HeldFall(const Settings& settings) : world(1, settings) {
        (void)world.spawn(Body{});
        world.set_gravity({-20});
    }
    void update(const Input&) {
        waits = true;
        waits.notify_all();
        goes.wait(false);
        latest = std::max(latest.load(), world.time());
    }
    static void let_go() {
        goes = true;
        goes.notify_all();
    }
};

/// A fall whose updates are slow.
struct SlowFall {
    static constexpr About about = HeldFall::about;
    static inline int updates = 0;

    World world;
    explicit SlowFall(const Settings& settings) : world(1, settings) { (void)world.spawn(Body{}); }
    void update(const Input&) {
        std::this_thread::sleep_for(milliseconds(2));
        ++updates;
    }
};

template <class Fall = HeldFall>
AlongFrom start(bool may_repeat) {
    return {
        .play = {.settings = {.stepping = {.method = &find_method("semi_implicit_euler"),
                                           .rate = {60}}}},
        .make =
            [](const Settings& settings) { return std::make_unique<AnyGameOf<Fall>>(settings); },
        .is_start = true,
        .may_repeat = may_repeat};
}

/// What is known once `steps` of the last round were played along and judged.
LiveFigures figures_after(Aside& aside, std::int64_t steps, bool repeats) {
    LiveFigures figures;
    for (int tries = 0; tries < 3000; ++tries) {
        figures = aside.play_until(steps, milliseconds(10));
        if (figures.played > steps && figures.measured && figures.repeats == repeats) break;
        std::this_thread::sleep_for(milliseconds(1));
    }
    return figures;
}

/// Euler falls that much too deep in so many steps, m.
double off_after(int steps) { return 20 * (steps / 60.0) / 60 / 2; }

// A round of 12 steps, of which none was played along when the next one begins.
struct Lag : testing::Test {
    Aside aside;

    Lag() {
        HeldFall::waits = HeldFall::goes = false;
        HeldFall::latest = 0;
        aside.begin(start(false));
        (void)aside.play_until(12, milliseconds(0));
        HeldFall::waits.wait(false);
        aside.begin(start(true));
    }
    ~Lag() override { HeldFall::let_go(); }
};

TEST_F(Lag, ARoundThatRepeatsIsFirstMeasuredToItsEnd) {
    (void)aside.play_until(3, milliseconds(0));
    HeldFall::let_go();
    const LiveFigures figures = figures_after(aside, 3, true);
    ASSERT_TRUE(figures.measured);
    EXPECT_TRUE(figures.repeats);
    EXPECT_NEAR(figures.measured->runs.front().distance, off_after(12), 1e-12);
}

TEST_F(Lag, ARoundWithInputIsMeasuredAtOnce) {
    aside.add({1, {.button = Button(Key::space).id(), .down = true}});
    (void)aside.play_until(3, milliseconds(0));
    HeldFall::let_go();
    LiveFigures figures = figures_after(aside, 3, false);
    ASSERT_TRUE(figures.measured);
    EXPECT_NEAR(figures.measured->runs.front().distance, off_after(3), 1e-12);
    EXPECT_LT(HeldFall::latest, 4 / 60.0) << "the first round was left";
    aside.begin(start(true));
    figures = figures_after(aside, 2, false);
    EXPECT_EQ(figures.played, 3);
    EXPECT_NEAR(figures.measured->runs.front().distance, off_after(2), 1e-12)
        << "the last round had input";
}

TEST_F(Lag, AnotherSettingIsMeasuredAtOnce) {
    AlongFrom from = start(false);
    from.play.settings.stepping.rate = {120};
    aside.begin(std::move(from));
    (void)aside.play_until(6, milliseconds(0));
    HeldFall::let_go();
    const LiveFigures figures = figures_after(aside, 6, false);
    ASSERT_TRUE(figures.measured);
    EXPECT_NEAR(figures.measured->runs.front().distance, off_after(3) / 2, 1e-12);
    EXPECT_LT(HeldFall::latest, 4 / 60.0) << "the first round was left";
}

// Until its next instant, the reference takes 8 steps, so at least 16 ms. A frame has 6 ms at most.
TEST(Aside, WithoutAThreadALongPartTakesTheTimeOfLaterFrames) {
    Aside aside(false);
    aside.begin(start<SlowFall>(false));
    const auto updates_of_frame = [&] {
        const int before = SlowFall::updates;
        (void)aside.play_until(1, milliseconds(0));
        return SlowFall::updates - before;
    };
    while (updates_of_frame() < 8) {
    }
    EXPECT_EQ(updates_of_frame(), 0);
    while (updates_of_frame() == 0) {
    }
}

}  // namespace
}  // namespace oiler::test
