// SPDX-License-Identifier: MIT
#pragma once

namespace oiler {

/// Says what the program did wrong and aborts, so that a debugger shows who did it.
[[noreturn]] void abort_on_mistake(const char* what);

/// What a program must not do to a world, such as using a handle whose entity is gone: checked in
/// every build, because carrying on would change some other entity.
inline void require(bool holds, const char* what) {
    if (!holds) [[unlikely]]
        abort_on_mistake(what);
}

}  // namespace oiler
