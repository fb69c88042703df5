// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <new>

// Replaces the global allocation functions of a program with counting ones; include it in one file.
// The functions that are not defined here call these. They are not inlined, because g++ then warns
// of the free.

inline long allocations = 0;

inline void* counted(void* memory) {
    ++allocations;
    if (!memory) throw std::bad_alloc();
    return memory;
}

[[gnu::noinline]] void* operator new(std::size_t size) { return counted(std::malloc(size)); }
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto align = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(align, (size + align - 1) / align * align));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
