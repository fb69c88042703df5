// SPDX-License-Identifier: MIT
#pragma once

namespace oiler {

/// Prints the programmer's mistake and aborts, so that a debugger shows the caller.
[[noreturn]] void abort_on_mistake(const char* what);

/// Aborts unless `holds`. It guards the rules of the API, such as not using the handle of a
/// destroyed entity. It is checked in every build, because continuing would change another entity.
inline void require(bool holds, const char* what) {
    if (!holds) [[unlikely]]
        abort_on_mistake(what);
}

}  // namespace oiler
