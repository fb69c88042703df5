// SPDX-License-Identifier: MIT
#include "oiler/platform/surface.hpp"

#include "oiler/core/error.hpp"
#include "oiler/platform/library.hpp"
#include "oiler/platform/providers.hpp"

namespace oiler {
namespace {

std::unique_ptr<Surface> open_egl_after(const Error& osmesa) {
    try {
        return open_egl();
    } catch (const Error& egl) {
        fail(Exit::no_display,
             "no OpenGL without a screen: {}; {}; install the Debian package libosmesa6, or "
             "libegl1 with libgl1-mesa-dri",
             osmesa.what(), egl.what());
    }
}

}  // namespace

std::unique_ptr<Surface> open_offscreen(Offscreen which) {
    limit_llvmpipe_vectors();
    if (which == Offscreen::egl) {
        return open_egl();
    }
    try {
        return open_osmesa();
    } catch (const Error& osmesa) {
        if (which == Offscreen::osmesa) {
            throw;
        }
        return open_egl_after(osmesa);
    }
}

}  // namespace oiler
