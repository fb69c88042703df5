// SPDX-License-Identifier: MIT
#include <GL/osmesa.h>

#include <array>
#include <csetjmp>
#include <csignal>

#include "oiler/core/error.hpp"
#include "oiler/platform/providers.hpp"

namespace oiler {
namespace {

constexpr const char* osmesa_remedy = "install the Debian package libosmesa6, or use --surface egl";

/// Where a crash continues; null in threads that catch none.
thread_local sigjmp_buf* after_crash = nullptr;

void leave_call(int number) {
    if (after_crash != nullptr) siglongjmp(*after_crash, 1);
    signal(number, SIG_DFL);
}

/// Returns null if Mesa crashes: it does if an environment variable such as GALLIUM_DRIVER names a
/// driver that it does not have.
OSMesaContext create_context(decltype(&OSMesaCreateContextAttribs) create, const int* attributes) {
    struct sigaction on_crash {};
    struct sigaction before {};
    on_crash.sa_handler = leave_call;
    sigaction(SIGSEGV, &on_crash, &before);
    sigjmp_buf buffer;
    after_crash = &buffer;
    OSMesaContext const context = sigsetjmp(buffer, 1) == 0 ? create(attributes, nullptr) : nullptr;
    after_crash = nullptr;
    sigaction(SIGSEGV, &before, nullptr);
    return context;
}

/// Mesa's off-screen rendering into memory. Mesa 25.1 removed it; EGL replaces it.
class OsMesa final : public Surface {
public:
    OsMesa() : library_("libOSMesa.so.8", osmesa_remedy) { open(); }

    ~OsMesa() override {
        make_current_(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
        destroy_(context_);
    }

    std::string_view provider() const override { return "osmesa"; }
    Procedure procedure(const char* name) const override { return procedure_(name); }

private:
    void open() {
        constexpr int attributes[]{OSMESA_FORMAT,
                                   OSMESA_RGBA,
                                   OSMESA_PROFILE,
                                   OSMESA_CORE_PROFILE,
                                   OSMESA_CONTEXT_MAJOR_VERSION,
                                   3,
                                   OSMESA_CONTEXT_MINOR_VERSION,
                                   3,
                                   0};
        context_ = create_context(create_, attributes);
        if (context_ == nullptr)
            fail(Exit::no_display,
                 "OSMesa offers no OpenGL 3.3 core context; unset variables of Mesa such as "
                 "GALLIUM_DRIVER; {}",
                 osmesa_remedy);
        if (make_current_(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
            destroy_(context_);
            fail(Exit::no_display, "OSMesa cannot make its context current; {}", osmesa_remedy);
        }
    }

    Library library_;
    decltype(&OSMesaCreateContextAttribs) create_ = library_["OSMesaCreateContextAttribs"];
    decltype(&OSMesaDestroyContext) destroy_ = library_["OSMesaDestroyContext"];
    decltype(&OSMesaMakeCurrent) make_current_ = library_["OSMesaMakeCurrent"];
    decltype(&OSMesaGetProcAddress) procedure_ = library_["OSMesaGetProcAddress"];
    /// The default framebuffer that OSMesa requires. It stays unused.
    std::array<unsigned char, 4> pixel_{};
    OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<Surface> open_osmesa() { return std::make_unique<OsMesa>(); }

}  // namespace oiler
