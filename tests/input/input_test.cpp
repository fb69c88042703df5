// SPDX-License-Identifier: MIT
// Input as events, and events as bytes; and the view that a fixed step has of a keyboard, a mouse
// and a controller.

#include <chrono>
#include <random>

#include "oiler/core/step_clock.hpp"
#include "oiler/input/input.hpp"
#include "oiler/input/input_event.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// A step's worth of random input.
void fiddle(InputQueue& queue, std::mt19937& random) {
    constexpr Button buttons[] = {Key::space, Key::right_gui, Mouse::right, Pad::right_trigger};
    for (unsigned i = random() % 4; i > 0; --i) queue.set(buttons[random() % 4], random() % 2 == 0);
    if (random() % 4 == 0)
        queue.deflect(static_cast<Stick>(random() % stick_count),
                      static_cast<Deflection>(static_cast<int>(random() % 255) - 127));
    if (random() % 4 == 0)
        queue.point_at(Point{static_cast<float>(random() % 100000) / 77 - 300,
                             static_cast<float>(random() % 100000) / 99 - 300});
    if (random() % 16 == 0) queue.point_at(std::nullopt);
    if (random() % 8 == 0) queue.turn_wheel(static_cast<int>(random() % 7) - 3);
    if (random() % 8 == 0) queue.enter("añ€");
    if (random() % 32 == 0) queue.release_all();
    if (random() % 64 == 0) queue.restart();
}

TEST(InputEvents, GiveTheSameInputAgain) {
    std::mt19937 random(1);
    for (int run = 0; run < 300; ++run) {
        InputQueue queue;
        EventPlayer player;
        Input before;
        std::string bytes;
        for (int step = 0; step < 60; ++step) {
            fiddle(queue, random);
            const Input now = queue.take({.centre = {float(step / 7), 1}, .height = 9});
            bytes.clear();
            for (const InputEvent& event : events_between(before, now)) append(bytes, event);
            std::string_view rest(bytes);
            while (!rest.empty()) {
                const auto event = take_event(rest);
                ASSERT_TRUE(event);
                player.play(*event);
            }
            ASSERT_EQ(player.take(), now) << run << ", step " << step;
            before = now;
        }
    }
}

TEST(InputEvents, OfALongTextAreSeveral) {
    InputQueue queue;
    for (int i = 0; i < 3000; ++i) queue.enter("ü€");
    const Input now = queue.take({});
    std::string bytes;
    for (const InputEvent& event : events_between({}, now)) append(bytes, event);
    EventPlayer player;
    for (std::string_view rest(bytes); !rest.empty();) {
        const auto event = take_event(rest);
        ASSERT_TRUE(event);
        player.play(*event);
    }
    EXPECT_EQ(player.take(), now);
}

TEST(InputEvents, AreRefusedIfTheirBytesAreDamaged) {
    std::mt19937 random(2);
    for (int run = 0; run < 20'000; ++run) {
        std::string bytes(random() % 12, ' ');
        for (char& byte : bytes) byte = static_cast<char>(random());
        std::string_view rest(bytes);
        const auto event = take_event(rest);
        if (!event) continue;
        std::string again;
        append(again, *event);
        EXPECT_EQ(again, bytes.substr(0, bytes.size() - rest.size())) << "one form only";
    }
}

TEST(InputEvents, OfButtonsThatDoNotExistAreRefused) {
    for (std::uint16_t id = 0; id < Button::count; ++id) {
        std::string bytes;
        append(bytes, {.what = InputEvent::What::edge, .button = id});
        std::string_view rest(bytes);
        EXPECT_EQ(take_event(rest).has_value(), Button::of_id(id).has_value()) << id;
    }
}

TEST(InputEvents, NumbersHaveOneForm) {
    for (const std::uint64_t number : {std::uint64_t{0}, std::uint64_t{127}, std::uint64_t{128},
                                       std::uint64_t{1} << 62U, ~std::uint64_t{0}}) {
        std::string bytes;
        append_number(bytes, number);
        std::string_view rest(bytes);
        EXPECT_EQ(take_number(rest), number);
        EXPECT_TRUE(rest.empty());
        rest = std::string_view(bytes).substr(0, bytes.size() - 1);
        EXPECT_FALSE(take_number(rest)) << "cut off";
    }
    for (const std::string& overlong : {std::string("\x80\x00", 2), std::string(11, '\x80')}) {
        std::string_view rest(overlong);
        EXPECT_FALSE(take_number(rest));
    }
}

constexpr std::array<Button, 3> buttons{Key::space, Mouse::left, Pad::south};

/// A change of one of the buttons, ns after the start.
struct Change {
    std::int64_t time;
    std::size_t button;
    bool down;
};

/// Random taps from a nanosecond to a second long, of which the release may never come.
std::vector<Change> random_changes(std::mt19937_64& random, std::int64_t end) {
    std::vector<Change> changes;
    for (std::size_t button = 0; button < buttons.size(); ++button) {
        bool down = true;
        std::int64_t time = 0;
        for (;;) {
            time += 1 + static_cast<std::int64_t>(
                            std::pow(10.0, 9.0 * double(random() >> 11) * 0x1p-53));
            if (time >= end) break;
            changes.push_back({time, button, down});
            down = !down;
        }
    }
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change& a, const Change& b) { return a.time < b.time; });
    return changes;
}

/// What the steps of a run may see of a button, from the list of its changes alone.
struct Expected {
    int downs = 0;  ///< changes so far
    int ups = 0;
    int seen_downs = 0;  ///< by steps
    int seen_ups = 0;

    /// What the next step sees, of which `new_downs` came since the last one.
    void check(const Input& input, Button button) {
        const bool is_down = downs > ups;
        const int presses = downs - seen_downs;
        const bool held = is_down || presses > 0;
        // A button that is shown as held although it is up keeps its last release.
        const int releases = ups - seen_ups - (held && !is_down ? 1 : 0);
        ASSERT_EQ(input.presses(button), presses);
        ASSERT_EQ(input.pressed(button), presses > 0);
        ASSERT_EQ(input.held(button), held);
        ASSERT_EQ(input.releases(button), releases);
        ASSERT_EQ(input.released(button), releases > 0);
        seen_downs += presses;
        seen_ups += releases;
    }
};

/// The length of the next frame, ns: 30, 60 and 144 per second, irregular, or one that stalls.
std::int64_t frame_length(int kind, std::mt19937_64& random) {
    constexpr std::int64_t second = 1'000'000'000;
    if (kind == 0) return second / 30;
    if (kind == 1) return second / 60;
    if (kind == 2) return second / 144;
    if (kind == 3) return 1 + static_cast<std::int64_t>(random() % (second / 20));
    return random() % 20 == 0 ? second / 5 : second / 60;
}

void play(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const std::int64_t end = 500'000'000;
    const std::vector<Change> changes = random_changes(random, end);
    constexpr int rates[] = {20, 60, 240};
    StepClock clock(rates[seed % 3]);
    InputQueue queue;
    std::array<Expected, buttons.size()> expected;
    std::size_t next = 0;
    for (std::int64_t now = 0; now < end; now += frame_length(int(seed / 3 % 5), random)) {
        for (; next < changes.size() && changes[next].time <= now; ++next) {
            const Change& change = changes[next];
            queue.set(buttons[change.button], change.down);
            ++(change.down ? expected[change.button].downs : expected[change.button].ups);
        }
        const auto steps = clock.advance(std::chrono::nanoseconds(now)).steps;
        for (std::int64_t step = 0; step < steps; ++step) {
            const Input input = queue.take({});
            for (std::size_t i = 0; i < buttons.size(); ++i) {
                ASSERT_NO_FATAL_FAILURE(expected[i].check(input, buttons[i])) << "seed " << seed;
            }
        }
    }
}

TEST(InputQueue, ShowsEachPressToOneStepAtAnyFrameRate) {
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) ASSERT_NO_FATAL_FAILURE(play(seed));
}

TEST(InputQueue, TwoTapsBeforeAStepAreTwoPresses) {
    InputQueue queue;
    for (const bool down : {true, false, true, false}) queue.set(Key::a, down);
    Input input = queue.take({});
    EXPECT_EQ(input.presses(Key::a), 2);
    EXPECT_EQ(input.releases(Key::a), 1);
    EXPECT_TRUE(input.held(Key::a));
    input = queue.take({});
    EXPECT_EQ(input.presses(Key::a), 0);
    EXPECT_EQ(input.releases(Key::a), 1);
    EXPECT_FALSE(input.held(Key::a));
    EXPECT_EQ(queue.take({}).releases(Key::a), 0);
}

TEST(InputQueue, RepeatsOfTheSystemAreNoPresses) {
    InputQueue queue;
    queue.set(Key::a, true);
    (void)queue.take({});
    queue.set(Key::a, true);
    EXPECT_EQ(queue.take({}).presses(Key::a), 0);
}

// Of an action with two keys, the second one is neither a press nor, before the first is up, its
// release.
TEST(InputQueue, AnActionGoesDownWithItsFirstButtonAndUpWithItsLast) {
    constexpr Action fire{"fire", Key::space, Key::enter};
    InputQueue queue;
    queue.set(Key::space, true);
    EXPECT_TRUE(queue.take({}).pressed(fire));
    queue.set(Key::enter, true);
    queue.set(Key::space, false);
    Input input = queue.take({});
    EXPECT_FALSE(input.pressed(fire));
    EXPECT_FALSE(input.released(fire));
    EXPECT_TRUE(input.held(fire));
    queue.set(Key::enter, false);
    input = queue.take({});
    EXPECT_TRUE(input.released(fire));
    EXPECT_FALSE(input.held(fire));
}

TEST(InputQueue, APlayerMayChooseOtherButtons) {
    constexpr Action fire{"fire", Key::space};
    constexpr Axis aim{"aim", Key::left, Key::right};
    Control chosen_fire(fire);
    chosen_fire.positive = Buttons(Key::f);
    Control chosen_aim(aim);
    chosen_aim.negative = Buttons({Key::q, Key::z});
    InputQueue queue(std::make_shared<const std::vector<Control>>(
        std::vector<Control>{chosen_fire, chosen_aim}));
    queue.set(Key::space, true);
    queue.set(Key::left, true);
    Input input = queue.take({});
    EXPECT_FALSE(input.held(fire));
    EXPECT_EQ(input.axis(aim), 0);
    queue.set(Key::f, true);
    queue.set(Key::z, true);
    input = queue.take({});
    EXPECT_TRUE(input.pressed(fire));
    EXPECT_EQ(input.axis(aim), -1);
}

TEST(InputQueue, TheLossOfTheKeyboardIsARelease) {
    InputQueue queue;
    queue.set(Key::w, true);
    queue.deflect(Stick::left_x, 100);
    (void)queue.take({});
    queue.release_all();
    Input input = queue.take({});
    EXPECT_TRUE(input.released(Key::w));
    EXPECT_FALSE(input.held(Key::w));
    EXPECT_EQ(input.stick(Stick::left_x), 0);
    queue.set(Key::w, false);
    EXPECT_FALSE(queue.take({}).released(Key::w));
}

TEST(InputQueue, APauseDropsTapsButKeepsWhatIsStillDown) {
    InputQueue queue;
    queue.set(Key::c, true);
    (void)queue.take({});
    queue.set_paused(true);
    queue.set(Key::a, true);
    queue.set(Key::a, false);
    queue.set(Key::b, true);
    queue.set(Key::c, false);
    queue.turn_wheel(3);
    queue.enter("x");
    queue.set_paused(false);
    const Input input = queue.take({});
    EXPECT_EQ(input.presses(Key::a), 0);
    EXPECT_EQ(input.presses(Key::b), 1);
    EXPECT_TRUE(input.released(Key::c));
    EXPECT_EQ(input.wheel(), 0);
    EXPECT_EQ(input.text(), "");
    EXPECT_EQ(queue.take({}).presses(Key::b), 0);
}

TEST(InputQueue, ASingleStepInAPauseSeesWhatIsDown) {
    InputQueue queue;
    queue.set_paused(true);
    queue.set(Key::b, true);
    EXPECT_TRUE(queue.take({}).pressed(Key::b));
    queue.set_paused(false);
    EXPECT_FALSE(queue.take({}).pressed(Key::b));
}

TEST(InputQueue, OneStepSeesWheelAndText) {
    InputQueue queue;
    queue.turn_wheel(2);
    queue.turn_wheel(-1);
    queue.enter("ä");
    queue.enter("b");
    const Input input = queue.take({});
    EXPECT_EQ(input.wheel(), 1);
    EXPECT_EQ(input.text(), "äb");
    EXPECT_EQ(queue.take({}).wheel(), 0);
    EXPECT_EQ(queue.take({}).text(), "");
}

// The camera shows 9 m around (10, 5), so a unit of the canvas is 0.025 m.
TEST(InputQueue, ThePointerIsInTheWorldThatWasOnScreen) {
    InputQueue queue;
    EXPECT_FALSE(queue.take({}).pointer());
    queue.point_at(Point{320 + 40.04F, 180 - 80});
    const Input input = queue.take({.centre = {10, 5}, .height = 9});
    ASSERT_TRUE(input.pointer());
    EXPECT_EQ(input.pointer_canvas(), (Point{360.0625F, 100}));
    EXPECT_NEAR(input.pointer()->x, 10 + 40.0625 * 0.025, 1e-5);
    EXPECT_NEAR(input.pointer()->y, 5 - 80 * 0.025, 1e-5);
    EXPECT_TRUE(queue.take({}).pointer()) << "the mouse stays";
    queue.point_at(std::nullopt);
    EXPECT_FALSE(queue.take({}).pointer());
}

TEST(InputQueue, ThePointerMovesAsSeenFromStepToStep) {
    InputQueue queue;
    EXPECT_FALSE(queue.take({}).pointer_moved());
    queue.point_at(Point{100, 50});
    const Input here = queue.take({});
    EXPECT_TRUE(here.pointer_moved()) << "it came into the window";
    EXPECT_FALSE(queue.take({}).pointer_moved());
    EXPECT_FALSE(queue.take({.centre = {3, 0}}).pointer_moved()) << "only the camera moved";
    queue.point_at(Point{101, 50});
    queue.point_at(Point{100, 50});
    EXPECT_FALSE(queue.take({}).pointer_moved()) << "it is where it was";
    queue.point_at(Point{101, 50});
    EXPECT_TRUE(queue.take({}).pointer_moved());
    queue.continue_after(here);
    EXPECT_TRUE(queue.take({}).pointer_moved()) << "since the step that is the last one now";
    queue.point_at(std::nullopt);
    EXPECT_FALSE(queue.take({}).pointer_moved());
    queue.point_at(Point{101, 50});
    EXPECT_TRUE(queue.take({}).pointer_moved());
}

TEST(Input, DirectionsAreNoLongerThanOne) {
    constexpr Axis x{"x", Key::a, Key::d, Stick::left_x};
    constexpr Axis y{"y", Key::s, Key::w, Stick::left_y};
    InputQueue queue;
    queue.set(Key::d, true);
    queue.set(Key::w, true);
    const Point diagonal = queue.take({}).direction(x, y);
    EXPECT_NEAR(diagonal.x, std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(diagonal.y, std::sqrt(0.5), 1e-6);
    queue.release_all();
    queue.deflect(Stick::left_x, -127);
    queue.set(Key::d, true);
    EXPECT_EQ(queue.take({}).axis(x), 0) << "key and stick cancel";
    queue.set(Key::d, false);
    queue.set(Key::a, true);
    EXPECT_EQ(queue.take({}).axis(x), -1) << "key and stick do not exceed 1";
}

// Small pushes keep their direction: the dead zone is a circle, not a cross.
TEST(DeadZone, IsACircleOutsideOfWhichDirectionsStay) {
    EXPECT_EQ(without_dead_zone(7800, 0), (StickPosition{}));
    EXPECT_EQ(without_dead_zone(5500, -5500), (StickPosition{}));
    EXPECT_EQ(without_dead_zone(32767, 0), (StickPosition{127, 0}));
    EXPECT_EQ(without_dead_zone(-32768, 0), (StickPosition{-127, 0}));
    EXPECT_EQ(without_dead_zone(0, 31200), (StickPosition{0, 127})) << "0.952 of the way";
    // At 16384, 0.5 of the way: (0.5 - 0.24)/(0.95 - 0.24) = 0.366.
    EXPECT_EQ(without_dead_zone(0, 16384), (StickPosition{0, 47}));
    const StickPosition corner = without_dead_zone(32767, 32767);
    EXPECT_EQ(corner, (StickPosition{90, 90})) << "127/sqrt(2)";
    const StickPosition flat = without_dead_zone(20000, 5000);
    EXPECT_NEAR(double(flat.y) / flat.x, 0.25, 0.01);
}

TEST(Triggers, ArePressedWithHysteresis) {
    const auto raw = [](double part) { return static_cast<int>(part * 32767); };
    EXPECT_FALSE(trigger_is_pressed(false, raw(0.59)));
    EXPECT_TRUE(trigger_is_pressed(false, raw(0.61)));
    EXPECT_TRUE(trigger_is_pressed(true, raw(0.41)));
    EXPECT_FALSE(trigger_is_pressed(true, raw(0.39)));
    EXPECT_EQ(trigger_position(32767), 127);
    EXPECT_EQ(trigger_position(0), 0);
}

TEST(Buttons, HaveOneNameEach) {
    std::vector<std::string> names;
    for (std::uint16_t id = 0; id < Button::count; ++id)
        if (const auto button = Button::of_id(id)) {
            names.push_back(name_of(*button));
            EXPECT_EQ(find_button(names.back()), button) << names.back();
        }
    EXPECT_EQ(names.size(), 121U);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
    EXPECT_EQ(find_button("mouse LEFT"), Button(Mouse::left));
    EXPECT_FALSE(find_button("nothing"));
}

// SDL and USB count from the same table: these are a few of its rows.
TEST(Buttons, AreNumberedAsInTheUsbTable) {
    EXPECT_EQ(Button(Key::a).id(), 4);
    EXPECT_EQ(Button(Key::z).id(), 29);
    EXPECT_EQ(Button(Key::n1).id(), 30);
    EXPECT_EQ(Button(Key::n0).id(), 39);
    EXPECT_EQ(Button(Key::space).id(), 44);
    EXPECT_EQ(Button(Key::slash).id(), 56);
    EXPECT_EQ(Button(Key::f12).id(), 69);
    EXPECT_EQ(Button(Key::up).id(), 82);
    EXPECT_EQ(Button(Key::pad_period).id(), 99);
    EXPECT_EQ(Button(Key::right_gui).id(), 231);
}

TEST(Sticks, AreDescribedInWords) {
    EXPECT_EQ(describe(Stick::left_x), "left stick left/right");
    EXPECT_EQ(describe(Stick::left_y), "left stick up/down");
    EXPECT_EQ(describe(Stick::right_y), "right stick up/down");
    EXPECT_EQ(describe(Stick::right_trigger), "right trigger");
}

}  // namespace
}  // namespace oiler::test
