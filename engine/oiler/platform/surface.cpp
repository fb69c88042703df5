// SPDX-License-Identifier: MIT
#include "oiler/platform/surface.hpp"

#include <cstdlib>
#include <string_view>

#include "oiler/core/error.hpp"
#include "oiler/platform/providers.hpp"

namespace oiler {
namespace {

std::unique_ptr<Surface> open_egl_after(const Error& osmesa) {
    try {
        return open_egl();
    } catch (const Error& egl) {
        if (std::string_view(osmesa.what()).ends_with(more_memory))
            fail(Exit::no_display, "no OpenGL without a screen: {}", osmesa.what());
        fail(Exit::no_display, "no OpenGL without a screen: {}; {}", osmesa.what(), egl.what());
    }
}

}  // namespace

bool has_display() {
    const auto is_set = [](const char* variable) {
        const char* const value = std::getenv(variable);
        return value != nullptr && *value != '\0';
    };
    return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

void repeat(std::function<bool()> frame) {
    while (frame()) {
    }
}

std::unique_ptr<Surface> open_offscreen(Offscreen which) {
    limit_llvmpipe();
    if (which == Offscreen::egl) return open_egl();
    try {
        return open_osmesa();
    } catch (const Error& osmesa) {
        if (which == Offscreen::osmesa) throw;
        return open_egl_after(osmesa);
    }
}

}  // namespace oiler
