// SPDX-License-Identifier: MIT
#include "oiler/capture/file_kind.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "oiler/core/error.hpp"
#include "oiler/core/read_number.hpp"

namespace oiler {
namespace {

namespace fs = std::filesystem;

/// A regular file; empty if there is none.
struct OldFile {
    std::string first;  ///< at most `most_read` bytes
    std::string last;   ///< the same
    std::size_t size = 0;
};

constexpr std::size_t most_read = 1 << 16;

OldFile read_ends(const fs::path& path) {
    struct stat found = {};
    if (stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return {};
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const auto size = static_cast<std::size_t>(found.st_size);
    const std::size_t length = std::min(size, most_read);
    OldFile file{std::string(length, '\0'), std::string(length, '\0'), size};
    const bool is_read =
        descriptor >= 0 && pread(descriptor, file.first.data(), length, 0) >= 0 &&
        pread(descriptor, file.last.data(), length, static_cast<off_t>(size - length)) >= 0;
    const int reason = errno;
    if (descriptor >= 0) close(descriptor);
    if (!is_read)
        fail(Exit::io, "cannot read {}, which would be replaced: {}; choose another path",
             path.string(), system_reason(reason));
    return file;
}

bool begins_as(std::string_view bytes, std::string_view beginning) {
    const std::size_t star = beginning.find('*');
    const std::string_view start = beginning.substr(0, star);
    const auto fits = [](char expected, char c) { return expected == '?' || expected == c; };
    if (bytes.size() < start.size() ||
        !std::ranges::equal(start, bytes.substr(0, start.size()), fits))
        return false;
    if (star == beginning.npos) return true;
    const std::size_t rest = bytes.find(beginning.substr(star + 1), start.size());
    return rest != bytes.npos && bytes.find('\n', start.size()) >= rest;
}

bool begins_as_one_of(std::string_view bytes, std::string_view beginnings) {
    while (true) {
        const std::size_t end = beginnings.find('|');
        if (begins_as(bytes, beginnings.substr(0, end))) return true;
        if (end == beginnings.npos) return false;
        beginnings.remove_prefix(end + 1);
    }
}

/// nlohmann takes a zero byte for the end.
bool is_json(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return nlohmann::json::accept(file) && file.peek() == EOF;
}

bool is_field(std::string_view field, Form form) {
    double number = 0;
    const char* const end = field.data() + field.size();
    const auto read = read_number(field.data(), end, number);
    if (read.ec == std::errc{} && read.ptr == end) return true;
    const auto is_of_word = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    };
    return form == Form::table && std::ranges::all_of(field, is_of_word);
}

/// Whether the text is complete rows with that number of commas.
bool are_rows(std::string_view text, std::ptrdiff_t commas, Form form) {
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        std::string_view row = text.substr(0, end);
        if (end == text.npos || std::ranges::count(row, ',') != commas) return false;
        for (std::ptrdiff_t i = 0; i <= commas; ++i) {
            const std::size_t comma = std::min(row.find(','), row.size());
            if (!is_field(row.substr(0, comma), form)) return false;
            row.remove_prefix(std::min(comma + 1, row.size()));
        }
        text.remove_prefix(end + 1);
    }
    return true;
}

/// Checks the first and the last rows, because a trace may have gigabytes.
bool has_rows(const OldFile& file, Form form) {
    const std::string_view first = file.first;
    const std::string_view last = file.last;
    const std::size_t header = first.find('\n') + 1;
    const auto commas = std::ranges::count(first.substr(0, header), ',');
    if (file.size == first.size()) return are_rows(first.substr(header), commas, form);
    const std::size_t cut = first.rfind('\n') + 1;
    return are_rows(first.substr(header, cut - header), commas, form) &&
           are_rows(last.substr(last.find('\n') + 1), commas, form);
}

}  // namespace

bool is_replaceable(const fs::path& path, const FileKind& kind) {
    const OldFile file = read_ends(path);
    if (file.size == 0) return true;
    if (!begins_as_one_of(file.first, kind.beginnings) || !file.last.ends_with(kind.ending))
        return false;
    if (kind.form == Form::json) return is_json(path);
    return kind.form == Form::any || has_rows(file, kind.form);
}

void require_replaceable(const fs::path& path, const FileKind& kind) {
    if (!is_replaceable(path, kind))
        fail(Exit::usage, "{} is not {} and would be lost; remove it or choose another path",
             path.string(), kind.name);
}

}  // namespace oiler
