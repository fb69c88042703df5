// SPDX-License-Identifier: MIT
// Keys, mouse and a virtual controller of SDL as a game sees them.
#define SDL_MAIN_HANDLED
#include "oiler/platform/sdl2_events.hpp"

#include <cstdlib>

#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr const char* soname = "libSDL2-2.0.so.0";

class Sdl2Events : public testing::Test {
protected:
    void SetUp() override {
        SDL_SetMainReady();
        SDL_SetHint(SDL_HINT_VIDEODRIVER, "dummy");
        ASSERT_EQ(SDL_Init(SDL_INIT_VIDEO | SDL_INIT_GAMECONTROLLER), 0) << SDL_GetError();
    }
    void TearDown() override { SDL_Quit(); }

    /// What the next step sees after these events.
    Input step(std::initializer_list<SDL_Event> events = {}) {
        for (const SDL_Event& event : events) events_.handle(event, {1280, 720}, {queue_, loop_});
        return queue_.take({.centre = {10, 5}, .height = 9});
    }
    Input step_after_polling() {
        SDL_GameControllerUpdate();
        SDL_Event event;
        while (SDL_PollEvent(&event) != 0) events_.handle(event, {1280, 720}, {queue_, loop_});
        return step();
    }
    static SDL_Event key(SDL_Scancode code, bool down, bool repeat = false) {
        SDL_Event event{};
        event.type = down ? SDL_KEYDOWN : SDL_KEYUP;
        event.key.keysym.scancode = code;
        event.key.repeat = repeat ? 1 : 0;
        return event;
    }
    static SDL_Event window(SDL_WindowEventID what) {
        SDL_Event event{};
        event.type = SDL_WINDOWEVENT;
        event.window.event = static_cast<Uint8>(what);
        return event;
    }

    Library library_{soname, "install libsdl2-2.0-0"};
    SdlEvents events_{library_};
    InputQueue queue_;
    InputQueue loop_;
};

TEST_F(Sdl2Events, OfTheMouseReachTheGameUnlessItIsTheLoops) {
    const auto button = [](bool down) {
        SDL_Event event{};
        event.type = down ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP;
        event.button.button = SDL_BUTTON_LEFT;
        event.button.x = 640;
        event.button.y = 360;
        event.button.state = down ? SDL_PRESSED : SDL_RELEASED;
        return event;
    };
    SDL_Event wheel{};
    wheel.type = SDL_MOUSEWHEEL;
    wheel.wheel.y = 2;
    const auto handle = [&](const SDL_Event& event, bool is_of_game) {
        events_.handle(event, {1280, 720}, {queue_, loop_, {.mouse = is_of_game}});
    };
    handle(button(true), false);
    handle(wheel, false);
    Input game = queue_.take({});
    Input loop = loop_.take({});
    EXPECT_FALSE(game.held(Mouse::left));
    EXPECT_FALSE(game.pointer());
    EXPECT_EQ(game.wheel(), 0);
    EXPECT_TRUE(loop.held(Mouse::left));
    EXPECT_EQ(loop.wheel(), 2);
    ASSERT_TRUE(loop.pointer_canvas());
    EXPECT_EQ(loop.pointer_canvas()->x, 320.25F);
    handle(button(true), true);
    handle(button(false), false);
    game = queue_.take({});
    EXPECT_EQ(game.presses(Mouse::left), 1);
    EXPECT_TRUE(game.pointer());
    EXPECT_EQ(queue_.take({}).releases(Mouse::left), 1) << "a button does not stay down";
    events_.handle(button(true), {600, 720}, {queue_, loop_});
    EXPECT_FALSE(queue_.take({}).held(Mouse::left)) << "x = 640 is beside the game's part";
}

TEST_F(Sdl2Events, AreKeysByTheirPlace) {
    const Input input = step({key(SDL_SCANCODE_W, true), key(SDL_SCANCODE_W, true, true),
                              key(SDL_SCANCODE_KP_5, true), key(SDL_SCANCODE_F3, true)});
    EXPECT_EQ(input.presses(Key::w), 1);
    EXPECT_TRUE(input.pressed(Key::pad_5));
    const Input loop = loop_.take({});
    EXPECT_TRUE(loop.pressed(Key::f3));
    EXPECT_TRUE(loop.pressed(Key::w)) << "the loop looks for R when a game stands";
    EXPECT_FALSE(input.held(Key::f3));
    EXPECT_TRUE(step({key(SDL_SCANCODE_ESCAPE, true)}).pressed(Key::escape));
    EXPECT_TRUE(loop_.take({}).pressed(Key::escape));
}

TEST_F(Sdl2Events, KeepEscapeForTheLoopBelowAHelp) {
    const auto handle = [&](SDL_Scancode code, bool down) {
        events_.handle(key(code, down), {1280, 720}, {queue_, loop_, {.escape = false}});
    };
    (void)step({key(SDL_SCANCODE_ESCAPE, true)});
    handle(SDL_SCANCODE_ESCAPE, false);
    EXPECT_TRUE(queue_.take({}).released(Key::escape)) << "it was pressed before the help";
    handle(SDL_SCANCODE_ESCAPE, true);
    handle(SDL_SCANCODE_W, true);
    const Input game = queue_.take({});
    EXPECT_FALSE(game.held(Key::escape));
    EXPECT_TRUE(game.held(Key::w));
    EXPECT_TRUE(loop_.take({}).held(Key::escape));
}

TEST_F(Sdl2Events, ReleaseAllWhenTheWindowLosesTheKeyboard) {
    (void)step({key(SDL_SCANCODE_W, true), key(SDL_SCANCODE_F4, true)});
    EXPECT_TRUE(loop_.take({}).held(Key::f4));
    const Input input = step({window(SDL_WINDOWEVENT_FOCUS_LOST)});
    EXPECT_TRUE(input.released(Key::w));
    EXPECT_FALSE(loop_.take({}).held(Key::f4));
    EXPECT_FALSE(step({key(SDL_SCANCODE_W, false)}).released(Key::w));
}

// At 1280 × 720, a unit of the canvas is two pixels, and 9 m are 720 pixels. A pixel's middle is
// half a pixel from its corner.
TEST_F(Sdl2Events, PointThroughTheCamera) {
    SDL_Event click{};
    click.type = SDL_MOUSEBUTTONDOWN;
    click.button.button = SDL_BUTTON_RIGHT;
    click.button.state = SDL_PRESSED;
    click.button.x = 640 + 80;
    click.button.y = 360 - 160;
    Input input = step({click});
    EXPECT_TRUE(input.pressed(Mouse::right));
    ASSERT_TRUE(input.pointer());
    EXPECT_NEAR(input.pointer()->x, 11, 0.0125 / 2 + 0.0125 / 8);
    EXPECT_NEAR(input.pointer()->y, 7, 0.0125 / 2 + 0.0125 / 8);
    EXPECT_FALSE(step({window(SDL_WINDOWEVENT_LEAVE)}).pointer());
}

TEST_F(Sdl2Events, EnterTextOnlyWhenAsked) {
    SDL_Event text{};
    text.type = SDL_TEXTINPUT;
    SDL_strlcpy(text.text.text, "é", sizeof text.text.text);
    events_.take_text(true);
    const Input input = step({key(SDL_SCANCODE_E, true), text, key(SDL_SCANCODE_RETURN, true)});
    EXPECT_EQ(input.text(), "é");
    EXPECT_FALSE(input.pressed(Key::e));
    EXPECT_TRUE(input.pressed(Key::enter));
    events_.take_text(false);
    EXPECT_TRUE(step({key(SDL_SCANCODE_E, false), key(SDL_SCANCODE_E, true)}).pressed(Key::e));
}

TEST_F(Sdl2Events, ReadAController) {
    const int index = SDL_JoystickAttachVirtual(
        SDL_JOYSTICK_TYPE_GAMECONTROLLER, SDL_CONTROLLER_AXIS_MAX, SDL_CONTROLLER_BUTTON_MAX, 0);
    ASSERT_GE(index, 0) << SDL_GetError();
    (void)step_after_polling();
    SDL_Joystick* const pad = SDL_JoystickOpen(index);
    ASSERT_NE(pad, nullptr);
    SDL_JoystickSetVirtualButton(pad, SDL_CONTROLLER_BUTTON_X, 1);
    SDL_JoystickSetVirtualAxis(pad, SDL_CONTROLLER_AXIS_LEFTX, 32767);
    SDL_JoystickSetVirtualAxis(pad, SDL_CONTROLLER_AXIS_RIGHTY, -32768);
    SDL_JoystickSetVirtualAxis(pad, SDL_CONTROLLER_AXIS_TRIGGERRIGHT, 30000);
    Input input = step_after_polling();
    EXPECT_TRUE(input.pressed(Pad::west));
    EXPECT_EQ(input.stick(Stick::left_x), 1);
    EXPECT_EQ(input.stick(Stick::left_y), 0);
    EXPECT_EQ(input.stick(Stick::right_y), 1) << "up is positive";
    EXPECT_TRUE(input.pressed(Pad::right_trigger));
    EXPECT_GT(input.stick(Stick::right_trigger), 0.9F);
    // Before SDL itself releases the buttons.
    SDL_Event unplugged{};
    unplugged.type = SDL_CONTROLLERDEVICEREMOVED;
    unplugged.cdevice.which = SDL_JoystickInstanceID(pad);
    input = step({unplugged});
    EXPECT_TRUE(input.released(Pad::west));
    EXPECT_EQ(input.stick(Stick::left_x), 0);
    SDL_JoystickClose(pad);
    SDL_JoystickDetachVirtual(index);
}

}  // namespace
}  // namespace oiler::test
