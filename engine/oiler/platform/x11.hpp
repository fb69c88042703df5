// SPDX-License-Identifier: MIT
#pragma once

namespace oiler {

/// Keeps the process alive when the server of an X11 display ends or reports an error. By default
/// Xlib then calls exit(1), and the files of a run are lost. `display` is a Display* of a loaded
/// libX11; without libX11 1.7 or later the default stays.
void outlive_display(void* display);

/// Returns whether the server has ended or reported an error. After that, no function of X11 or SDL
/// may be called.
[[nodiscard]] bool display_is_lost();

}  // namespace oiler
