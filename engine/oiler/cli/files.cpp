// SPDX-License-Identifier: MIT
#include "oiler/cli/files.hpp"

#include <span>

#include "oiler/capture/file.hpp"

namespace oiler::cli {

void write_text(const std::filesystem::path& path, const std::string& text, Links links) {
    write_file(path, std::as_bytes(std::span(text)), links);
}

void write_json(const std::filesystem::path& path, const Json& json) {
    write_text(path, json.dump(2) + "\n");
}

void print(const std::string& text) { write_text("-", text); }

}  // namespace oiler::cli
