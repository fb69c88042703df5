// SPDX-License-Identifier: MIT
#include <array>
#include <csetjmp>
#include <csignal>

#include "oiler/core/error.hpp"
#include "oiler/platform/providers.hpp"

namespace oiler {
namespace {

/// The functions of libOSMesa that are in use. No header declares them since Mesa 25.1; their
/// interface is frozen.
struct OsMesaFunctions {
    const Library& library;
    void* (*create_context)(const int* attributes,
                            void* shared) = library["OSMesaCreateContextAttribs"];
    void (*destroy_context)(void* context) = library["OSMesaDestroyContext"];
    unsigned char (*make_current)(void* context, void* pixels, unsigned type, int width,
                                  int height) = library["OSMesaMakeCurrent"];
    Surface::Procedure (*procedure)(const char* name) = library["OSMesaGetProcAddress"];
};

/// Where a crash continues; null in threads that catch none.
thread_local sigjmp_buf* after_crash = nullptr;

void leave_call(int number) {
    if (after_crash != nullptr) siglongjmp(*after_crash, 1);
    signal(number, SIG_DFL);
}

/// Returns null if Mesa crashes: it does if an environment variable such as GALLIUM_DRIVER names a
/// driver that it does not have.
void* create_context(const OsMesaFunctions& osmesa) {
    constexpr int attributes[]{0x22, 0x1908,  // OSMESA_FORMAT, OSMESA_RGBA
                               0x33, 0x34,    // OSMESA_PROFILE, OSMESA_CORE_PROFILE
                               0x36, 3,       // OSMESA_CONTEXT_MAJOR_VERSION
                               0x37, 3,       // OSMESA_CONTEXT_MINOR_VERSION
                               0};
    struct sigaction on_crash {};
    struct sigaction before {};
    on_crash.sa_handler = leave_call;
    sigaction(SIGSEGV, &on_crash, &before);
    sigjmp_buf buffer;
    after_crash = &buffer;
    void* const context =
        sigsetjmp(buffer, 1) == 0 ? osmesa.create_context(attributes, nullptr) : nullptr;
    after_crash = nullptr;
    sigaction(SIGSEGV, &before, nullptr);
    return context;
}

/// Mesa's off-screen rendering into memory.
class OsMesa final : public Surface {
public:
    OsMesa()
        : library_("libOSMesa.so.8",
                   "Mesa 25.1 dropped OSMesa: use --surface egl, or install the package "
                   "libosmesa6 of Debian 12 or 13"),
          osmesa_{library_} {
        open();
    }

    ~OsMesa() override {
        osmesa_.make_current(nullptr, nullptr, unsigned_byte, 0, 0);
        osmesa_.destroy_context(context_);
    }

    std::string_view provider() const override { return "osmesa"; }
    Procedure procedure(const char* name) const override { return osmesa_.procedure(name); }

private:
    static constexpr unsigned unsigned_byte = 0x1401;  // GL_UNSIGNED_BYTE

    void open() {
        context_ = create_context(osmesa_);
        if (context_ == nullptr)
            fail(Exit::no_display,
                 "OSMesa offers no OpenGL 3.3 core context; {}, or use --surface egl",
                 usual_driver);
        if (osmesa_.make_current(context_, pixel_.data(), unsigned_byte, 1, 1) == 0) {
            osmesa_.destroy_context(context_);
            fail(Exit::no_display, "OSMesa cannot make its context current; use --surface egl");
        }
    }

    Library library_;
    OsMesaFunctions osmesa_;
    /// The default framebuffer that OSMesa requires. It stays unused.
    std::array<unsigned char, 4> pixel_{};
    void* context_ = nullptr;
};

}  // namespace

std::unique_ptr<Surface> open_osmesa() { return std::make_unique<OsMesa>(); }

}  // namespace oiler
