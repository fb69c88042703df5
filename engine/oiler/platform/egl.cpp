// SPDX-License-Identifier: MIT
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdlib>
#include <string_view>

#include "oiler/core/error.hpp"
#include "oiler/platform/providers.hpp"

namespace oiler {
namespace {

constexpr const char* egl_remedy = "install the Debian packages libegl1 and libgl1-mesa-dri";

/// The functions of libEGL that a context without a surface needs.
struct EglFunctions {
    const Library& library;
    decltype(&eglGetProcAddress) procedure = library["eglGetProcAddress"];
    decltype(&eglInitialize) initialise = library["eglInitialize"];
    decltype(&eglTerminate) terminate = library["eglTerminate"];
    decltype(&eglBindAPI) bind_api = library["eglBindAPI"];
    decltype(&eglChooseConfig) choose_config = library["eglChooseConfig"];
    decltype(&eglCreateContext) create_context = library["eglCreateContext"];
    decltype(&eglDestroyContext) destroy_context = library["eglDestroyContext"];
    decltype(&eglMakeCurrent) make_current = library["eglMakeCurrent"];
};

/// With this driver, Mesa 25 waits for ever where Vulkan has no device.
void refuse_zink() {
    for (const char* const name : {"GALLIUM_DRIVER", "MESA_LOADER_DRIVER_OVERRIDE"}) {
        const char* const driver = std::getenv(name);
        if (driver != nullptr && driver == std::string_view("zink"))
            fail(Exit::no_display, "{} is zink, for which Mesa may wait for ever; {}", name,
                 usual_driver);
    }
}

/// EGL on Mesa's surfaceless platform: no display server, no default framebuffer.
class Egl final : public Surface {
public:
    Egl() : library_("libEGL.so.1", egl_remedy), egl_{library_}, display_(open_display()) {
        context_ = create_context();
        if (context_ == EGL_NO_CONTEXT ||
            egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
            egl_.terminate(display_);
            fail(Exit::no_display, "EGL offers no OpenGL 3.3 core context without a screen; {}; {}",
                 usual_driver, egl_remedy);
        }
    }

    ~Egl() override {
        egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        egl_.destroy_context(display_, context_);
        egl_.terminate(display_);
    }

    std::string_view provider() const override { return "egl"; }
    Procedure procedure(const char* name) const override { return egl_.procedure(name); }

private:
    [[nodiscard]] EGLDisplay open_display() const {
        const auto get_platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
            egl_.procedure("eglGetPlatformDisplayEXT"));
        EGLDisplay display = EGL_NO_DISPLAY;
        if (get_platform_display != nullptr)
            display = get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
        if (display == EGL_NO_DISPLAY || egl_.initialise(display, nullptr, nullptr) == EGL_FALSE)
            fail(Exit::no_display, "EGL has no surfaceless platform; {}; {}", usual_driver,
                 egl_remedy);
        return display;
    }

    [[nodiscard]] EGLContext create_context() const {
        constexpr EGLint wanted[]{EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                  EGL_NONE};
        constexpr EGLint attributes[]{EGL_CONTEXT_MAJOR_VERSION,
                                      3,
                                      EGL_CONTEXT_MINOR_VERSION,
                                      3,
                                      EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                      EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (egl_.bind_api(EGL_OPENGL_API) == EGL_FALSE ||
            egl_.choose_config(display_, wanted, &config, 1, &count) == EGL_FALSE || count == 0)
            return EGL_NO_CONTEXT;
        return egl_.create_context(display_, config, EGL_NO_CONTEXT, attributes);
    }

    Library library_;
    EglFunctions egl_;
    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Surface> open_egl() {
    refuse_zink();
    return std::make_unique<Egl>();
}

}  // namespace oiler
