// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace oiler::lab {

/// The machine on which times were measured.
struct Machine {
    std::string cpu;
    int cores = 1;
    std::string compiler;
    friend bool operator==(const Machine&, const Machine&) = default;
};

[[nodiscard]] Machine this_machine();

}  // namespace oiler::lab
