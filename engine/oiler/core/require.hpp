// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace oiler {

/// A use that breaks a rule of the API, such as the handle of a destroyed entity. Nothing has been
/// changed. A program that does not catch it ends with its line, and a debugger shows the caller.
class Mistake : public std::logic_error {
    using std::logic_error::logic_error;
};
[[noreturn]] void throw_mistake(const char* what);

/// Throws Mistake unless `holds`. It is checked in every build, because continuing would change
/// another entity.
inline void require(bool holds, const char* what) {
    if (!holds) [[unlikely]]
        throw_mistake(what);
}

}  // namespace oiler
