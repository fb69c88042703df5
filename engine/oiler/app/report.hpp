// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <string_view>

#include "oiler/world/world.hpp"

namespace oiler {

/// What a run was and came to, for a program to read.
struct RunReport {
    std::string_view scene;
    Energy first;
    std::chrono::nanoseconds dropped{0};
    std::chrono::nanoseconds wall{0};
};

/// Writes JSON to `path`, or to standard output for "-". Throws Error{io}.
void write_report(const std::filesystem::path& path, const RunReport& report, const World& world);

}  // namespace oiler
