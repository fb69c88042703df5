// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "oiler/app/options.hpp"

namespace oiler {

/// The size of a new window: from the command line, else that of the last window.
[[nodiscard]] Size first_size(const Options& options, const About& about);
/// Stores the size that the user gave to a window. Prints a remark if that fails.
void keep_size(const Options& options, const About& about, Size size);

/// The file with the size that a user gave to the window of a program, in the folder for states of
/// the XDG Base Directory Specification; empty without XDG_STATE_HOME and HOME.
[[nodiscard]] std::filesystem::path file_of_size(std::string_view program);

/// Reads the size; empty if there is no file. Throws Error{usage} if it holds none.
[[nodiscard]] std::optional<Size> read_size(const std::filesystem::path& file);
/// Throws Error{io}.
void write_size(const std::filesystem::path& file, Size size);

}  // namespace oiler
