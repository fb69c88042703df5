// SPDX-License-Identifier: MIT
#include "oiler/cli/files.hpp"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <span>

#include "oiler/capture/file.hpp"
#include "oiler/core/error.hpp"

namespace oiler::cli {

std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::error_code error;
    const int reason = errno;
    if (std::filesystem::is_directory(path, error))
        fail(Exit::usage, "{}: it is a folder; give a file", path.string());
    if (!file)
        fail(exit_of_open(reason), "{}: cannot be read: {}; give a file that you may read",
             path.string(), system_reason(reason));
    return {std::istreambuf_iterator<char>(file), {}};
}

void write_text(const std::filesystem::path& path, const std::string& text, Links links) {
    write_file(path, std::as_bytes(std::span(text)), links);
}

void write_json(const std::filesystem::path& path, const Json& json) {
    write_text(path, json.dump(2) + "\n");
}

void print(const std::string& text) { write_text("-", text); }

}  // namespace oiler::cli
