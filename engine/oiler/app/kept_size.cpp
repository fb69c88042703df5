// SPDX-License-Identifier: MIT
#include "oiler/app/kept_size.hpp"

#include <cstdlib>
#include <fstream>
#include <string>

#include "oiler/capture/file.hpp"
#include "oiler/core/error.hpp"
#include "oiler/process/console.hpp"
#include "oiler/process/parse_size.hpp"

namespace oiler {

namespace fs = std::filesystem;

namespace {

/// The file with the size of the window. All scenes share one.
fs::path size_file(const About& about) {
    return file_of_size(about.scene_text.empty() ? about.name : "oiler");
}

}  // namespace

Size first_size(const Options& options, const About& about) {
    if (options.has_size) return options.size;
    try {
        return read_size(size_file(about)).value_or(options.size);
    } catch (const Error& error) {
        remark(options.quiet, "{}", error.what());
        return options.size;
    }
}

void keep_size(const Options& options, const About& about, Size size) {
    const fs::path file = size_file(about);
    if (file.empty()) return;
    try {
        write_size(file, size);
    } catch (const Error& error) {
        remark(options.quiet, "{}", error.what());
    }
}

fs::path file_of_size(std::string_view program) {
    const auto folder = [](const char* variable) {
        const char* const value = std::getenv(variable);
        return fs::path(value ? value : "");
    };
    fs::path states = folder("XDG_STATE_HOME");
    if (states.empty() && !folder("HOME").empty()) states = folder("HOME") / ".local" / "state";
    return states.empty() ? fs::path() : states / "oiler" / (std::string(program) + ".size");
}

std::optional<Size> read_size(const fs::path& file) {
    std::ifstream stream(file);
    if (!stream) return std::nullopt;
    std::string words;
    std::getline(stream, words);
    try {
        return parse_size(words);
    } catch (const Error&) {
        fail(Exit::usage, "{}: expected a size such as 1280x720, got '{}'; remove the file",
             file.string(), words);
    }
}

void write_size(const fs::path& file, Size size) {
    write_file(file, fmt::format("{}x{}\n", size.width, size.height));
}

}  // namespace oiler
