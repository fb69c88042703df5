// SPDX-License-Identifier: MIT
#include "oiler/platform/sdl2_events.hpp"

#include <optional>

namespace oiler {
namespace {

std::optional<Button> mouse_button(std::uint8_t button) {
    static_assert(SDL_BUTTON_LEFT == 1 + static_cast<int>(Mouse::left) &&
                  SDL_BUTTON_MIDDLE == 1 + static_cast<int>(Mouse::middle) &&
                  SDL_BUTTON_X2 == 1 + static_cast<int>(Mouse::forward));
    if (button < SDL_BUTTON_LEFT || button > SDL_BUTTON_X2) return std::nullopt;
    return static_cast<Mouse>(button - SDL_BUTTON_LEFT);
}

std::optional<Button> pad_button(std::uint8_t button) {
    static_assert(SDL_CONTROLLER_BUTTON_A == static_cast<int>(Pad::south) &&
                  SDL_CONTROLLER_BUTTON_START == static_cast<int>(Pad::start) &&
                  SDL_CONTROLLER_BUTTON_DPAD_RIGHT == static_cast<int>(Pad::right));
    if (button > SDL_CONTROLLER_BUTTON_DPAD_RIGHT) return std::nullopt;
    return static_cast<Pad>(button);
}

void hand_out_mouse(const SDL_Event& event, Size part, const Receivers& receivers) {
    if (event.type == SDL_MOUSEWHEEL) return receivers.turn_wheel(event.wheel.y);
    if (event.type == SDL_MOUSEMOTION)
        return receivers.move_mouse(event.motion.x, event.motion.y, part);
    receivers.move_mouse(event.button.x, event.button.y, part, mouse_button(event.button.button),
                         event.button.state == SDL_PRESSED);
}

}  // namespace

// SDL takes text from the start on.
SdlEvents::SdlEvents(const Library& library) : sdl_{library} { sdl_.stop_text(); }

SdlEvents::~SdlEvents() {
    for (const auto& [id, controller] : controllers_) sdl_.close_controller(controller.handle);
}

void SdlEvents::handle(const SDL_Event& event, Size part, const Receivers& receivers) {
    InputQueue& game = receivers.game;
    switch (event.type) {
        case SDL_KEYDOWN:
        case SDL_KEYUP:
            return handle_key(event.key, receivers);
        case SDL_TEXTINPUT:
            return game.enter(event.text.text);
        case SDL_MOUSEMOTION:
        case SDL_MOUSEBUTTONDOWN:
        case SDL_MOUSEBUTTONUP:
        case SDL_MOUSEWHEEL:
            return hand_out_mouse(event, part, receivers);
        case SDL_WINDOWEVENT:
            if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) receivers.release_all();
            if (event.window.event == SDL_WINDOWEVENT_LEAVE) receivers.leave();
            return;
        case SDL_CONTROLLERDEVICEADDED:
            return plug_in(event.cdevice.which);
        case SDL_CONTROLLERDEVICEREMOVED:
            return unplug(event.cdevice.which, game);
        case SDL_CONTROLLERBUTTONDOWN:
        case SDL_CONTROLLERBUTTONUP:
            if (const auto button = pad_button(event.cbutton.button))
                game.set(*button, event.cbutton.state == SDL_PRESSED);
            return;
        case SDL_CONTROLLERAXISMOTION:
            return handle_axis(event.caxis, game);
        default:
            return;
    }
}

void SdlEvents::handle_key(const SDL_KeyboardEvent& event, const Receivers& receivers) const {
    if (event.repeat != 0) return;
    const auto code = static_cast<std::uint32_t>(event.keysym.scancode);
    if (code >= 256) return;
    const auto button = Button::of_id(static_cast<std::uint16_t>(code));
    if (button) receivers.set_key(*button, event.type == SDL_KEYDOWN, text_);
}

void SdlEvents::handle_axis(const SDL_ControllerAxisEvent& event, InputQueue& game) {
    const auto found = controllers_.find(event.which);
    if (found == controllers_.end() || event.axis >= stick_count) return;
    Controller& controller = found->second;
    if (event.axis >= controller.sticks.size()) {
        const std::size_t side = event.axis - controller.sticks.size();
        bool& pressed = controller.triggers[side];
        pressed = trigger_is_pressed(pressed, event.value);
        game.deflect(static_cast<Stick>(event.axis), trigger_position(event.value));
        game.set(side == 0 ? Pad::left_trigger : Pad::right_trigger, pressed);
        return;
    }
    controller.sticks[event.axis] = event.value;
    const std::size_t x = event.axis / 2U * 2U;
    // SDL's y goes down.
    const StickPosition at = without_dead_zone(controller.sticks[x], -controller.sticks[x + 1]);
    game.deflect(static_cast<Stick>(x), at.x);
    game.deflect(static_cast<Stick>(x + 1), at.y);
}

void SdlEvents::plug_in(int index) {
    SDL_GameController* const handle = sdl_.open_controller(index);
    if (handle == nullptr) return;
    controllers_[sdl_.instance_of(sdl_.joystick_of(handle))] = {handle, {}, {}};
}

void SdlEvents::unplug(SDL_JoystickID id, InputQueue& game) {
    const auto found = controllers_.find(id);
    if (found == controllers_.end()) return;
    sdl_.close_controller(found->second.handle);
    controllers_.erase(found);
    game.release_all();
}

void SdlEvents::take_text(bool on) {
    if (on == text_) return;
    text_ = on;
    on ? sdl_.start_text() : sdl_.stop_text();
}

std::string SdlEvents::name_on_layout(Key key) const {
    return sdl_.name_of_key(sdl_.key_of_scancode(static_cast<SDL_Scancode>(key)));
}

}  // namespace oiler
