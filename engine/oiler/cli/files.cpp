// SPDX-License-Identifier: MIT
#include "oiler/cli/files.hpp"

#include <algorithm>
#include <span>
#include <system_error>

#include "oiler/capture/file.hpp"

namespace oiler::cli {

void write_text(const std::filesystem::path& path, const std::string& text, Links links) {
    write_file(path, std::as_bytes(std::span(text)), links);
}

void write_json(const std::filesystem::path& path, const Json& json) {
    write_text(path, json.dump(2) + "\n");
}

std::vector<std::filesystem::path> scene_files(const std::filesystem::path& folder) {
    std::error_code none;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none))
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

void print(const std::string& text) { write_text("-", text); }

}  // namespace oiler::cli
