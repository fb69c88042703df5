// SPDX-License-Identifier: MIT
#include "oiler/platform/x11.hpp"

#include <dlfcn.h>

#include <atomic>

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

}  // namespace

void outlive_display(void* display) {
    void* const library = dlopen("libX11.so.6", RTLD_NOW | RTLD_NOLOAD);
    if (library == nullptr) return;
    const auto set_error =
        reinterpret_cast<ErrorHandler (*)(ErrorHandler)>(dlsym(library, "XSetErrorHandler"));
    const auto set_end =
        reinterpret_cast<EndHandler (*)(EndHandler)>(dlsym(library, "XSetIOErrorHandler"));
    const auto set_exit = reinterpret_cast<void (*)(void*, ExitHandler, void*)>(
        dlsym(library, "XSetIOErrorExitHandler"));
    if (set_error != nullptr && set_end != nullptr && set_exit != nullptr) {
        set_error(remember_error);
        set_end(remember_end);
        set_exit(display, keep_running, nullptr);
    }
    dlclose(library);
}

bool display_is_lost() { return lost; }

}  // namespace oiler
