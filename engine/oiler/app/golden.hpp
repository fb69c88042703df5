// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "oiler/app/options.hpp"
#include "oiler/app/report.hpp"
#include "oiler/capture/capture_folder.hpp"
#include "oiler/core/error.hpp"

namespace oiler {

/// Compares the frames in `options.out` with the golden and prints the differences. Writes the page
/// of differences and, on request, JUnit XML with the budget. Throws Error.
[[nodiscard]] Exit compare_with_golden(const Options& options,
                                       const std::vector<BudgetEntry>& budget);

/// The hidden folder beside the golden into which --update-golden captures.
[[nodiscard]] std::filesystem::path folder_of_new_golden(const std::filesystem::path& golden);

/// Replaces the golden by a complete new capture. A run that fails leaves the old one. The golden
/// is locked meanwhile.
class GoldenUpdate {
public:
    /// Throws Error{io}, see CaptureFolder.
    GoldenUpdate(const std::filesystem::path& golden, const std::string& scene);
    /// Removes an uncommitted capture.
    ~GoldenUpdate();
    GoldenUpdate(const GoldenUpdate&) = delete;
    GoldenUpdate& operator=(const GoldenUpdate&) = delete;

    /// Moves the new files into the golden, the manifest last. Throws Error{io}.
    void commit();

private:
    CaptureFolder golden_;
    std::filesystem::path captured_;
};

}  // namespace oiler
