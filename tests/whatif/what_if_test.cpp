// SPDX-License-Identifier: MIT
// A recording at other settings, compared with closed forms of falling bodies.
#include "oiler/whatif/what_if.hpp"

#include <chrono>
#include <numeric>

#include "oiler/app/playback.hpp"
#include "support/folder.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double gravity = 20;         // m/s²
constexpr double push = 5;             // m/s
constexpr float camera_height = 7.2F;  // m: a pixel is 1 cm
constexpr std::int64_t steps = 120;    // 2 s
constexpr int rate = 60;

/// A body that falls from rest; Space pushes it up.
struct Fall {
    static constexpr About about{.name = "fall", .title = "Fall", .rate = rate};
    World world;
    Entity body;
    int pushes = 0;

    explicit Fall(const Settings& settings) : world(1, settings), body(world.spawn(Body{})) {
        world.set_gravity({-gravity});
    }
    void update(const Input& input) {
        pushes += input.presses(Key::space);
        if (input.pressed(Key::space)) world.apply_impulse(body, {push});
    }
    [[nodiscard]] std::vector<Reading> readings() const {
        return {{"height", world.position(body)[0], "m"}, {"pushes", double(pushes)}};
    }
    [[nodiscard]] Picture picture() const { return {.camera = {.height = camera_height}}; }
};

/// With more than 64 bodies, the reference has 960 Hz.
void add_crowd(World& world) {
    for (int i = 0; i < 64; ++i) world.spawn(Body{});
}

/// A body that jumps at 9 m/s: its apex is 2.025 m. It meets a target at 2.01 m.
constexpr double target_height = 2.01;
enum class Hit { destroys, teleports, counts, restarts };
template <Hit hit>
struct Jump {
    static constexpr About about{.name = "jump", .title = "Jump", .rate = rate};
    World world;
    Entity body;
    Entity target;
    int hits = 0;

    explicit Jump(const Settings& settings)
        : world(1, settings), body(world.spawn(Body{.velocity = {9}})), target(world.create()) {
        world.set_gravity({-gravity});
        if (hit != Hit::counts) world.add_body(target, Body{.position = {50}});
        world.add(target, Name{"target"});
        add_crowd(world);
    }
    void update(const Input&, Loop& loop) {
        if (hits > 0 || world.position(body)[0] < target_height) return;
        ++hits;
        if (hit == Hit::destroys) world.destroy(target);
        if (hit == Hit::teleports) world.teleport(target, {60});
        if (hit == Hit::restarts) loop.restart();
    }
    [[nodiscard]] std::vector<Reading> readings() const {
        if (hit != Hit::counts) return {};
        return {{"hits", double(hits)}};
    }
    [[nodiscard]] Picture picture() const {
        return {.camera = {.height = hit == Hit::restarts ? 720 : camera_height}};
    }
};

/// A body without forces whose game makes it 25 m/s / rate fast, which no timestep makes right.
struct Careless {
    static constexpr About about{.name = "careless", .title = "Careless", .rate = rate};
    World world;
    Entity body;
    explicit Careless(const Settings& settings) : world(1, settings), body(world.spawn(Body{})) {
        add_crowd(world);
    }
    void update(const Input&) {
        if (world.settings().stepping.rate.steps == 30 && world.tick() == 10)
            throw std::runtime_error("30 Hz is too slow");
        world.set_velocity(body, {25 * world.dt()});
    }
    [[nodiscard]] Picture picture() const { return {.camera = {.height = camera_height}}; }
};

/// Presses Space in step 45, 0.75 s.
class OnePress final : public InputSource {
public:
    Input next(std::int64_t step) override {
        queue_.set(Key::space, step == 45);
        return queue_.take({});
    }

private:
    InputQueue queue_;
};

template <class Game>
RecordedPlay record(const char* method = "semi_implicit_euler") {
    const Folder folder;
    const Settings settings{.stepping = {.method = &find_method(method), .rate = {rate}}};
    AnyGameOf<Game> game(settings);
    TraceWriter none({}, {}, game.world());
    Playback playback(game, none, Keep::nothing);
    OnePress player;
    InputRecorder tape(player, folder / "a", header_of(Game::about.name, settings, {}));
    playback.watch(tape);
    playback.step_to(steps, tape);
    tape.finish(steps, game);
    return {.settings = settings, .recording = read_recording(folder / "a"), .name = "a.rec"};
}

template <class Game>
WhatIf measure(const RecordedPlay& play, const std::string& settings) {
    const auto result = measure_what_if(
        play, parse_what_if(settings, play.recording.header.stepping),
        [](const Settings& own) { return std::make_unique<AnyGameOf<Game>>(own); }, nullptr, true);
    EXPECT_TRUE(result);
    return *result;
}

/// What a straight line between two steps is off a parabola at its middle.
double chord(double hertz) { return gravity / (hertz * hertz) / 8; }

// Semi-implicit Euler is g·dt·t/2 below the parabola. A line between its steps is less below it
// than its later end is. A push that comes late leaves the body lower by push times the delay: step
// 45 of 60 Hz is at 0.75 s, the next step of 30 Hz 1/60 s later.
TEST(WhatIf, ErrorsAreThoseOfClosedForms) {
    const WhatIf result =
        measure<Fall>(record<Fall>(), "20,30,120,30@rk4,velocity_verlet,float,20@rk4");
    const double end = 2;
    const auto fall = [&](double hertz) { return gravity / hertz * end / 2; };
    const double expected[] = {fall(60), fall(20), fall(30) + push / 60, fall(120), push / 60, 0,
                               fall(60), 0};
    const double lines[] = {0, 0, 0, 0, chord(30), chord(60), 0, chord(20)};
    ASSERT_EQ(result.runs.size(), std::size(expected));
    for (std::size_t i = 0; i < std::size(expected); ++i) {
        const WhatIfRun& run = result.runs[i];
        const double tolerance = run.stepping.precision == Precision::single ? 1e-4 : 1e-10;
        EXPECT_NEAR(run.distance_at_steps, expected[i], tolerance) << table_text(run.stepping);
        EXPECT_NEAR(run.distance, expected[i] + lines[i], tolerance) << table_text(run.stepping);
        ASSERT_EQ(run.readings.size(), 2U);
        EXPECT_NEAR(run.readings[0].value, result.reference.readings[0].value - expected[i],
                    tolerance);
        EXPECT_EQ(run.readings[1], (Reading{"pushes", 1}));
        EXPECT_FALSE(run.other_play_from);
        EXPECT_TRUE(std::isnan(run.costs.draw)) << "not asked for";
    }
    EXPECT_NEAR(result.reference.readings[0].value, push * (end - 0.75) - gravity * end * end / 2,
                1e-10);
    EXPECT_EQ(result.duration, end);
    EXPECT_EQ(result.certain_until, end);
    EXPECT_LT(result.uncertainty, 1e-10);
}

// At 7/6 of the rate, only every sixth recorded step is one of the run, too: 114 is the last.
TEST(WhatIf, ReadingsAreComparedWhereBothRunsBeginAStep) {
    RecordedPlay play = record<Fall>("rk4");
    play.recording.steps = 119;
    const WhatIf result = measure<Fall>(play, "70,30");
    const double at = 114 / 60.0;
    const WhatIfRun& run = result.runs[1];
    ASSERT_EQ(run.readings.size(), 2U);
    EXPECT_EQ(run.read_at, at);
    const double push_at = 53 / 70.0;  // the first step of 70 Hz from 0.75 s on
    EXPECT_NEAR(run.readings[0].value, push * (at - push_at) - gravity * at * at / 2, 1e-10);
    EXPECT_NEAR(run.true_readings[0].value, push * (at - 0.75) - gravity * at * at / 2, 1e-10);
    // Seven of its lines are 24 moments long, so that the middle of one is a moment.
    EXPECT_NEAR(run.distance, push * (push_at - 0.75) + chord(70), 1e-10);
    EXPECT_NEAR(run.distance_at_steps, push * (push_at - 0.75), 1e-10);
    EXPECT_EQ(result.runs[2].read_at, 118 / 60.0);
    EXPECT_EQ(result.runs[0].read_at, 119 / 60.0);
}

/// A body that falls from 2 m, and bounces in the update of the step in which it is below 0.
struct Bouncer {
    static constexpr About about{.name = "bouncer", .title = "Bouncer", .rate = rate};
    World world;
    Entity body;
    explicit Bouncer(const Settings& settings)
        : world(1, settings), body(world.spawn(Body{.position = {2}})) {
        world.set_gravity({-gravity});
    }
    void update(const Input&) {
        const double speed = world.velocity(body)[0];
        if (world.position(body)[0] < 0 && speed < 0) world.set_velocity(body, {-speed});
    }
    [[nodiscard]] std::vector<Reading> readings() const {
        return {{"height", world.position(body)[0], "m"}};
    }
    [[nodiscard]] Picture picture() const { return {.camera = {.height = camera_height}}; }
};

// It reaches the ground at 0.4472 s with 8.94 m/s. The next step of 7,680 Hz begins 52 µs later,
// and the bounce is then off by 2·8.94 m/s·52 µs.
TEST(WhatIf, KnowsThatItsReferenceBouncesLate) {
    RecordedPlay play = record<Bouncer>("rk4");
    play.recording.steps = 30;
    const WhatIf result = measure<Bouncer>(play, "30");
    const double fall = std::sqrt(2 * 2 / gravity);
    const double since = 0.5 - fall;
    const double truth = gravity * fall * since - gravity * since * since / 2;
    const double error = std::abs(result.reference.readings[0].value - truth);
    EXPECT_NEAR(error, 2 * gravity * fall * (std::ceil(fall * 7680) / 7680 - fall), 2e-4);
    EXPECT_FALSE(KnownError(error, result.uncertainty).is_certain());
}

/// A body that is elsewhere from the first step on at 30 Hz.
struct Elsewhere : Fall {
    using Fall::Fall;
    void update(const Input&) {
        if (world.settings().stepping.rate.steps == 30 && world.tick() == 0)
            world.teleport(body, {9});
    }
};

TEST(WhatIf, NamesNoDistanceWhereNothingWasCompared) {
    const WhatIf result = measure<Elsewhere>(record<Elsewhere>(), "30");
    EXPECT_FALSE(std::isnan(result.runs[0].distance));
    EXPECT_TRUE(std::isnan(result.runs[1].distance));
    EXPECT_TRUE(std::isnan(result.runs[1].distance_at_steps));
    EXPECT_EQ(result.runs[1].other_play_from, 2 / 60.0);
}

/// A spring with ω = 110/s, stable at 60 Hz: ω·dt < 2. At 10 Hz, each step makes it 119 times as
/// long, more than 3.4e38 m after 19 steps.
struct Stiff {
    static constexpr About about{.name = "stiff", .title = "Stiff", .rate = rate};
    World world;
    explicit Stiff(const Settings& settings) : world(1, settings) {
        world.add(world.spawn(Body{.position = {1}}, Spring{.stiffness = 110 * 110}), Name{"bob"});
    }
    [[nodiscard]] Picture picture() const { return draw_looks(world, {.height = camera_height}); }
};

TEST(WhatIf, ASettingThatExplodesFailsAlone) {
    const WhatIf result = measure<Stiff>(record<Stiff>(), "10,120");
    EXPECT_TRUE(result.runs[0].failure.empty());
    EXPECT_TRUE(result.runs[1].failure.starts_with("diverged at step 2")) << result.runs[1].failure;
    EXPECT_TRUE(holds(result.runs[1].failure,
                      "body 'bob' is farther away than a picture reaches, 3.4e+38 m; spring of "
                      "body 'bob': ω·dt = 11"))
        << result.runs[1].failure;
    EXPECT_TRUE(result.runs[2].failure.empty());
}

/// A body that moves 1 m a step, and is brought back in every second one.
struct Commuter {
    static constexpr About about{.name = "commuter", .title = "Commuter", .rate = rate};
    World world;
    Entity body;
    explicit Commuter(const Settings& settings)
        : world(1, settings), body(world.spawn(Body{.velocity = {rate}})) {}
    void update(const Input&) {
        const bool is_even = world.tick() % (2 * world.settings().stepping.rate.steps / rate) == 0;
        if (is_even) world.teleport(body, {0});
    }
    [[nodiscard]] Picture picture() const { return {.camera = {.height = camera_height}}; }
};

// What the picture does not draw as a line is not compared as one: a line back would be up to 2 m
// away from the body.
TEST(WhatIf, ComparesNoLineOverATeleport) {
    const WhatIf result = measure<Commuter>(record<Commuter>("rk4"), "120");
    EXPECT_EQ(result.certain_until, 2);
    for (const WhatIfRun& run : result.runs) EXPECT_NEAR(run.distance, 0, 1e-12);
}

/// A game whose world has no body, or one from 1 s on.
template <bool Spawns>
struct Late {
    static constexpr About about{.name = "late", .title = "Late", .rate = rate};
    World world;
    explicit Late(const Settings& settings) : world(1, settings) {}
    void update(const Input&) {
        if (Spawns && world.tick() == world.settings().stepping.rate.steps)
            static_cast<void>(world.spawn(Body{}));
    }
};

TEST(WhatIf, NamesNoDistanceWithoutBodies) {
    const WhatIf without = measure<Late<false>>(record<Late<false>>(), "30");
    for (const WhatIfRun& run : without.runs) EXPECT_TRUE(std::isnan(run.distance));
    EXPECT_EQ(without.uncertainty, 0);
    EXPECT_GT(without.certain_until, 0);
    const WhatIf with = measure<Late<true>>(record<Late<true>>(), "30");
    for (const WhatIfRun& run : with.runs) EXPECT_EQ(run.distance, 0);
    EXPECT_EQ(with.uncertainty, 0);
}

// At the steps, g·dt·t/2 exceeds 1 cm after 0.06 s at 60 Hz and after 0.12 s at 120 Hz. The line to
// the next step is g·dt²·(a − a²/2) further below at a of the way: beyond 1 cm from a = 0.368 of
// step 3 at 60 Hz, and a = 0.225 of step 14 at 120 Hz; the next samples, at sixteenths of a
// recorded step, are 0.375 and 0.25. The push of 5 m/s in step 45, 0.75 s, comes a step later at 30
// Hz: 2/16 of a recorded step after it, that alone is 5/480 m, 1.04 cm, and a sixteenth before,
// with the line's chord of 2.8 mm, 0.8 cm.
TEST(WhatIf, NamesTheTimeFromWhichAPixelIsExceeded) {
    const WhatIf result = measure<Fall>(record<Fall>(), "120,30@rk4,rk4");
    EXPECT_EQ(result.runs[0].visible_from, 3.375 / 60);
    EXPECT_EQ(result.runs[1].visible_from, 14.25 / 120);
    EXPECT_EQ(result.runs[2].visible_from, 45.125 / 60.0);
    EXPECT_FALSE(result.runs[3].visible_from);
}

/// Its camera shows twice as much after a second.
struct Zoom : Fall {
    static constexpr About about{.name = "zoom", .title = "Zoom", .rate = rate};
    using Fall::Fall;
    [[nodiscard]] Picture picture() const {
        return {.camera = {.height = (world.time() < 1 ? 1 : 2) * camera_height}};
    }
};

TEST(WhatIf, APixelIsThatOfTheCameraAsItIs) {
    EXPECT_FLOAT_EQ(static_cast<float>(measure<Zoom>(record<Zoom>(), "rk4").pixel),
                    2 * camera_height / 720);
}

// The reference meets the target at 0.4113 s, before step 25 ends; semi-implicit Euler misses it,
// because its apex is 9 m/s·dt/2 lower. Until step 24 it is g·dt·t/2 too low, and g·dt²·(a − a²/2)
// more at a = 11/16 of the line to the next step, where the reference begins the step that meets
// the target; at 240 Hz that is 3/4 of step 98. Velocity Verlet is exact at the steps, but looks
// one step later: that is no other play.
template <class Game>
void expect_other_play(double after_delay = chord(60)) {
    const WhatIf result = measure<Game>(record<Game>(), "240,velocity_verlet");
    ASSERT_EQ(result.runs.size(), 3U);
    EXPECT_EQ(result.runs[0].other_play_from, 25 / 60.0);
    EXPECT_NEAR(result.runs[0].distance_at_steps, gravity / 60 * 0.4 / 2, 1e-10);
    EXPECT_NEAR(result.runs[0].distance, gravity / 60 * (0.4 / 2 + (11 / 16.0 - 121 / 512.0) / 60),
                1e-10);
    EXPECT_EQ(result.runs[1].other_play_from, 25 / 60.0);
    EXPECT_NEAR(result.runs[1].distance, gravity / 240 / 240 * (98 / 2 + 0.75 - 9 / 32.0), 1e-10);
    EXPECT_FALSE(result.runs[2].other_play_from);
    EXPECT_NEAR(result.runs[2].distance, after_delay, 1e-10);
    EXPECT_EQ(result.certain_until, 2);
}
TEST(WhatIf, NothingIsCountedOnceABodyIsMissing) { expect_other_play<Jump<Hit::destroys>>(); }
// Steps of 59 and 60 Hz begin together only once a second.
TEST(WhatIf, AnotherPlayIsSeenWhereRatesShareNoSteps) {
    using Game = Jump<Hit::destroys>;
    const WhatIf result = measure<Game>(record<Game>(), "59,59@velocity_verlet");
    EXPECT_EQ(result.runs[1].other_play_from, 25 / 60.0);
    EXPECT_EQ(result.runs[1].other_play, "target is not in the true motion");
    EXPECT_FALSE(result.runs[2].other_play_from) << "meets the target, a step later";
}
// The target falls, too: from the same height, but later.
TEST(WhatIf, NothingIsCountedOnceATeleportIsMissing) {
    const double seen = 395 / 960.0;
    const double seen_later = 25 / 60.0;
    expect_other_play<Jump<Hit::teleports>>(gravity / 2 * (seen_later * seen_later - seen * seen));
}
TEST(WhatIf, NothingIsCountedOnceACountDiffers) { expect_other_play<Jump<Hit::counts>>(); }
TEST(WhatIf, NothingIsCountedOnceARestartIsMissing) {
    const WhatIf result =
        measure<Jump<Hit::restarts>>(record<Jump<Hit::restarts>>(), "velocity_verlet");
    EXPECT_EQ(result.runs[0].other_play_from, 25 / 60.0);
    EXPECT_FALSE(result.runs[1].other_play_from) << "restarts a step later";
}

/// A ball flies off every 0.1 s, or at the next step.
template <bool falls>
struct Stream {
    static constexpr About about{.name = "stream", .title = "Stream", .rate = rate};
    static constexpr double speed = 5;
    World world;
    std::int64_t balls = 0;
    explicit Stream(const Settings& settings) : world(1, settings) {
        if (falls) world.set_gravity({-gravity});
    }
    void update(const Input&) {
        for (; 10 * world.tick() >= balls * world.settings().stepping.rate.steps; ++balls)
            (void)world.spawn(Body{.velocity = {speed}});
    }
    [[nodiscard]] Picture picture() const { return {.camera = {.height = camera_height}}; }
};

// A step of 1/8 s begins up to 0.1 s after a ball is due: 0.5 s is the first time that is both.
// After it, nearly always one ball is late.
TEST(WhatIf, AStreamOfLateBodiesIsNoOtherPlay) {
    using Flight = Stream<false>;
    const WhatIf result = measure<Flight>(record<Flight>(), "8,20");
    EXPECT_FALSE(result.runs[1].other_play_from) << result.runs[1].other_play;
    EXPECT_NEAR(result.runs[1].distance, 0.1 * Flight::speed, 1e-9);
    EXPECT_NEAR(result.runs[2].distance, 0, 1e-9) << "20 Hz has a step at each";
}

// At 10 Hz each step ends with a new ball; the lines of the others are compared.
TEST(WhatIf, ABodyThatAppearsHidesNoOther) {
    const WhatIf result = measure<Stream<true>>(record<Stream<true>>(), "velocity_verlet@10");
    EXPECT_NEAR(result.runs[1].distance, chord(10), 1e-9);
}

/// Two bodies vanish, at 0.5 and 0.52 s, and two others fly off, at 0.51 and 0.53 s. Where a step
/// has two of these times, the later ones take the slots of the earlier ones in another order.
struct Swap {
    static constexpr About about{.name = "swap", .title = "Swap", .rate = rate};
    static constexpr double speed = 5;
    World world;
    std::array<Entity, 2> old{world.spawn(Body{}), world.spawn(Body{})};
    std::array<bool, 2> has_flown{};
    explicit Swap(const Settings& settings) : world(1, settings) {}
    void update(const Input&) {
        for (int i : {0, 1})
            if (world.time() >= 0.5 + 0.02 * i && world.alive(old[i])) world.destroy(old[i]);
        for (int i : {0, 1})
            if (world.time() >= 0.51 + 0.02 * i && !std::exchange(has_flown[i], true))
                (void)world.spawn(Body{.velocity = {i == 0 ? speed : -speed}});
    }
    [[nodiscard]] Picture picture() const { return {.camera = {.height = camera_height}}; }
};

// At 10 Hz all but the first happens at 0.6 s, 0.09 s after the step of the reference that begins
// at 0.51 s or next.
TEST(WhatIf, BodiesAreTheSameInTheOrderOfTheirCreation) {
    const WhatIf result = measure<Swap>(record<Swap>(), "10");
    EXPECT_FALSE(result.runs[1].other_play_from) << result.runs[1].other_play;
    EXPECT_NEAR(result.runs[1].distance, Swap::speed * (0.6 - std::ceil(0.51 * 7680) / 7680), 1e-9);
}

/// A ball that falls at 3 m/s without gravity, and bounces after 30.4 steps without a loss.
struct Bounce {
    static constexpr About about{.name = "bounce", .title = "Bounce", .rate = rate};
    static constexpr double speed = 3;
    World world;
    explicit Bounce(const Settings& settings) : world(1, settings) {
        world.add_plane({.normal = {1}, .restitution = 1});
        static_cast<void>(world.spawn(
            Body{.position = {speed * 30.4 / rate}, .velocity = {-speed}, .contact = Contact{0}}));
    }
    void update(const Input&) {}
    [[nodiscard]] Picture picture() const { return {.camera = {.height = camera_height}}; }
};

// Events of the updates come at steps; impacts come between them.
TEST(WhatIf, KnowsWhetherEventsComeAtSteps) {
    EXPECT_TRUE(measure<Commuter>(record<Commuter>("rk4"), "120").has_events_at_steps);
    EXPECT_TRUE(
        measure<Jump<Hit::counts>>(record<Jump<Hit::counts>>("rk4"), "120").has_events_at_steps);
    EXPECT_FALSE(
        measure<Jump<Hit::restarts>>(record<Jump<Hit::restarts>>("rk4"), "120").has_events_at_steps)
        << "the picture is cut there";
    EXPECT_FALSE(measure<Bounce>(record<Bounce>(), "120").has_events_at_steps);
}

// The bounce lies at a = 0.4 of a step, of which the picture cuts the corner: there it is
// 2·v·dt·a(1 − a) above the floor.
TEST(WhatIf, SeesTheCornerThatThePictureCutsAtABounce) {
    const WhatIf result = measure<Bounce>(record<Bounce>(), "120,50,30");
    const double corner = 2 * Bounce::speed / rate * 0.4 * 0.6;
    EXPECT_NEAR(result.runs[0].distance, corner, 1e-9);
    EXPECT_LT(result.runs[0].distance_at_steps, 1e-9);
    const double half = 2 * Bounce::speed / 120 * 0.8 * 0.2;  // 0.8 of the first half
    EXPECT_NEAR(result.runs[1].distance, half, 1e-9);
    // It exceeds a pixel of 1 cm at 0.4/2.4 of the step; the next sixteenth is the third.
    EXPECT_EQ(result.runs[0].visible_from, (30 + 3 / 16.0) / rate) << "before the bounce";
    // 30.4 steps are 25 1/3 of 50 Hz, and 15.2 of 30 Hz.
    EXPECT_NEAR(result.runs[2].distance, 2 * Bounce::speed / 50 * (1 / 3.0) * (2 / 3.0), 1e-9);
    EXPECT_NEAR(result.runs[3].distance, 2 * Bounce::speed / 30 * 0.2 * 0.8, 1e-9);
}

// The velocity is 25/rate m/s, so that 420 and 960 Hz are 25·t·(1/420 - 1/960) m apart: 1 cm after
// 0.2987 s.
TEST(WhatIf, NothingIsCountedOnceTheReferenceIsUncertain) {
    const WhatIf result = measure<Careless>(record<Careless>(), "120,240");
    const double until = 17 / 60.0;
    EXPECT_EQ(result.certain_until, until);
    EXPECT_NEAR(result.uncertainty, 25 * until * (1 / 420.0 - 1 / 960.0), 1e-12);
    EXPECT_NEAR(result.runs[0].distance, 25 * until * (1 / 60.0 - 1 / 960.0), 1e-12);
    EXPECT_NEAR(result.runs[1].distance, 25 * until * (1 / 120.0 - 1 / 960.0), 1e-12);
    // 240 Hz: 25·t·(1/240 - 1/960) is 1 cm after 0.128 s, and 1 cm more than the uncertainty of
    // step 14 after 0.228 s, of which 13.6875 is the next moment.
    EXPECT_EQ(result.runs[2].visible_from, 13.6875 / 60);
}

TEST(WhatIf, TheReferenceHasAtLeast7680StepsAndAMultipleOfSixteen) {
    for (const auto& [recorded, reference] :
         {std::pair(1, 7680), std::pair(7, 69 * 112), std::pair(59, 9 * 944), std::pair(60, 7680),
          std::pair(61, 8 * 976), std::pair(1000, 16000)}) {
        RecordedPlay play;
        play.recording.header.stepping = {.method = &find_method("rk4"), .rate = {recorded}};
        play.settings.stepping = play.recording.header.stepping;
        const WhatIf result = measure<Fall>(play, "rk4");
        EXPECT_EQ(result.reference.stepping.rate.steps, reference) << recorded;
        const std::int64_t check = result.check.stepping.rate.steps;
        EXPECT_EQ(2 * check, reference - 2 * recorded);
        EXPECT_EQ(std::gcd(check, reference), recorded) << "other steps begin at other times";
    }
}

TEST(WhatIf, ASettingThatFailsIsNamed) {
    const WhatIf result = measure<Careless>(record<Careless>(), "30,120");
    EXPECT_TRUE(holds(result.runs[1].failure, "tick 10"));
    EXPECT_TRUE(holds(result.runs[1].failure, "30 Hz is too slow"));
    const double until = 16 / 60.0;  // the last common step while the reference is certain
    EXPECT_NEAR(result.runs[1].distance_at_steps, 25 * until * (1 / 30.0 - 1 / 960.0), 1e-12);
    const double drawn_until = 17 / 60.0;  // halfway to its next step
    EXPECT_NEAR(result.runs[1].distance, 25 * drawn_until * (1 / 30.0 - 1 / 960.0), 1e-12);
    EXPECT_EQ(result.runs[2].failure, "");
}

TEST(WhatIf, RefusesARecordingThatIsNotReproduced) {
    RecordedPlay play = record<Fall>();
    ++play.recording.states.at(70).bodies;
    EXPECT_EQ(
        line_of_error(Exit::comparison_failed, [&] { (void)measure<Fall>(play, "30"); }),
        "a.rec: the replay differs in the bodies after step 71; it is equal after 70; if the game "
        "was changed, --replay-anyway plays on");
}

/// A game that takes at least 20 µs for each update and 40 µs for each picture.
struct Slow {
    static constexpr About about{.name = "slow", .title = "Slow", .rate = rate};
    World world;
    explicit Slow(const Settings& settings) : world(1, settings) {}
    static void wait(std::chrono::microseconds time) {
        const auto start = std::chrono::steady_clock::now();
        while (std::chrono::steady_clock::now() - start < time) continue;
    }
    void update(const Input&) { wait(std::chrono::microseconds(20)); }
    [[nodiscard]] Picture picture() const {
        wait(std::chrono::microseconds(40));
        return {};
    }
};

// Half an update per frame at 30 Hz, two at 120 Hz; a fifth is left to the stopwatch itself.
TEST(WhatIf, RefusesAPlayThatGoesOnWhereItQuit) {
    RecordedPlay play = record<Fall>();
    play.recording.quits = true;
    EXPECT_EQ(
        line_of_error(Exit::comparison_failed, [&] { (void)measure<Fall>(play, "30"); }),
        "a.rec: the replay differs in that the game goes on after step 120, where it quits in "
        "the recording; if the game was changed, --replay-anyway plays on");
    play.plays_on = true;
    EXPECT_EQ(measure<Fall>(play, "30").runs.size(), 2U);
}

TEST(WhatIf, CostsAreOfAFrame) {
    const WhatIf result = measure<Slow>(record<Slow>(), "30,120");
    EXPECT_GE(result.runs[0].costs.update, 16'000);
    EXPECT_GE(result.runs[1].costs.update, 8'000);
    EXPECT_GE(result.runs[2].costs.update, 32'000);
    for (const WhatIfRun& run : result.runs) {
        EXPECT_GE(run.costs.picture, 32'000);
        EXPECT_GE(run.costs.step, 0);
    }
}

}  // namespace
}  // namespace oiler::test
