// SPDX-License-Identifier: MIT
#include "oiler/platform/sdl2_events.hpp"

#include <algorithm>
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

/// Whether a key acts as a key while text is entered.
bool edits_text(Button key) {
    constexpr Button keys[]{Key::enter, Key::escape, Key::backspace, Key::tab,
                            Key::left,  Key::right,  Key::up,        Key::down};
    return std::ranges::find(keys, key) != std::end(keys);
}

Point canvas_point(int x, int y, Size window) {
    const auto width = static_cast<float>(window.width);
    const auto height = static_cast<float>(window.height);
    const float scale = std::min(width / canvas_width, height / canvas_height);
    return {canvas_width / 2 + (static_cast<float>(x) + 0.5F - width / 2) / scale,
            canvas_height / 2 - (static_cast<float>(y) + 0.5F - height / 2) / scale};
}

int x_of(const SDL_Event& event) {
    return event.type == SDL_MOUSEMOTION ? event.motion.x : event.button.x;
}

/// A mouse that the queue does not `take` only releases buttons.
void handle_mouse(const SDL_Event& event, Size window, InputQueue& queue, bool take) {
    if (event.type == SDL_MOUSEWHEEL) {
        if (take) queue.turn_wheel(event.wheel.y);
        return;
    }
    const bool moves = event.type == SDL_MOUSEMOTION;
    if (take)
        queue.point_at(canvas_point(x_of(event), moves ? event.motion.y : event.button.y, window));
    if (moves) return;
    const bool down = event.button.state == SDL_PRESSED;
    const auto button = mouse_button(event.button.button);
    if (button && (take || !down)) queue.set(*button, down);
}

}  // namespace

// SDL takes text from the start on.
SdlEvents::SdlEvents(const Library& library) : sdl_{library} { sdl_.stop_text(); }

SdlEvents::~SdlEvents() {
    for (const auto& [id, controller] : controllers_) sdl_.close_controller(controller.handle);
}

void SdlEvents::handle(const SDL_Event& event, Size window, InputQueue& game, InputQueue& loop,
                       const Window::OfGame& of_game) {
    switch (event.type) {
        case SDL_KEYDOWN:
        case SDL_KEYUP:
            return handle_key(event.key, game, loop, of_game.escape);
        case SDL_TEXTINPUT:
            return game.enter(event.text.text);
        case SDL_MOUSEMOTION:
        case SDL_MOUSEBUTTONDOWN:
        case SDL_MOUSEBUTTONUP:
        case SDL_MOUSEWHEEL:
            handle_mouse(
                event, window, game,
                of_game.mouse && (event.type == SDL_MOUSEWHEEL || x_of(event) < window.width));
            return handle_mouse(event, window, loop, true);
        case SDL_WINDOWEVENT:
            if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) {
                game.release_all();
                loop.release_all();
            }
            if (event.window.event == SDL_WINDOWEVENT_LEAVE) {
                game.point_at(std::nullopt);
                loop.point_at(std::nullopt);
            }
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

void SdlEvents::handle_key(const SDL_KeyboardEvent& event, InputQueue& game, InputQueue& loop,
                           bool escape_is_of_game) const {
    if (event.repeat != 0) return;
    const auto code = static_cast<std::uint32_t>(event.keysym.scancode);
    if (code >= 256) return;
    const auto button = Button::of_id(static_cast<std::uint16_t>(code));
    if (!button) return;
    const bool down = event.type == SDL_KEYDOWN;
    loop.set(*button, down);
    if (is_of_loop(*button)) return;
    if (text_ && down && !edits_text(*button)) return;
    if (!escape_is_of_game && down && *button == Button(Key::escape)) return;
    game.set(*button, down);
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
