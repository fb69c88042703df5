// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/world/world.hpp"

namespace oiler {

/// One number that a run is held against.
struct BudgetEntry {
    std::string name;
    double most = 0;
    double measured = 0;
    bool kept = true;
    std::string words;  ///< all of it, to read
};

/// What a run was and came to, for a program to read.
struct RunReport {
    std::string_view scene;
    Energy first;
    std::chrono::nanoseconds dropped{0};
    std::chrono::nanoseconds wall{0};
    std::vector<BudgetEntry> budget{};
};

/// Writes JSON to `path`, or to standard output for "-". Throws Error{io}.
void write_report(const std::filesystem::path& path, const RunReport& report, const World& world);

}  // namespace oiler
