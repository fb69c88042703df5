// SPDX-License-Identifier: MIT
#define SDL_MAIN_HANDLED
#include <SDL2/SDL.h>
#include <SDL2/SDL_syswm.h>
#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "oiler/core/error.hpp"
#include "oiler/platform/providers.hpp"
#include "oiler/platform/sdl2_events.hpp"
#include "oiler/platform/surface.hpp"

namespace oiler {
namespace {

// The types of Xlib.h, which defines macros such as None: a Display is only passed on here.
using EndHandler = int (*)(void* display);
using ErrorHandler = int (*)(void* display, void* event);
using ExitHandler = void (*)(void* display, void* data);

std::atomic<bool> lost = false;  // global: an EndHandler has no argument for it

// These replace Xlib's messages.
int remember_end(void*) {
    lost = true;
    return 0;
}
int remember_error(void*, void*) {
    lost = true;
    return 0;
}

/// Replaces exit(1). Xlib's function then returns with an error.
void keep_running(void*, void*) {}

/// A function of libX11; null if SDL has not loaded it.
template <class Function>
Function x11_function(const char* name) {
    void* const library = dlopen("libX11.so.6", RTLD_NOW | RTLD_NOLOAD);
    if (library == nullptr) return nullptr;
    void* const found = dlsym(library, name);
    dlclose(library);
    return reinterpret_cast<Function>(found);
}

/// Keeps the process alive when the server of an X11 display reports an error, for example because
/// it has no OpenGL. By default Xlib then calls exit(1).
void outlive_x11_errors() {
    const auto set_error = x11_function<ErrorHandler (*)(ErrorHandler)>("XSetErrorHandler");
    if (set_error != nullptr) set_error(remember_error);
}

/// Keeps the process alive when the server ends, so that the files of a run are not lost. `display`
/// is a Display*; without libX11 1.7 or later the process still ends.
void outlive_display(void* display) {
    const auto set_end = x11_function<EndHandler (*)(EndHandler)>("XSetIOErrorHandler");
    const auto set_exit =
        x11_function<void (*)(void*, ExitHandler, void*)>("XSetIOErrorExitHandler");
    if (set_end == nullptr || set_exit == nullptr) return;
    set_end(remember_end);
    set_exit(display, keep_running, nullptr);
}

/// Returns whether the server has ended or reported an error. After that, no function of X11 or SDL
/// may be called.
bool display_is_lost() { return lost; }

constexpr const char* sdl_remedy =
    "install the Debian package libsdl2-2.0-0, or run with --headless";

struct SdlFunctions {
    const Library& library;
    decltype(&SDL_SetHint) set_hint = library["SDL_SetHint"];
    decltype(&SDL_SetMainReady) set_main_ready = library["SDL_SetMainReady"];
    decltype(&SDL_InitSubSystem) init = library["SDL_InitSubSystem"];
    decltype(&SDL_Quit) quit = library["SDL_Quit"];
    decltype(&SDL_GetError) error = library["SDL_GetError"];
    decltype(&SDL_GetCurrentVideoDriver) video_driver = library["SDL_GetCurrentVideoDriver"];
    decltype(&SDL_CreateWindow) create_window = library["SDL_CreateWindow"];
    decltype(&SDL_DestroyWindow) destroy_window = library["SDL_DestroyWindow"];
    decltype(&SDL_GetWindowDisplayIndex) display_index = library["SDL_GetWindowDisplayIndex"];
    decltype(&SDL_GetCurrentDisplayMode) display_mode = library["SDL_GetCurrentDisplayMode"];
    decltype(&SDL_GetDisplayUsableBounds) usable_bounds = library["SDL_GetDisplayUsableBounds"];
    decltype(&SDL_PollEvent) poll_event = library["SDL_PollEvent"];
    decltype(&SDL_GL_SetAttribute) set_attribute = library["SDL_GL_SetAttribute"];
    decltype(&SDL_GL_CreateContext) create_context = library["SDL_GL_CreateContext"];
    decltype(&SDL_GL_DeleteContext) delete_context = library["SDL_GL_DeleteContext"];
    decltype(&SDL_GL_MakeCurrent) make_current = library["SDL_GL_MakeCurrent"];
    decltype(&SDL_GL_GetProcAddress) procedure = library["SDL_GL_GetProcAddress"];
    decltype(&SDL_GL_SetSwapInterval) swap_interval = library["SDL_GL_SetSwapInterval"];
    decltype(&SDL_GL_GetDrawableSize) drawable_size = library["SDL_GL_GetDrawableSize"];
    decltype(&SDL_GL_SwapWindow) swap_window = library["SDL_GL_SwapWindow"];
    decltype(&SDL_GetWindowSize) window_size = library["SDL_GetWindowSize"];
    decltype(&SDL_GetWindowWMInfo) window_info = library["SDL_GetWindowWMInfo"];
    decltype(&SDL_SetWindowTitle) set_title = library["SDL_SetWindowTitle"];
    decltype(&SDL_SetWindowFullscreen) set_fullscreen = library["SDL_SetWindowFullscreen"];
    decltype(&SDL_free) free = library["SDL_free"];
};

/// SDL's library with its video and its controllers, for the lifetime of the object.
class Sdl {
public:
    Sdl() : library_("libSDL2-2.0.so.0", sdl_remedy), sdl_{library_} {
        sdl_.set_main_ready();
        // The program handles Ctrl-C itself, to complete its files.
        sdl_.set_hint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
        sdl_.set_hint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
        // Without this folder there is no Wayland, and libwayland would print that on stderr.
        if (std::getenv("XDG_RUNTIME_DIR") == nullptr)
            sdl_.set_hint(SDL_HINT_VIDEODRIVER, "x11,KMSDRM");
        const bool has_video = sdl_.init(SDL_INIT_VIDEO) == 0;
        outlive_x11_errors();
        if (!has_video || invisible()) {
            const std::string reason = sdl_.error();
            sdl_.quit();
            fail(Exit::no_display, "no display to open a window on (SDL: {}); run with --headless",
                 reason.empty() ? "only an invisible driver" : reason);
        }
    }
    ~Sdl() {
        if (!display_is_lost()) sdl_.quit();
    }
    Sdl(const Sdl&) = delete;
    Sdl& operator=(const Sdl&) = delete;

    const SdlFunctions* operator->() const { return &sdl_; }

private:
    /// Without a display SDL does not fail; it selects an invisible driver.
    [[nodiscard]] bool invisible() const {
        const char* driver = sdl_.video_driver();
        const std::string_view name = driver != nullptr ? driver : "";
        return name.empty() || name == "offscreen" || name == "dummy" || name == "evdev";
    }

    Library library_;
    SdlFunctions sdl_;
};

int share(int length, float part) {
    return static_cast<int>(std::lround(static_cast<float>(length) * part));
}

/// Gives the mouse in an event another origin, so many units below.
void move_up(SDL_Event& event, int units) {
    if (event.type == SDL_MOUSEMOTION) event.motion.y -= units;
    if (event.type == SDL_MOUSEBUTTONDOWN || event.type == SDL_MOUSEBUTTONUP)
        event.button.y -= units;
}

class SdlWindow final : public Window {
public:
    SdlWindow(Size size, const std::string& title, Fit fit) {
        request_core_context();
        if (fit == Fit::display) size = fitted(size);
        window_ = sdl_->create_window(
            title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, size.width, size.height,
            SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
        if (window_ != nullptr) {
            outlive_x11_display();
            context_ = sdl_->create_context(window_);
        }
        if (context_ != nullptr && !display_is_lost()) take_over_thread();
        if (context_ == nullptr || display_is_lost()) {
            const std::string reason = display_is_lost() ? "the display refuses" : sdl_->error();
            close();
            fail(Exit::no_display, "cannot open a window with OpenGL 3.3 ({}); run with --headless",
                 reason);
        }
        sdl_->swap_interval(1);
        // A system without controllers plays with keys.
        (void)sdl_->init(SDL_INIT_GAMECONTROLLER);
        events_.emplace(sdl_->library);
    }
    ~SdlWindow() override { close(); }

    std::string_view provider() const override { return "sdl2"; }
    Procedure procedure(const char* name) const override {
        return reinterpret_cast<Procedure>(sdl_->procedure(name));
    }

    Size size() const override {
        Size size;
        sdl_->drawable_size(window_, &size.width, &size.height);
        return size;
    }

    int refresh_rate() const override {
        SDL_DisplayMode mode{};
        const bool known = sdl_->display_mode(sdl_->display_index(window_), &mode) == 0;
        return known && mode.refresh_rate > 0 ? mode.refresh_rate : 60;
    }

    State poll(InputQueue& game, InputQueue& loop, const OfGame& of_game) override {
        bool quit = false;
        SDL_Event event;
        while (!display_is_lost() && sdl_->poll_event(&event) != 0) {
            Size window;
            sdl_->window_size(window_, &window.width, &window.height);
            const int top = window.height - share(window.height, of_game.height);
            window = {share(window.width, of_game.width), window.height - top};
            move_up(event, top);
            events_->handle(event, window, {game, loop, of_game});
            if (event.type == SDL_DROPFILE) {
                dropped_ = event.drop.file;
                sdl_->free(event.drop.file);
            }
            const bool closed =
                event.type == SDL_WINDOWEVENT && event.window.event == SDL_WINDOWEVENT_CLOSE;
            quit = quit || closed || event.type == SDL_QUIT;
        }
        if (display_is_lost()) return State::lost;
        return quit ? State::closed : State::open;
    }
    std::optional<std::string> take_dropped() override {
        return std::exchange(dropped_, std::nullopt);
    }
    void set_title(const std::string& title) override { sdl_->set_title(window_, title.c_str()); }
    void fill_screen(bool on) override {
        sdl_->set_fullscreen(window_, on ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
    }
    std::string name_on_layout(Key key) const override { return events_->name_on_layout(key); }
    void take_text(bool on) override { events_->take_text(on); }

    void present() override { sdl_->swap_window(window_); }

private:
    [[nodiscard]] Size fitted(Size size) const {
        constexpr int display = 0;  // windows open on it
        SDL_Rect room{};
        if (sdl_->usable_bounds(display, &room) != 0 || room.w <= 0 || room.h <= 0) return size;
        return {std::min(size.width, room.w), std::min(size.height, room.h)};
    }

    void request_core_context() const {
        sdl_->set_attribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
        sdl_->set_attribute(SDL_GL_CONTEXT_MINOR_VERSION, 3);
        sdl_->set_attribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
        sdl_->set_attribute(SDL_GL_DOUBLEBUFFER, 1);
    }

    /// Releases the context first: SDL skips a context that it believes current, but OSMesa may
    /// have taken the thread's slot in libglapi.
    void take_over_thread() const {
        sdl_->make_current(window_, nullptr);
        sdl_->make_current(window_, context_);
    }

    void outlive_x11_display() const {
        SDL_SysWMinfo info;
        SDL_VERSION(&info.version);
        if (sdl_->window_info(window_, &info) == SDL_TRUE && info.subsystem == SDL_SYSWM_X11)
            outlive_display(info.info.x11.display);
    }

    void close() {
        if (display_is_lost()) return;
        events_.reset();
        if (context_ != nullptr) {
            sdl_->make_current(window_, nullptr);
            sdl_->delete_context(context_);
        }
        if (window_ != nullptr) sdl_->destroy_window(window_);
    }

    Sdl sdl_;
    SDL_Window* window_ = nullptr;
    SDL_GLContext context_ = nullptr;
    std::optional<SdlEvents> events_;
    std::optional<std::string> dropped_;
};

}  // namespace

std::unique_ptr<Window> open_window(Size size, const std::string& title, Fit fit) {
    limit_llvmpipe();
    return std::make_unique<SdlWindow>(size, title, fit);
}

}  // namespace oiler
