// SPDX-License-Identifier: MIT
// What a player sees at the times of frames that do not fit the steps. The test has its own clock:
// the stamps of the frames.
#include <functional>

#include "oiler/app/game_clock.hpp"
#include "oiler/app/playback.hpp"
#include "oiler/core/random.hpp"
#include "oiler/core/step_clock.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using std::chrono::nanoseconds;

constexpr double step_time = 1 / 60.0;  // s
constexpr double speed = 3;             // m/s
constexpr double gravity = 20;          // m/s²

/// Moves at `speed`.
struct Runner {
    static constexpr About about{.name = "runner", .title = "Runner"};
    World world;
    Entity body;
    explicit Runner(const Settings& settings)
        : world(1, settings), body(world.spawn(Body{.velocity = {speed}})) {}
    Picture picture() const {
        return {.discs = {{.key = key_of(world, body), .centre = to_point(world.position(body))}}};
    }
};

/// Falls up from rest.
struct Faller : Runner {
    static constexpr About about{.name = "faller", .title = "Faller"};
    explicit Faller(const Settings& settings) : Runner(settings) {
        world.set_velocity(body, {});
        world.set_gravity({gravity});
    }
};

/// Moves while Space is held.
struct Walking : Runner {
    static constexpr About about{.name = "walking", .title = "Walking"};
    using Runner::Runner;
    void update(const Input& input) {
        world.set_velocity(body, {input.held(Key::space) ? speed : 0});
    }
};

struct Displayed {
    double time = 0;  // s, since the first frame
    double at = 0;    // m
};

nanoseconds in_ns(double seconds) { return nanoseconds(std::llround(seconds * 1e9)); }

struct LiveQueue final : InputSource {
    InputQueue queue;
    Input next(std::int64_t) override { return queue.take({}); }
};

/// The displayed positions at frames with these stamps, s. A window begins a frame by taking what
/// was pressed until then: `poll`.
template <class Game>
std::vector<Displayed> shown(
    const std::vector<double>& frames,
    const std::function<void(InputQueue&, double)>& poll = [](InputQueue&, double) {}) {
    AnyGameOf<Game> game({.stepping = {.method = &find_method("velocity_verlet"), .rate = {60}}});
    TraceWriter recorder({}, {}, game.world());
    Playback playback(game, recorder, Keep::nothing);
    LiveQueue live;
    StepClock clock(60);
    std::vector<Displayed> positions;
    for (const double frame : frames) {
        poll(live.queue, frame - frames.front());
        clock.advance(in_ns(frame));
        const Picture picture = playback.show(clock.ticks(), clock.alpha(), live);
        positions.push_back({frame - frames.front(), double{picture.discs.at(0).centre.x}});
    }
    return positions;
}

std::vector<double> at_144_hz(double duration) {
    std::vector<double> frames;
    for (int i = 0; i < duration * 144; ++i) frames.push_back(7 + i / 144.0);
    return frames;
}

/// Frames of 2 to 30 ms, and each twentieth one of 200.
std::vector<double> irregular(double duration) {
    Random random(1);
    std::vector<double> frames{7};
    for (int i = 1; frames.back() < 7 + duration; ++i)
        frames.push_back(frames.back() + (i % 20 == 0 ? 0.2 : random.uniform(0.002, 0.03)));
    return frames;
}

// After a frame, the game has taken the step that has begun: its newest state is less than a step
// ahead of the frame, and goes on into what would be seen a step later without interpolation.
// Positions up to 9 m are floats, so 1 µm is what rounding needs.
TEST(Pacing, EachFrameShowsTheTrueMotionOneStepBehindTheNewestState) {
    const auto newest = [](double time) { return speed * (time + step_time); };
    for (const auto& frames : {at_144_hz(3), irregular(3)})
        for (const Displayed& one : shown<Runner>(frames))
            ASSERT_NEAR(one.at, newest(one.time) - speed * step_time, 1e-6) << one.time;
}

// A straight line between two points of a parabola is above it by a·τ·(dt - τ)/2, τ after the
// first. This is up to a·dt²/8, which after 0.21 s is less than 1 % of a step's motion a·t·dt.
TEST(Pacing, AFallIsOnTheStraightLinesBetweenItsSteps) {
    for (const auto& frames : {at_144_hz(0.9), irregular(0.9)})
        for (const Displayed& one : shown<Faller>(frames)) {
            const double since = std::fmod(one.time, step_time);
            const double truth = gravity * one.time * one.time / 2;
            const double above = gravity * since * (step_time - since) / 2;
            ASSERT_NEAR(one.at, truth + above, 1e-6) << one.time;
            if (one.time > 0.21) {
                ASSERT_LT(one.at - truth, 0.01 * gravity * one.time * step_time);
            }
        }
}

// Time that is dropped is missing from the motion, once and for all; a frame catches up 250 ms.
TEST(Pacing, AfterAStallTheMotionGoesOnAsSmoothlyAsBefore) {
    std::vector<double> frames = at_144_hz(2);
    for (std::size_t i = 100; i < frames.size(); ++i) frames[i] += 1;
    const std::vector<Displayed> positions = shown<Runner>(frames);
    const double dropped = 1 + 1 / 144.0 - 0.25;
    for (std::size_t i = 100; i < positions.size(); ++i)
        ASSERT_NEAR(positions[i].at, speed * (positions[i].time - dropped), 1e-6) << i;
}

// A press belongs to the next step, which begins up to a step later. It is taken by the first
// frame after its beginning, so that a press in between is still in time, by less than a frame.
TEST(Pacing, APressIsSeenWithinAStepAndAFrame) {
    constexpr double frame_time = 1 / 144.0;
    const std::vector<double> frames = at_144_hz(0.5);
    double earliest = 1;
    double latest = -1;
    for (double press = 0.1; press < 0.2; press += 0.00037) {
        const auto positions = shown<Walking>(
            frames, [&](InputQueue& queue, double time) { queue.set(Key::space, time >= press); });
        const double begin = positions.back().time - positions.back().at / speed;
        EXPECT_NEAR(begin / step_time, std::round(begin / step_time), 1e-4) << "a step's beginning";
        earliest = std::min(earliest, begin - press);
        latest = std::max(latest, begin - press);
        const auto first =
            std::ranges::find_if(positions, [](const Displayed& one) { return one.at > 1e-6; });
        EXPECT_LE(first->time - press, step_time + frame_time + 1e-6) << press;
        EXPECT_GE(first->time, press);
    }
    EXPECT_GT(earliest, -frame_time);
    EXPECT_LE(latest, step_time + 1e-6);
    EXPECT_GT(latest - earliest, step_time - 0.001) << "presses of all times within a step";
}

/// What is said after frames that each take `work` s to make, come every `period` s, and drop
/// `late` s of it.
std::string said_after(int frames, double work, double period, double late) {
    using seconds = std::chrono::duration<double>;
    KeptPace pace;
    for (int frame = 0; frame < frames; ++frame)
        pace.add(seconds(work), seconds(period), seconds(late));
    return pace.text();
}

TEST(KeptPace, SaysWhatAComputerCannotKeep) {
    EXPECT_EQ(said_after(200, 0.160, 0.170, 0),
              "6 frames a second: a smaller window helps");
    EXPECT_EQ(said_after(200, 0.160, 0.200, 0.188),
              "too slow here: 6 % of its pace. A lower rate helps");
    EXPECT_EQ(said_after(200, 0.016, 0.017, 0), "");
    EXPECT_EQ(said_after(200, 0.04, 1.0, 0.05), "") << "a limit of frames is no lack of speed";
}

TEST(KeptPace, OneLateFrameIsNoLackOfSpeed) {
    KeptPace pace;
    using seconds = std::chrono::duration<double>;
    for (int frame = 0; frame < 100; ++frame) pace.add(seconds(0.01), seconds(0.017), seconds(0));
    pace.add(seconds(0.5), seconds(0.5), seconds(0.25));
    EXPECT_EQ(pace.text(), "");
    EXPECT_EQ(said_after(1, 0.4, 0.4, 0.1), "");
    EXPECT_NE(said_after(16, 0.1, 0.1, 0), "");
}

}  // namespace
}  // namespace oiler::test
