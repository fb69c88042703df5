// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "oiler/compare/comparison.hpp"

namespace oiler {

/// Compares the frames of two folders. Throws Error{usage} if a folder has no finished golden or no
/// capture at all, if a PNG is damaged, or if its pixels are not those of its manifest.
[[nodiscard]] Comparison compare_captures(const std::filesystem::path& golden,
                                          const std::filesystem::path& actual,
                                          const PixelTolerance& tolerance);

}  // namespace oiler
