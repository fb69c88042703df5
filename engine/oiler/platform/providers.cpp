// SPDX-License-Identifier: MIT
#include "oiler/platform/providers.hpp"

#include <dlfcn.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <latch>
#include <thread>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/core/team.hpp"

namespace oiler {
namespace {

/// Whether the machine gives as many threads as llvmpipe starts at most, and one for its cache.
bool gives_threads() {
    const std::size_t wanted = std::clamp(std::thread::hardware_concurrency(), 1U, 16U) + 1;
    std::latch tried(1);
    std::vector<std::thread> threads;
    start_threads(threads, wanted, [&tried](std::size_t) { tried.wait(); });
    tried.count_down();
    for (std::thread& thread : threads) thread.join();
    return threads.size() == wanted;
}

/// Mesa damages its memory if a vector has no room for a float.
void refuse_narrow_vectors() {
    const char* const given = std::getenv("LP_NATIVE_VECTOR_WIDTH");
    char* end = nullptr;
    const long bits = given == nullptr ? 0 : std::strtol(given, &end, 0);
    if (end != given && bits >= 0 && bits < 32)
        fail(Exit::no_display,
             "LP_NATIVE_VECTOR_WIDTH is {}; unset it, or set it to 128, 256 or 512", given);
}

/// Mesa crashes where a limit such as `ulimit -v` leaves it less than this, in bytes: its libraries
/// and the stacks of its threads.
void refuse_little_memory() {
    constexpr std::size_t needed = std::size_t{768} << 20;
    void* const room =
        mmap(nullptr, needed, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room == MAP_FAILED)
        fail(Exit::no_display, "OpenGL needs {} MB of address space; {}", needed >> 20,
             more_memory);
    munmap(room, needed);
}

}  // namespace

// RTLD_NODELETE: a driver has threads of its own, which crash if it is unmapped.
Library::Library(const char* soname, const char* remedy)
    : soname_(soname), handle_(dlopen(soname, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
    if (handle_ != nullptr) return;
    const std::string why = dlerror();
    const bool lacks_memory = why.find("failed to map segment") != std::string::npos ||
                              why.find("allocate memory") != std::string::npos;
    fail(Exit::no_display, "cannot load {} ({}); {}", soname, why,
         lacks_memory ? more_memory : remedy);
}

Library::~Library() { dlclose(handle_); }

Library::Symbol Library::operator[](const char* name) const {
    void* found = dlsym(handle_, name);
    if (found == nullptr)
        fail(Exit::no_display, "{} has no function {}; is it a damaged or very old version?",
             soname_, name);
    return {found};
}

void limit_llvmpipe() {
    refuse_narrow_vectors();
    refuse_little_memory();
    setenv("LP_NATIVE_VECTOR_WIDTH", "256", 0);
    if (!gives_threads()) setenv("LP_NUM_THREADS", "0", 0);
}

}  // namespace oiler
