// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <csignal>

namespace oiler {

/// While it lives, Ctrl-C, a polite kill and a terminal that closes are remembered instead of
/// ending the program, so that a run stops between two frames with its files complete; and a reader
/// that goes away is an error of writing.
class Interrupt {
public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    [[nodiscard]] static bool requested();

private:
    struct Former {
        int signal;
        struct sigaction action;
    };
    std::array<Former, 4> former_{};
};

}  // namespace oiler
