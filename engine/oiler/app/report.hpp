// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/world/world.hpp"

namespace oiler {

/// One limit of a budget, compared with the run.
struct BudgetEntry {
    std::string name;
    double most = 0;
    double measured = 0;
    bool kept = true;
    std::string words;  ///< the entry as a sentence
};

/// Results of a run that its world does not hold.
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
