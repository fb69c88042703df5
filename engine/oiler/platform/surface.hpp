// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "oiler/core/input.hpp"
#include "oiler/core/size.hpp"

namespace oiler {

/// A current OpenGL 3.3 core context, whoever provides it. A surface has no framebuffer that a
/// renderer may rely on: what is drawn is drawn into an FBO of the renderer's own.
class Surface {
public:
    using Procedure = void (*)();

    virtual ~Surface() = default;
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    /// "sdl2", "osmesa" or "egl".
    [[nodiscard]] virtual std::string_view provider() const = 0;
    /// The address of a GL function, null where the provider has none.
    [[nodiscard]] virtual Procedure procedure(const char* name) const = 0;

protected:
    Surface() = default;
};

/// A surface that somebody looks at.
class Window : public Surface {
public:
    /// Of the drawable, in pixels; changes when the user resizes.
    [[nodiscard]] virtual Size size() const = 0;
    /// Display refresh in Hz; 60 where the system does not tell.
    [[nodiscard]] virtual int refresh_rate() const = 0;
    /// Moves keys pressed and released since the last call into `input`; says whether the user has
    /// closed the window.
    [[nodiscard]] virtual bool poll(Input& input) = 0;
    /// Shows what was drawn into framebuffer 0.
    virtual void present() = 0;
};

/// Where a program without a window draws; `automatic` takes OSMesa, else EGL.
enum class Offscreen { automatic, osmesa, egl };

/// Opens a window of about `size` on the user's display.
/// Throws Error{no_display}, naming --headless, where there is no display, no SDL2 or no GL 3.3.
[[nodiscard]] std::unique_ptr<Window> open_window(Size size, const std::string& title);

/// A context without a screen, its library loaded at run time.
/// Throws Error{no_display}, naming the Debian package that cures it.
[[nodiscard]] std::unique_ptr<Surface> open_offscreen(Offscreen which);

}  // namespace oiler
