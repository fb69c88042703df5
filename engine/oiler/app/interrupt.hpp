// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <csignal>

namespace oiler {

/// Handles signals during its lifetime. SIGINT (Ctrl-C), SIGTERM and SIGHUP only set a flag, so
/// that a run stops between two frames with complete files. SIGPIPE is ignored, so that a closed
/// pipe is a write error.
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
