// SPDX-License-Identifier: MIT
#include "oiler/platform/providers.hpp"

#include <dlfcn.h>
#include <cstdlib>

#include "oiler/core/error.hpp"

namespace oiler {

// RTLD_NODELETE: a driver has threads of its own, which crash if it is unmapped.
Library::Library(const char* soname, const char* remedy)
    : soname_(soname), handle_(dlopen(soname, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
    if (handle_ == nullptr)
        fail(Exit::no_display, "cannot load {} ({}); {}", soname, dlerror(), remedy);
}

Library::~Library() { dlclose(handle_); }

Library::Symbol Library::operator[](const char* name) const {
    void* found = dlsym(handle_, name);
    if (found == nullptr)
        fail(Exit::no_display, "{} has no function {}; is it a damaged or very old version?",
             soname_, name);
    return {found};
}

void limit_llvmpipe_vectors() { setenv("LP_NATIVE_VECTOR_WIDTH", "256", 0); }

}  // namespace oiler
