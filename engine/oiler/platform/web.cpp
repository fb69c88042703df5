// SPDX-License-Identifier: MIT
// A canvas of a page. The page is told what the canvas shows, and answers with wishes, by functions
// of the object Module: see assets/web/oiler.js.
#include <emscripten/em_js.h>
#include <emscripten/emscripten.h>
#include <emscripten/html5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <functional>
#include <utility>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/platform/hand_out.hpp"
#include "oiler/platform/web_keys.hpp"

// This is JavaScript.
// clang-format off
EM_JS(void, oiler_web_title, (const char* title), { Module.onTitle?.(UTF8ToString(title)); });
EM_JS(void, oiler_web_text, (const char* line, const char* setting, bool isPaused), {
    Module.onText?.(UTF8ToString(line), UTF8ToString(setting), isPaused !== 0);
});
EM_JS(void, oiler_web_end, (const char* reason), { Module.onEnd?.(UTF8ToString(reason)); });
EM_JS(char*, oiler_web_wish, (), {
    const wish = Module.takeWish?.();
    return wish ? stringToNewUTF8(wish) : 0;
});
EM_JS(bool, oiler_web_closes, (), { return Module.closes === true; });
EM_JS(void, oiler_web_toggle_full_screen, (), {
    const toggle = async () => {
        if (document.fullscreenElement) await document.exitFullscreen();
        else await Module.canvas.requestFullscreen();
    };
    toggle().catch(() => Module.onRefusal?.());
});
EM_JS(double, oiler_web_pixels, (), { return window.devicePixelRatio || 1; });
// clang-format on
EM_JS_DEPS(oiler_web, "$UTF8ToString,$stringToNewUTF8");

namespace oiler {
namespace {

constexpr const char* canvas = "#canvas";
constexpr double pixels_per_notch = 100;  // of a wheel
constexpr double pinch_per_notch = 40;

/// Pixels per CSS pixel of a canvas of that width. A phone's canvas gets fewer than its screen has,
/// so that texts, whose least size is in pixels, can be read.
double sharpest(double width) {
    constexpr double narrow = 640;
    return width < narrow ? narrow / width : 3;
}

/// The events since the last poll, in the order in which they came.
class WebEvents {
public:
    WebEvents() {
        emscripten_set_keydown_callback(canvas, this, EM_TRUE, on_key);
        emscripten_set_keyup_callback(canvas, this, EM_TRUE, on_key);
        emscripten_set_blur_callback(canvas, this, EM_TRUE, on_blur);
        emscripten_set_mousedown_callback(canvas, this, EM_TRUE, on_mouse);
        emscripten_set_mouseup_callback(EMSCRIPTEN_EVENT_TARGET_WINDOW, this, EM_TRUE, on_mouse);
        emscripten_set_mousemove_callback(canvas, this, EM_TRUE, on_mouse);
        emscripten_set_mouseleave_callback(canvas, this, EM_TRUE, on_mouse);
        emscripten_set_wheel_callback(canvas, this, EM_TRUE, on_wheel);
        emscripten_set_touchstart_callback(canvas, this, EM_TRUE, on_touch);
        emscripten_set_touchmove_callback(canvas, this, EM_TRUE, on_touch);
        emscripten_set_touchend_callback(canvas, this, EM_TRUE, on_touch);
        emscripten_set_touchcancel_callback(canvas, this, EM_TRUE, on_touch);
    }
    ~WebEvents() { emscripten_html5_remove_all_event_listeners(); }
    WebEvents(const WebEvents&) = delete;
    WebEvents& operator=(const WebEvents&) = delete;

    /// `part` is the part of the game, in the units of the mouse; `top` is what lies above it.
    void hand_out(Size part, int top, const Receivers& receivers) {
        for (const Event& event : std::exchange(events_, {})) {
            const auto& [what, button, down, x, y, notches, text] = event;
            switch (what) {
                case What::key:
                    receivers.set_key(*button, down, text_);
                    break;
                case What::text:
                    receivers.game.enter(text);
                    break;
                case What::mouse:
                    receivers.move_mouse(x, y - top, part, button, down);
                    break;
                case What::wheel:
                    receivers.turn_wheel(notches);
                    break;
                case What::leave:
                    receivers.leave();
                    break;
                case What::blur:
                    receivers.release_all();
                    break;
            }
        }
        hand_out_pad(receivers.game);
    }
    void take_text(bool on) { text_ = on; }

private:
    enum class What { key, text, mouse, wheel, leave, blur };
    struct Event {
        What what;
        std::optional<Button> button{};
        bool down = false;
        int x = 0;
        int y = 0;
        int notches = 0;
        std::string text{};
    };

    static WebEvents& self(void* user) { return *static_cast<WebEvents*>(user); }

    // The keys of the browser, such as Ctrl+R and F12, keep their use.
    static EM_BOOL on_key(int type, const EmscriptenKeyboardEvent* event, void* user) {
        WebEvents& events = self(user);
        const auto key = key_of_code(event->code);
        const bool down = type == EMSCRIPTEN_EVENT_KEYDOWN;
        const bool is_of_browser = event->ctrlKey || event->metaKey || event->altKey;
        if (!key || (down && (is_of_browser || *key == Key::f12))) return EM_FALSE;
        if (!event->repeat)
            events.events_.push_back({.what = What::key, .button = *key, .down = down});
        const bool is_character = std::string_view(event->key).size() == 1 ||
                                  (static_cast<unsigned char>(event->key[0]) & 0x80U) != 0;
        if (down && events.text_ && is_character)
            events.events_.push_back({.what = What::text, .text = event->key});
        // Tab leaves the canvas, as it leaves everything else of a page.
        return *key != Key::tab;
    }

    static EM_BOOL on_blur(int, const EmscriptenFocusEvent*, void* user) {
        self(user).events_.push_back({.what = What::blur});
        return EM_FALSE;
    }

    static EM_BOOL on_mouse(int type, const EmscriptenMouseEvent* event, void* user) {
        WebEvents& events = self(user);
        const bool is_up = type == EMSCRIPTEN_EVENT_MOUSEUP;
        // A button may go up outside, where the place has another origin.
        Event mouse = is_up ? events.mouse_
                            : Event{.what = What::mouse,
                                    .x = static_cast<int>(event->targetX),
                                    .y = static_cast<int>(event->targetY)};
        if (type == EMSCRIPTEN_EVENT_MOUSELEAVE) {
            mouse.what = What::leave;
        } else if (is_up || type == EMSCRIPTEN_EVENT_MOUSEDOWN) {
            if (event->button >= mouse_buttons_of_dom.size()) return EM_FALSE;
            mouse.button = mouse_buttons_of_dom[event->button];
            mouse.down = !is_up;
        } else {
            events.mouse_ = mouse;
        }
        events.events_.push_back(mouse);
        return EM_FALSE;  // so that a click gives the canvas the keyboard
    }

    static EM_BOOL on_wheel(int, const EmscriptenWheelEvent* event, void* user) {
        const double pixels =
            event->deltaMode == DOM_DELTA_PIXEL ? event->deltaY : event->deltaY * pixels_per_notch;
        self(user).turn(-pixels / pixels_per_notch);
        return EM_TRUE;
    }

    /// Whole notches; the rest waits for more.
    void turn(double notches) {
        turned_ += notches;
        const double whole = std::trunc(turned_);
        turned_ -= whole;
        if (whole != 0)
            events_.push_back({.what = What::wheel, .notches = static_cast<int>(whole)});
    }

    /// One finger is the left mouse button, two fingers turn the wheel.
    static EM_BOOL on_touch(int type, const EmscriptenTouchEvent* event, void* user) {
        WebEvents& events = self(user);
        const bool ends = type == EMSCRIPTEN_EVENT_TOUCHEND || type == EMSCRIPTEN_EVENT_TOUCHCANCEL;
        const EmscriptenTouchPoint& first = event->touches[0];
        const int x = static_cast<int>(first.targetX);
        const int y = static_cast<int>(first.targetY);
        const int fingers = ends ? 0 : event->numTouches;
        if (fingers == 2) {
            const EmscriptenTouchPoint& second = event->touches[1];
            const double apart =
                std::hypot(second.targetX - first.targetX, second.targetY - first.targetY);
            if (events.fingers_ == 2) events.turn((apart - events.apart_) / pinch_per_notch);
            events.apart_ = apart;
        }
        const bool was_down = events.fingers_ == 1;
        const bool is_down = fingers == 1;
        if (was_down != is_down)
            events.events_.push_back(
                {.what = What::mouse, .button = Mouse::left, .down = is_down, .x = x, .y = y});
        else if (is_down)
            events.events_.push_back({.what = What::mouse, .x = x, .y = y});
        if (ends) events.events_.push_back({.what = What::leave});
        events.fingers_ = fingers;
        return EM_TRUE;
    }

    /// Reads the first pad of the standard layout. Returns whether there is one.
    static bool read_pad(EmscriptenGamepadEvent& pad) {
        if (emscripten_sample_gamepad_data() != EMSCRIPTEN_RESULT_SUCCESS) return false;
        for (int i = 0; i < emscripten_get_num_gamepads(); ++i)
            if (emscripten_get_gamepad_status(i, &pad) == EMSCRIPTEN_RESULT_SUCCESS &&
                pad.connected && std::string_view(pad.mapping) == "standard")
                return true;
        return false;
    }

    void hand_out_pad(InputQueue& game) {
        EmscriptenGamepadEvent pad{};
        const bool has_pad = read_pad(pad);
        if (!has_pad && !std::exchange(has_pad_, has_pad)) return;
        has_pad_ = has_pad;
        for (std::size_t i = 0; i < pads_of_dom.size(); ++i) {
            const bool down =
                has_pad && static_cast<int>(i) < pad.numButtons && pad.digitalButton[i];
            if (std::exchange(pad_down_[i], down) != down) game.set(pads_of_dom[i], down);
        }
        const auto raw = [&](int axis) {
            return has_pad && axis < pad.numAxes ? static_cast<int>(pad.axis[axis] * 32767) : 0;
        };
        for (const int side : {0, 1}) {
            const StickPosition at = without_dead_zone(raw(2 * side), -raw(2 * side + 1));
            game.deflect(static_cast<Stick>(2 * side), at.x);
            game.deflect(static_cast<Stick>(2 * side + 1), at.y);
            const int trigger = has_pad && pad.numButtons > 7
                                    ? static_cast<int>(pad.analogButton[6 + side] * 32767)
                                    : 0;
            game.deflect(static_cast<Stick>(4 + side), trigger_position(trigger));
        }
    }

    std::vector<Event> events_;
    Event mouse_{.what = What::mouse};  ///< its last move
    bool text_ = false;
    double turned_ = 0;  ///< notches of a wheel that are not whole
    int fingers_ = 0;
    double apart_ = 0;  ///< two fingers, in CSS pixels
    bool has_pad_ = false;
    std::array<bool, pads_of_dom.size()> pad_down_{};
};

class WebWindow final : public Window {
public:
    explicit WebWindow(const std::string& title) {
        EmscriptenWebGLContextAttributes attributes;
        emscripten_webgl_init_context_attributes(&attributes);
        attributes.majorVersion = 2;
        attributes.alpha = EM_FALSE;
        attributes.depth = EM_FALSE;
        attributes.antialias = EM_FALSE;  // a blit needs as many samples as the renderer has
        fit();
        context_ = emscripten_webgl_create_context(canvas, &attributes);
        if (context_ <= 0)
            fail(Exit::no_display, "this browser offers no WebGL 2; allow it, or take another one");
        emscripten_webgl_make_context_current(context_);
        emscripten_set_webglcontextlost_callback(canvas, this, EM_TRUE, on_lost);
        set_title(title);
    }
    ~WebWindow() override {
        emscripten_set_webglcontextlost_callback(canvas, nullptr, EM_TRUE, nullptr);
        emscripten_webgl_destroy_context(context_);
    }

    std::string_view provider() const override { return "webgl2"; }
    Procedure procedure(const char* name) const override {
        return reinterpret_cast<Procedure>(emscripten_webgl_get_proc_address(name));
    }
    Size size() const override { return size_; }
    int refresh_rate() const override { return 60; }
    bool paces_frames() const override { return true; }

    State poll(InputQueue& game, InputQueue& loop, const OfGame& of_game) override {
        fit();
        const auto share = [](double length, float part) {
            return static_cast<int>(std::lround(length * static_cast<double>(part)));
        };
        const int top = static_cast<int>(height_) - share(height_, of_game.height);
        events_.hand_out({share(width_, of_game.width), static_cast<int>(height_) - top}, top,
                         {game, loop, of_game});
        if (is_lost_) return State::lost;
        return oiler_web_closes() ? State::closed : State::open;
    }
    std::optional<std::string> take_dropped() override { return std::nullopt; }  // the page has it
    std::optional<std::string> take_wish() override {
        char* const text = oiler_web_wish();
        if (text == nullptr) return std::nullopt;
        std::string wish(text);
        std::free(text);
        return wish;
    }
    void set_title(const std::string& title) override { oiler_web_title(title.c_str()); }
    void tell(const Told& told) override {
        if (std::exchange(told_, told) != told)
            oiler_web_text(told.line.c_str(), told.setting.c_str(), told.is_paused);
    }
    /// The browser also refuses and ends a full screen itself, of which the game does not know.
    void fill_screen(bool) override { oiler_web_toggle_full_screen(); }
    std::string name_on_layout(Key) const override { return ""; }
    void take_text(bool on) override { events_.take_text(on); }
    void present() override {}  // the browser shows a frame when its function returns

private:
    static EM_BOOL on_lost(int, const void*, void* user) {
        static_cast<WebWindow*>(user)->is_lost_ = true;
        return EM_TRUE;
    }

    /// The canvas has as many pixels as it takes of the screen.
    void fit() {
        emscripten_get_element_css_size(canvas, &width_, &height_);
        const double pixels = std::min(oiler_web_pixels(), sharpest(width_));
        // A canvas lower than the line and a picture would leave the picture no height.
        constexpr long least = 64;
        const Size size{static_cast<int>(std::max(least, std::lround(width_ * pixels))),
                        static_cast<int>(std::max(least, std::lround(height_ * pixels)))};
        if (size == size_) return;
        size_ = size;
        emscripten_set_canvas_element_size(canvas, size.width, size.height);
    }

    EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context_ = 0;
    Size size_;
    double width_ = 0;  ///< CSS pixels
    double height_ = 0;
    WebEvents events_;
    Told told_;
    bool is_lost_ = false;
};

/// Returns whether the next frame follows; else deletes the function.
EM_BOOL call_frame(double, void* user) {
    auto* const frame = static_cast<std::function<bool()>*>(user);
    std::string reason;
    try {
        if ((*frame)()) return EM_TRUE;
    } catch (const std::exception& error) {
        reason = error.what();
    }
    delete frame;
    oiler_web_end(reason.c_str());
    return EM_FALSE;
}

}  // namespace

bool has_display() { return true; }

std::unique_ptr<Window> open_window(Size, const std::string& title, Fit) {
    return std::make_unique<WebWindow>(title);
}

std::unique_ptr<Surface> open_offscreen(Offscreen) {
    fail(Exit::no_display, "a page draws on its canvas only");
}

void repeat(std::function<bool()> frame) {
    emscripten_request_animation_frame_loop(call_frame,
                                            new std::function<bool()>(std::move(frame)));
}

}  // namespace oiler
