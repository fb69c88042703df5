// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "oiler/capture/file.hpp"
#include "oiler/core/json.hpp"

namespace oiler::cli {

// Texts in files; the path "-" of an output is standard output. All functions throw Error{io}.

/// Throws Error{usage} for a missing file or a folder, Error{io} if the machine refuses.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text,
                Links links = Links::followed);
void write_json(const std::filesystem::path& path, const Json& json);

/// Writes to standard output.
void print(const std::string& text);

}  // namespace oiler::cli
