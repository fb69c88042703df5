// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "oiler/capture/file.hpp"
#include "oiler/core/json.hpp"

namespace oiler::cli {

// Texts in files; the path "-" of an output is standard output. All functions throw Error{io}.

void write_text(const std::filesystem::path& path, const std::string& text,
                Links links = Links::followed);
void write_json(const std::filesystem::path& path, const Json& json);

/// The scene files of a folder, sorted; none if it cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> scene_files(const std::filesystem::path& folder);

/// Writes to standard output.
void print(const std::string& text);

}  // namespace oiler::cli
