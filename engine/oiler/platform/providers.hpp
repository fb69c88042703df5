// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "oiler/platform/surface.hpp"

namespace oiler {

/// Both throw Error{no_display} with the Debian packages to install.
[[nodiscard]] std::unique_ptr<Surface> open_osmesa();
[[nodiscard]] std::unique_ptr<Surface> open_egl();

/// The remedy where a library cannot be loaded for lack of memory.
inline constexpr const char* more_memory = "allow the program more memory, see `ulimit -v`";
/// The remedy where Mesa has no driver.
inline constexpr const char* usual_driver = "unset variables of Mesa such as GALLIUM_DRIVER";

/// A shared library, loaded at run time. A program therefore starts without it and can name the
/// package to install.
class Library {
public:
    /// Throws Error{no_display}: "cannot load SONAME (the loader's reason); REMEDY", or
    /// more_memory.
    Library(const char* soname, const char* remedy);
    ~Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    /// A function; it becomes a pointer of the type that it initialises.
    struct Symbol {
        void* address;
        template <class Function>
        operator Function*() const {
            return reinterpret_cast<Function*>(address);
        }
    };
    /// Throws Error{no_display} if the function is missing.
    [[nodiscard]] Symbol operator[](const char* name) const;

private:
    std::string soname_;
    void* handle_;
};

/// Limits llvmpipe to vectors of 256 bits: Mesa 22.3 crashes with 512, and pixels must be the same
/// on every machine. If the machine does not give the threads that llvmpipe wants, it gets none:
/// it would wait for them for ever. Call it before a GL driver is loaded. LP_NATIVE_VECTOR_WIDTH
/// and LP_NUM_THREADS of the user override it. Throws Error{no_display} for a width below a float,
/// or if the program may not have the memory that Mesa needs.
void limit_llvmpipe();

}  // namespace oiler
