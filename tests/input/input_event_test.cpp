// SPDX-License-Identifier: MIT
// Input as events, and events as bytes.
#include "oiler/input/input_event.hpp"

#include <random>

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

}  // namespace
}  // namespace oiler::test
