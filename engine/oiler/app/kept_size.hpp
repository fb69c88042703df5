// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "oiler/core/size.hpp"

namespace oiler {

/// The file with the size that a user gave to the window of a program, in the folder for states of
/// the XDG Base Directory Specification; empty without XDG_STATE_HOME and HOME.
[[nodiscard]] std::filesystem::path file_of_size(std::string_view program);

/// Reads the size; empty if there is no file. Throws Error{usage} if it holds none.
[[nodiscard]] std::optional<Size> read_size(const std::filesystem::path& file);
/// Throws Error{io}.
void write_size(const std::filesystem::path& file, Size size);

}  // namespace oiler
