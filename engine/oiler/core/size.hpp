// SPDX-License-Identifier: MIT
#pragma once

namespace oiler {

/// Width and height of a frame or a window, in pixels.
struct Size {
    int width = 0;
    int height = 0;
    friend bool operator==(const Size&, const Size&) = default;
};

}  // namespace oiler
