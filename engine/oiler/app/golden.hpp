// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "oiler/app/options.hpp"
#include "oiler/app/report.hpp"
#include "oiler/capture/capture_folder.hpp"
#include "oiler/core/error.hpp"

namespace oiler {

/// Compares the frames in `options.out` with the golden and prints the differences. Writes the page
/// of differences and, on request, JUnit XML with the budget. Throws Error.
[[nodiscard]] Exit compare_with_golden(const Options& options,
                                       const std::vector<BudgetEntry>& budget);

/// Writes --junit of a run that ended without a comparison: a failure if it diverged or differs
/// from its recording, else an error. An older file would show CI the result of another run. Throws
/// Error{io}.
void write_junit_of_failure(const Options& options, Exit exit, std::string_view reason);

/// Replaces the golden by a complete new capture. A run that fails leaves the old one. The golden
/// is locked meanwhile.
class GoldenUpdate {
public:
    /// Throws Error{io}, see CaptureFolder.
    GoldenUpdate(const std::filesystem::path& golden, const std::string& scene);
    /// Removes the new capture, unless commit() failed.
    ~GoldenUpdate();
    GoldenUpdate(const GoldenUpdate&) = delete;
    GoldenUpdate& operator=(const GoldenUpdate&) = delete;

    /// Replaces the golden. Throws Error{io}.
    void commit();

private:
    CaptureFolder golden_;
    bool commit_failed_ = false;
};

}  // namespace oiler
