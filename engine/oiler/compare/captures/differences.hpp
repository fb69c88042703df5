// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "oiler/compare/captures/comparison.hpp"
#include "oiler/core/markup.hpp"

namespace oiler {

/// Writes index.html, a page that shows the failed frames without a network, and for each of the
/// first 20 of them expected_N.png, actual_N.png and difference_N.png, the difference × 16. Removes
/// the files of an earlier comparison; if the comparison passed, it only does that. Throws
/// Error{io}.
void write_differences(const Comparison& comparison, const std::filesystem::path& folder);

/// Returns whether write_differences() may write a file of that name.
[[nodiscard]] bool is_differences_file(std::string_view name);

/// The folder beside that of the frames where a page of differences is expected:
/// frames/spring-differences.
[[nodiscard]] std::filesystem::path differences_folder(const std::filesystem::path& actual);

/// The comparison as a JUnit suite with a case for each cause.
[[nodiscard]] JunitSuite suite_of(const Comparison& comparison);

}  // namespace oiler
