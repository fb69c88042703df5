// SPDX-License-Identifier: MIT
#include "oiler/app/playback.hpp"

#include <chrono>
#include <new>
#include <thread>

#include "oiler/core/step_clock.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// A free body at 1 m/s and 1 step/s, so that its position in m is the tick. `update` counts key
/// presses.
struct Walker {
    static constexpr About about{.name = "walker", .title = "Walker"};

    World world;
    Entity body;
    int presses = 0;
    std::int64_t teleport_after = -1;

    explicit Walker(const Settings& settings)
        : world(1, settings), body(world.spawn(Body{.velocity = {1}})) {}

    void update(const Input& input) {
        presses += input.pressed(Key::space) ? 1 : 0;
        if (world.tick() == teleport_after) world.teleport(body, {1000});
    }
    Picture picture() const {
        Picture picture;
        picture.discs.push_back(
            {.key = key_of(world, body),
             .centre = {static_cast<float>(world.position(body)[0]), static_cast<float>(presses)}});
        return picture;
    }
};

/// A body on a spring without `update`, so that the loop takes many steps per call.
struct Drifter {
    static constexpr About about{.name = "drifter", .title = "Drifter"};
    World world;
    explicit Drifter(const Settings& settings) : world(1, settings) {
        (void)world.spawn(Body{.position = {1}, .velocity = {1}},
                          Spring{.stiffness = 0.25, .damping = 0.01});
    }
    Picture picture() const { return {}; }
};

/// The steps see what is queued.
struct Live final : InputSource {
    InputQueue& queue;
    explicit Live(InputQueue& its) : queue(its) {}
    Input next(std::int64_t) override { return queue.take({}); }
};

struct Shown {
    AnyGameOf<Walker> game{Settings{.stepping = {.rate = {1}}}};
    TraceWriter recorder{{}, {}, game.world()};
    Playback playback{game, recorder, Keep::hashes};
    InputQueue queue;
    Live input{queue};

    Point at(std::int64_t tick, double alpha) {
        return playback.show(tick, alpha, input).discs.at(0).centre;
    }
};

TEST(Playback, ShowsATickAndInterpolatesToTheNext) {
    Shown shown;
    EXPECT_EQ(shown.at(0, 0).x, 0);
    EXPECT_EQ(shown.game.world().tick(), 0) << "no frame was between two ticks";
    EXPECT_EQ(shown.at(0, 0.25).x, 0.25F);
    EXPECT_EQ(shown.at(0, 0.75).x, 0.75F);
    EXPECT_EQ(shown.game.world().tick(), 1) << "both lie before the same tick";
    EXPECT_EQ(shown.at(1, 0).x, 1);
    EXPECT_EQ(shown.at(1, 0.5).x, 1.5F);
    EXPECT_EQ(shown.at(7, 0.5).x, 7.5F) << "a late frame catches up";
    EXPECT_EQ(shown.at(9, 0).x, 9);
    EXPECT_EQ(shown.at(9, 0.5).x, 9.5F);
}

TEST(Playback, ShowsTheTimeOfTheFrameAtAnyRateAndFrameRate) {
    for (const int rate : {1, 30, 60, 100, 144})
        for (const int fps : {1, 24, 60, 100, 144}) {
            Shown shown;
            for (std::int64_t i = 0; i < 200; ++i) {
                const HeadlessFrame frame = headless_frame(i, rate, fps);
                const double ticks = static_cast<double>(i * rate) / fps;
                // Positions are floats of at most 2e4 m, whose spacing is 2e-3 m.
                EXPECT_NEAR(shown.at(frame.step, frame.alpha).x, ticks, 2e-3);
            }
        }
}

TEST(Playback, HashIsThatOfTheShownTick) {
    Shown shown;
    Walker alone(Settings{.stepping = {.rate = {1}}});
    (void)shown.at(0, 0.5);
    EXPECT_EQ(shown.playback.state_hash(), alone.world.state_hash());
    (void)shown.at(3, 0.5);
    alone.world.step(3);
    EXPECT_EQ(shown.playback.state_hash(), alone.world.state_hash());
}

TEST(Playback, APressIsSeenByOneStepHoweverLongItWaits) {
    Shown shown;
    shown.queue.set(Key::space, true);
    EXPECT_EQ(shown.at(0, 0).y, 0) << "no step yet";
    EXPECT_EQ(shown.at(5, 0).y, 1) << "five steps, one press";
    EXPECT_EQ(shown.at(9, 0).y, 1);
}

/// A walker that teleports to 1000 m before its third step.
struct Jumper : Walker {
    explicit Jumper(const Settings& settings) : Walker(settings) { teleport_after = 2; }
};

TEST(Playback, DoesNotInterpolateATeleport) {
    AnyGameOf<Jumper> game{Settings{.stepping = {.rate = {1}}}};
    TraceWriter none{{}, {}, game.world()};
    Playback playback{game, none, Keep::nothing};
    LiveInput input;
    for (int i = 0; i < 40; ++i) {
        const double t = 0.1 * i;
        const auto tick = static_cast<std::int64_t>(t + 1e-9);
        const double alpha = std::max(0.0, t - static_cast<double>(tick));
        const float x = playback.show(tick, alpha, input).discs.at(0).centre.x;
        EXPECT_TRUE(x <= 2.0F || x >= 1001.0F) << "at " << t << " s: " << x;
    }
}

/// A walker that is replaced: by a new game on Enter, by what it was on its fifth step on every
/// step while Backspace is held. Tab holds the world.
struct Rewinder : Walker {
    std::vector<Walker> saved{};
    int updates = 0;

    explicit Rewinder(const Settings& settings) : Walker(settings) {}
    void update(const Input& input, Loop& loop) {
        ++updates;
        if (world.tick() == 5 && saved.empty()) saved.push_back(*this);
        if (input.pressed(Key::enter)) static_cast<Walker&>(*this) = Walker(world.settings());
        if (input.held(Key::backspace)) static_cast<Walker&>(*this) = saved.at(0);
        if (input.held(Key::tab)) loop.hold();
        if (input.pressed(Key::r)) loop.restart();
        if (input.pressed(Key::q)) loop.quit();
    }
};

struct Rewound {
    AnyGameOf<Rewinder> game{Settings{.stepping = {.rate = {1}}}};
    TraceWriter none{{}, {}, game.world()};
    Playback playback{game, none, Keep::nothing};
    InputQueue queue;
    Live input{queue};

    float at(std::int64_t step, double alpha) {
        return playback.show(step, alpha, input).discs.at(0).centre.x;
    }
};

TEST(Playback, ARestartTakesOneStepAndIsNotInterpolated) {
    Rewound shown;
    EXPECT_EQ(shown.at(199, 0.5), 199.5F);
    shown.queue.set(Key::enter, true);
    EXPECT_EQ(shown.at(200, 0), 200) << "taken before the key";
    EXPECT_FALSE(shown.playback.shows_before_cut());
    EXPECT_EQ(shown.at(200, 0.5), 200) << "nothing flies back";
    EXPECT_TRUE(shown.playback.shows_before_cut());
    EXPECT_EQ(shown.at(201, 0), 1) << "a new game, one step old";
    EXPECT_FALSE(shown.playback.shows_before_cut());
    EXPECT_EQ(shown.at(201, 0.5), 1.5F);
    EXPECT_FALSE(shown.playback.shows_before_cut());
    EXPECT_EQ(shown.playback.steps(), 202);
    EXPECT_EQ(shown.game.world().tick(), 2);
}

TEST(Playback, ARestartKeepsTheNumberOfThreads) {
    Rewound shown;
    shown.game.set_threads(2);
    shown.game.restart();
    EXPECT_EQ(shown.game.world().settings().threads, 2);
}

TEST(Playback, ARewindOnEveryStepReturns) {
    Rewound shown;
    (void)shown.at(20, 0);
    shown.queue.set(Key::backspace, true);
    for (int step = 21; step < 320; ++step) EXPECT_EQ(shown.at(step, 0.5), 6);
    shown.queue.set(Key::backspace, false);
    (void)shown.at(322, 0);
    EXPECT_EQ(shown.at(322, 0.25), 8.25F) << "the play goes on";
}

/// Pushes a body with 8 N in each update. Tab holds the world, as a menu does.
struct Pusher {
    static constexpr About about{.name = "pusher", .title = "Pusher"};

    World world;
    Entity body = world.spawn(Body{.mass = 2});

    explicit Pusher(const Settings& settings) : world(1, settings) {}
    void update(const Input& input, Loop& loop) {
        world.apply_force(body, {8});
        if (input.held(Key::tab)) loop.hold();
    }
    Picture picture() const { return {}; }
};

// Each of ten steps at 1 Hz adds 8/2 m/s, whatever was pushed in between.
TEST(Playback, AHeldWorldKeepsNoPushes) {
    AnyGameOf<Pusher> game{Settings{.stepping = {.rate = {1}}}};
    InputQueue queue;
    Live input{queue};
    for (std::int64_t step = 0; step < 30; ++step) {
        const bool holds = step >= 5 && step < 25;
        const std::uint64_t before = game.state_hash();
        queue.set(Key::tab, holds);
        game.step(step, 1, input);
        if (holds && step > 5) {
            EXPECT_EQ(game.state_hash(), before);
        }
    }
    EXPECT_EQ(game.world().bodies().velocity(0)[0], 40);
}

TEST(Playback, TheLoopRestartsAtItsRateAndHoldsTheWorld) {
    Rewound shown;
    (void)shown.at(9, 0);
    shown.queue.set(Key::r, true);
    EXPECT_EQ(shown.at(10, 0), 0);
    EXPECT_EQ(shown.game.world().settings().stepping.rate, Rate{1});
    EXPECT_EQ(shown.at(12, 0), 2);
    const std::uint64_t hash = shown.game.world().state_hash();
    shown.queue.set(Key::tab, true);
    EXPECT_EQ(shown.at(20, 0.5), 2);
    EXPECT_EQ(shown.game.world().state_hash(), hash);
    shown.queue.set(Key::tab, false);
    EXPECT_EQ(shown.at(21, 0), 2) << "the step between 20 and 21 was held";
    EXPECT_EQ(shown.at(21, 0.5), 2.5F);
    shown.queue.set(Key::q, true);
    (void)shown.at(100, 0);
    EXPECT_TRUE(shown.playback.loop().quits());
    EXPECT_EQ(shown.playback.steps(), 22) << "the step of the key is not taken";
}

/// A game whose update throws at tick 3.
struct Thrower : Walker {
    explicit Thrower(const Settings& settings) : Walker(settings) {}
    void update(const Input&) {
        if (world.tick() == 3) throw std::out_of_range("no such target");
    }
};

TEST(Playback, AnExceptionOfAGameNamesTheTick) {
    AnyGameOf<Thrower> game{Settings{.stepping = {.rate = {1}}}};
    TraceWriter none{{}, {}, game.world()};
    LiveInput input;
    EXPECT_EQ(line_of_error(Exit::diverged,
                            [&] { Playback(game, none, Keep::nothing).step_to(10, input); }),
              "update at tick 3: no such target");
}

/// A game that does something wrong at tick 3.
enum class Wrong { rate, gravity, time, mass, handle, hash, camera, radius, place, names };
template <Wrong wrong>
struct Wronger : Walker {
    Entity gone;
    explicit Wronger(const Settings& settings) : Walker(settings), gone(world.create()) {
        world.destroy(gone);
    }
    void update(const Input&) {
        if (world.tick() != 3) return;
        Settings settings = world.settings();
        settings.stepping.rate.steps += 1;
        if (wrong == Wrong::rate) world = World(2, settings);
        if (wrong == Wrong::gravity) world.set_gravity({std::nan("")});
        if (wrong == Wrong::time) world.schedule(-1, 0);
        if (wrong == Wrong::mass) (void)world.spawn(Body{.mass = 0});
        if (wrong == Wrong::handle) world.destroy(gone);
    }
    void hash(StateHash&) const {
        if (wrong == Wrong::hash && world.tick() == 4) throw std::out_of_range("no such target");
    }
    [[nodiscard]] Picture picture() const {
        Picture picture;
        if (wrong == Wrong::camera) picture.camera.height = 0;
        if (wrong == Wrong::radius) picture.discs.push_back(Disc{.radius = -1});
        if (wrong == Wrong::place)
            picture.discs.push_back(Disc{.centre = {1, std::nanf("")}, .radius = 2});
        return picture;
    }
    [[nodiscard]] std::vector<Reading> readings() const {
        return {{"score", 1}, {wrong == Wrong::names ? "score" : "apex", 2}};
    }
};

/// The line of the error of a game that is played to its end.
template <Wrong wrong>
std::string line_of_wrong() {
    AnyGameOf<Wronger<wrong>> game(Settings{});
    LiveInput input;
    return line_of_error(Exit::diverged, [&] {
        EXPECT_EQ(game.step(0, 3, input), 3);
        (void)game.step(3, 1, input);
        (void)game.state_hash();
        (void)game.readings();
        (void)game.picture();
    });
}

/// A game that has no memory at tick 3.
struct Hungry : Walker {
    using Walker::Walker;
    void update(const Input&) {
        if (world.tick() == 3) throw std::bad_alloc();
    }
};

TEST(Playback, WithoutMemoryNamesTheTick) {
    AnyGameOf<Hungry> game(Settings{});
    LiveInput input;
    EXPECT_EQ(line_of_error(Exit::io, [&] { (void)game.step(0, 9, input); }),
              "update at tick 3: not enough memory; take fewer bodies or a shorter time");
}

TEST(Playback, AWrongNumberOfAGameNamesCallAndTick) {
    EXPECT_EQ(line_of_wrong<Wrong::rate>(),
              "update at tick 3: the new world has another rate; make it with world.settings()");
    EXPECT_TRUE(holds(line_of_wrong<Wrong::gravity>(), "set_gravity at tick 3: "));
    EXPECT_TRUE(holds(line_of_wrong<Wrong::time>(), "update at tick 3: schedule of -1 s"));
    EXPECT_TRUE(holds(line_of_wrong<Wrong::mass>(), "update at tick 3: spawn at tick 3: "));
    EXPECT_EQ(line_of_wrong<Wrong::handle>(),
              "update at tick 3: destroy of entity 1 at tick 3: it is gone");
    EXPECT_EQ(line_of_wrong<Wrong::hash>(), "hash at tick 4: no such target");
    EXPECT_EQ(line_of_wrong<Wrong::camera>(),
              "picture at tick 4: a camera of 0 m height: give a height above 0");
    EXPECT_EQ(line_of_wrong<Wrong::radius>(),
              "picture at tick 4: a disc with a radius of -1: give 0 or more");
    EXPECT_EQ(line_of_wrong<Wrong::place>(),
              "picture at tick 4: a disc of size 2 at (1, nan): give numbers");
    EXPECT_EQ(line_of_wrong<Wrong::names>(),
              "readings at tick 4: two readings are named score; rename one");
}

TEST(Playback, ManyStepsPerCallGiveTheBitsOfSingleSteps) {
    AnyGameOf<Drifter> together{Settings{.stepping = {.rate = {10}}}};
    AnyGameOf<Drifter> single{Settings{.stepping = {.rate = {10}}}};
    TraceWriter none{{}, {}, together.world()};
    LiveInput input;
    Playback(together, none, Keep::nothing).step_to(10'000, input);
    for (int i = 0; i < 10'000; ++i) single.step(i, 1, input);
    EXPECT_EQ(together.world().tick(), 10'000);
    EXPECT_EQ(together.world().state_hash(), single.world().state_hash());
}

/// A game whose steps take a given time, at least.
class Sluggish final : public AnyGame {
public:
    std::int64_t step(std::int64_t, std::int64_t count, InputSource&) override {
        calls.push_back(count);
        world_.step(count);
        std::this_thread::sleep_for(count * time_of_step);
        return count;
    }
    void restart() override {}
    void set_stepping(const Stepping& stepping) override { world_.set_stepping(stepping); }
    void set_threads(int threads) override { world_.set_threads(threads); }
    [[nodiscard]] std::unique_ptr<AnyGame> clone() const override {
        return std::make_unique<Sluggish>(*this);
    }
    void assign(const AnyGame& other) override { *this = dynamic_cast<const Sluggish&>(other); }
    [[nodiscard]] const World& world() const override { return world_; }
    [[nodiscard]] Picture picture() const override { return {}; }

    std::chrono::microseconds time_of_step{0};
    std::vector<std::int64_t> calls;

private:
    World world_{1, Settings{}};
};

// A call of 8 steps takes 8 ms, longer than the shortest call of 5 ms.
TEST(Playback, SlowStepsShareNoLongCall) {
    Sluggish game;
    TraceWriter none{{}, {}, game.world()};
    LiveInput input;
    game.time_of_step = std::chrono::milliseconds(1);
    Playback(game, none, Keep::nothing).step_to(40, input);
    EXPECT_LE(*std::max_element(game.calls.begin(), game.calls.end()), 8);
}

// 256 slower steps take 25.6 ms, longer than the longest call of 20 ms.
TEST(Playback, FastStepsShareACallUntilTheyBecomeSlow) {
    Sluggish game;
    TraceWriter none{{}, {}, game.world()};
    Playback playback(game, none, Keep::nothing);
    LiveInput input;
    playback.step_to(100'000, input);
    EXPECT_GT(*std::max_element(game.calls.begin(), game.calls.end()), 100);
    game.time_of_step = std::chrono::microseconds(100);
    playback.step_to(110'000, input);
    game.calls.clear();
    playback.step_to(111'000, input);
    EXPECT_LE(*std::max_element(game.calls.begin(), game.calls.end()), 256);
}

}  // namespace
}  // namespace oiler::test
