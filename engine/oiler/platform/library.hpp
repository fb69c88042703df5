// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace oiler {

/// A shared library loaded at run time, so that a program starts on machines that lack it and can
/// say what to install.
class Library {
public:
    /// Throws Error{no_display}: "cannot load SONAME (the loader's reason); REMEDY".
    Library(const char* soname, const char* remedy);
    ~Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    /// Sets `function` to the function called `name`. Throws Error{no_display} where it is missing.
    template <class Function>
    void resolve(Function*& function, const char* name) const {
        function = reinterpret_cast<Function*>(address(name));
    }

private:
    [[nodiscard]] void* address(const char* name) const;

    std::string soname_;
    void* handle_;
};

/// Keeps llvmpipe at vectors of 256 bits: Mesa 22.3 crashes at 512, and pixels are to be the same
/// on every machine. To be called before a GL driver is loaded; a user's own setting stands.
void tame_llvmpipe();

}  // namespace oiler
