// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "oiler/core/size.hpp"
#include "oiler/input/input.hpp"

namespace oiler {

/// A current OpenGL 3.3 core context of any provider. A surface may have no framebuffer, so a
/// renderer draws into its own FBO.
class Surface {
public:
    using Procedure = void (*)();

    virtual ~Surface() = default;
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    /// "sdl2", "osmesa" or "egl".
    [[nodiscard]] virtual std::string_view provider() const = 0;
    /// The address of a GL function; null if the provider has none.
    [[nodiscard]] virtual Procedure procedure(const char* name) const = 0;

protected:
    Surface() = default;
};

/// A surface on the user's display.
class Window : public Surface {
public:
    /// Size of the drawable, in pixels; changes when the user resizes the window.
    [[nodiscard]] virtual Size size() const = 0;
    /// Refresh rate of the display, in Hz; 60 if unknown.
    [[nodiscard]] virtual int refresh_rate() const = 0;
    enum class State {
        open,
        closed,  ///< by the user
        lost,    ///< the display has ended
    };
    /// The parts of the window that belong to the game.
    struct OfGame {
        float width = 1;   ///< the share with the canvas, at the left
        float height = 1;  ///< the share with the canvas, at the bottom
        bool mouse = true;
        bool escape = true;
    };
    /// Hands events since the last call to the loop, and all but F1 to F12 to the game. A mouse or
    /// Escape that is not the game's only releases buttons there.
    [[nodiscard]] virtual State poll(InputQueue& game, InputQueue& loop, const OfGame& of_game) = 0;
    /// The file that was dropped on the window since the last call, the last one of several.
    [[nodiscard]] virtual std::optional<std::string> take_dropped() = 0;
    virtual void set_title(const std::string& title) = 0;
    /// Fills the screen, or goes back to a window.
    virtual void fill_screen(bool on) = 0;
    /// The name of a key on the user's keyboard; empty if it has none.
    [[nodiscard]] virtual std::string name_on_layout(Key key) const = 0;
    /// Lets keys enter text, except those that edit it.
    virtual void take_text(bool on) = 0;
    /// What the window shows, in words.
    struct Told {
        std::string line;     ///< on the error of the timestep
        std::string setting;  ///< such as "rk4@120"
        bool is_paused = false;
        friend bool operator==(const Told&, const Told&) = default;
    };
    /// Tells it to what is around a canvas, for people who do not see that. A window has nothing
    /// around it.
    virtual void tell(const Told&) {}
    /// The setting that the user wants through what is around a canvas, such as "rk4@120".
    [[nodiscard]] virtual std::optional<std::string> take_wish() { return std::nullopt; }
    /// Whether the display itself makes the frames wait.
    [[nodiscard]] virtual bool paces_frames() const { return false; }
    /// Shows framebuffer 0.
    virtual void present() = 0;
};

/// The provider without a window; `automatic` selects OSMesa, or EGL if OSMesa is missing.
enum class Offscreen { automatic, osmesa, egl };

/// Whether the environment names a display; there may be none all the same.
[[nodiscard]] bool has_display();

enum class Fit {
    none,
    display,  ///< at most as large as the display, without its panels
};

/// Opens a window of about `size` on the user's display.
/// Throws Error{no_display}, naming --headless, without a display, SDL2 or GL 3.3.
[[nodiscard]] std::unique_ptr<Window> open_window(Size size, const std::string& title, Fit fit);

/// Calls the function until it returns false. In a page, the browser calls it later, for each
/// frame.
void repeat(std::function<bool()> frame);

/// Opens a context without a screen. Its library is loaded at run time.
/// Throws Error{no_display}, naming the Debian package to install.
[[nodiscard]] std::unique_ptr<Surface> open_offscreen(Offscreen which);

}  // namespace oiler
