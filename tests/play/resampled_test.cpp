// SPDX-License-Identifier: MIT
// The input of a recording at other rates, compared with plain lists.
#include "oiler/play/replay.hpp"

#include <random>

#include "support/test.hpp"

namespace oiler::test {
namespace {

using What = InputEvent::What;

constexpr Button buttons[] = {Key::space, Key::left, Mouse::left, Pad::south};
constexpr std::int64_t recorded_steps = 40;
constexpr std::int64_t recorded_rate = 60;

InputEvent random_event(std::mt19937& random) {
    InputEvent event{.what = static_cast<What>(random() % InputEvent::what_count)};
    if (random() % 2 == 0) event.what = What::edge;
    event.button = buttons[random() % 4].id();
    event.down = random() % 2 == 0;
    event.stick = static_cast<std::uint8_t>(random() % 2);
    event.deflection = static_cast<Deflection>(random() % 100);
    event.canvas = {static_cast<float>(random() % 640), static_cast<float>(random() % 360)};
    event.camera = {.centre = {static_cast<float>(random() % 9), 1}, .height = 5};
    event.notches = static_cast<int>(random() % 5) - 2;
    event.text = random() % 2 == 0 ? "a" : "ü";
    return event;
}

Recording random_recording(unsigned seed) {
    std::mt19937 random(seed);
    Recording recording{.header = {}, .events = {}, .states = {}, .steps = recorded_steps};
    recording.header.stepping.rate = {recorded_rate};
    for (std::int64_t step = 0; step < recorded_steps; ++step)
        for (unsigned i = random() % 4; i > 0; --i)
            recording.events.push_back({step, random_event(random)});
    return recording;
}

/// Counts up to the first step whose time is no earlier: step/rate >= recorded/60.
std::int64_t step_of(std::int64_t recorded, std::int64_t rate) {
    std::int64_t step = 0;
    while (step * recorded_rate < recorded * rate) ++step;
    return step;
}

/// What a step should see of everything but buttons.
struct Seen {
    int wheel = 0;
    std::string text;
    bool restarts = false;
};

/// The changes of a button, by step. Events that change nothing are no edges. A release goes to the
/// next step if it is the last of its step and follows a press in it.
std::map<std::int64_t, std::vector<bool>> edges_of(Button button, const Recording& recording,
                                                   std::int64_t rate) {
    std::map<std::int64_t, std::vector<bool>> edges;
    bool down = false;
    for (const auto& [step, event] : recording.events)
        if (event.what == What::edge && event.button == button.id() && event.down != down) {
            down = event.down;
            edges[step_of(step, rate)].push_back(down);
        }
    for (auto at = edges.begin(); at != edges.end(); ++at)
        if (at->second.size() > 1 && !at->second.back()) {
            at->second.pop_back();
            std::vector<bool>& next = edges[at->first + 1];
            next.insert(next.begin(), false);
        }
    return edges;
}

void expect_as_listed(const Recording& recording, std::int64_t rate) {
    std::map<std::int64_t, Seen> seen;
    std::map<std::int64_t, std::optional<Point>> pointer;
    std::map<std::int64_t, Deflection> sticks[2];
    for (const auto& [recorded, event] : recording.events) {
        const std::int64_t step = step_of(recorded, rate);
        if (event.what == What::wheel) seen[step].wheel += event.notches;
        if (event.what == What::text) seen[step].text += event.text;
        if (event.what == What::restart) seen[step].restarts = true;
        if (event.what == What::stick) sticks[event.stick][step] = event.deflection;
        if (event.what == What::pointer) pointer[step] = event.canvas;
        if (event.what == What::no_pointer) pointer[step] = std::nullopt;
    }
    ResampledInput input(recording, {rate});
    std::map<std::uint16_t, std::map<std::int64_t, std::vector<bool>>> edges;
    for (const Button button : buttons) edges[button.id()] = edges_of(button, recording, rate);
    std::map<std::uint16_t, bool> held;
    std::optional<Point> at;
    int deflection[2] = {};
    for (std::int64_t step = 0; step <= step_of(recorded_steps, rate) + 1; ++step) {
        const Input now = input.next(step);
        for (const Button button : buttons) {
            int presses = 0;
            int releases = 0;
            for (const bool down : edges.at(button.id())[step]) {
                ++(down ? presses : releases);
                held[button.id()] = down;
            }
            ASSERT_EQ(now.presses(button), presses) << rate << " Hz, step " << step;
            ASSERT_EQ(now.releases(button), releases) << rate << " Hz, step " << step;
            ASSERT_EQ(now.held(button), held[button.id()]) << rate << " Hz, step " << step;
        }
        ASSERT_EQ(now.wheel(), seen[step].wheel);
        ASSERT_EQ(now.text(), seen[step].text);
        ASSERT_EQ(now.restarts(), seen[step].restarts);
        if (pointer.contains(step)) at = pointer[step];
        ASSERT_EQ(now.pointer_canvas(), at);
        for (std::uint8_t i = 0; i < 2; ++i) {
            if (sticks[i].contains(step)) deflection[i] = sticks[i][step];
            ASSERT_FLOAT_EQ(now.stick(static_cast<Stick>(i)),
                            static_cast<float>(deflection[i]) / 127);
        }
    }
}

TEST(Resampled, EveryEventIsSeenOnceAtTheFirstStepThatIsNoEarlier) {
    for (unsigned seed = 0; seed < 100; ++seed)
        for (const std::int64_t rate : {20, 30, 50, 60, 100, 144, 240})
            ASSERT_NO_FATAL_FAILURE(expect_as_listed(random_recording(seed), rate));
}

// The camera travels with the pointer: both of step 3, 1/20 s.
TEST(Resampled, ThePointerKeepsItsCamera) {
    Recording recording;
    recording.header.stepping.rate = {recorded_rate};
    const Camera camera{.centre = {7, 8}, .height = 36};
    recording.events = {{3, {.what = What::camera, .camera = camera}},
                        {3, {.what = What::pointer, .canvas = {330, 180}}}};
    ResampledInput input(recording, {20});
    EXPECT_FALSE(input.next(0).pointer());
    EXPECT_EQ(input.next(1).pointer(), (Point{8, 8})) << "10 of 360 units are 1 m of 36 m";
}

TEST(Resampled, StepsOfTwoRatesAreMatchedWithoutRounding) {
    const StepRatio ratio({60}, {50});
    EXPECT_TRUE(ratio.has(6));
    EXPECT_FALSE(ratio.has(5));
    EXPECT_EQ(ratio.last_until(6), 5);
    EXPECT_EQ(ratio.last_until(7), 5);
    EXPECT_TRUE(ratio.reaches(5, 6));
    EXPECT_FALSE(ratio.reaches(5, 7));
    // A day at 1 MHz, compared with 16 MHz.
    const StepRatio fine({1'000'000}, {16'000'000});
    const std::int64_t day = 86'400'000'000;
    EXPECT_EQ(fine.last_until(day), 16 * day);
    EXPECT_FALSE(fine.reaches(16 * day - 1, day));
}

}  // namespace
}  // namespace oiler::test
