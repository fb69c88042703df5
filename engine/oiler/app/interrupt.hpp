// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>

namespace oiler {

/// While it lives, Ctrl-C and a polite kill are remembered instead of ending the program, so that a
/// run stops between two frames with its files complete.
class Interrupt {
public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    [[nodiscard]] static bool requested();

private:
    struct sigaction former_int_ {};
    struct sigaction former_term_ {};
};

}  // namespace oiler
