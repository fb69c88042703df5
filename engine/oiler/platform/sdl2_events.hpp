// SPDX-License-Identifier: MIT
#pragma once

#include <SDL2/SDL.h>

#include <array>
#include <map>

#include "oiler/core/size.hpp"
#include "oiler/platform/hand_out.hpp"
#include "oiler/platform/providers.hpp"

namespace oiler {

/// SDL's functions for game controllers and text, resolved at run time like the others.
struct SdlInputFunctions {
    const Library& library;
    decltype(&SDL_GameControllerOpen) open_controller = library["SDL_GameControllerOpen"];
    decltype(&SDL_GameControllerClose) close_controller = library["SDL_GameControllerClose"];
    decltype(&SDL_GameControllerGetJoystick) joystick_of = library["SDL_GameControllerGetJoystick"];
    decltype(&SDL_JoystickInstanceID) instance_of = library["SDL_JoystickInstanceID"];
    decltype(&SDL_StartTextInput) start_text = library["SDL_StartTextInput"];
    decltype(&SDL_StopTextInput) stop_text = library["SDL_StopTextInput"];
    decltype(&SDL_GetKeyFromScancode) key_of_scancode = library["SDL_GetKeyFromScancode"];
    decltype(&SDL_GetKeyName) name_of_key = library["SDL_GetKeyName"];
};

/// Translates SDL's events to those of a game. Keys are places of the keyboard, whatever is printed
/// on them. The keys of the loop, F1 to F12, are kept from the game; all others go to both.
class SdlEvents {
public:
    explicit SdlEvents(const Library& library);
    ~SdlEvents();
    SdlEvents(const SdlEvents&) = delete;
    SdlEvents& operator=(const SdlEvents&) = delete;

    /// `part` is the size of the game's part of the window in the units of the mouse.
    void handle(const SDL_Event& event, Size part, const Receivers& receivers);
    void take_text(bool on);
    [[nodiscard]] std::string name_on_layout(Key key) const;

private:
    struct Controller {
        SDL_GameController* handle;
        std::array<int, 4> sticks;  ///< raw, of left_x to right_y
        std::array<bool, 2> triggers;
    };

    void handle_key(const SDL_KeyboardEvent& event, const Receivers& receivers) const;
    void handle_axis(const SDL_ControllerAxisEvent& event, InputQueue& game);
    void plug_in(int index);
    void unplug(SDL_JoystickID id, InputQueue& game);

    SdlInputFunctions sdl_;
    std::map<SDL_JoystickID, Controller> controllers_;
    bool text_ = false;
};

}  // namespace oiler
