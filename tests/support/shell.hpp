// SPDX-License-Identifier: MIT
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "support/folder.hpp"

namespace oiler::test {

/// The exit code and the output of a program.
struct Outcome {
    int exit = -1;
    std::string out;
    std::string err;
};

/// Runs a line of shell with the built programs on the PATH and without a display.
inline Outcome shell(const std::string& line) {
    const Folder folder;
    const std::string whole =
        "export PATH=" OILER_PROGRAMS ":$PATH; unset DISPLAY WAYLAND_DISPLAY SDL_VIDEODRIVER; { " +
        line + "\n} >" + (folder / "out").string() + " 2>" + (folder / "err").string();
    const int status = std::system(whole.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder / "out"),
            text_of(folder / "err")};
}

}  // namespace oiler::test
