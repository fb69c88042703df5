// SPDX-License-Identifier: MIT
#include "oiler/capture/file_kind.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

namespace fs = std::filesystem;

/// The first bytes of a regular file; empty if there is none.
std::string read_beginning(const fs::path& path) {
    struct stat found = {};
    if (stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return "";
    std::array<char, 1 << 13> bytes;  // more than the longest path
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const ssize_t count = descriptor < 0 ? -1 : read(descriptor, bytes.data(), bytes.size());
    const int reason = errno;
    if (descriptor >= 0) close(descriptor);
    if (count < 0)
        fail(Exit::io, "cannot read {}, which would be replaced: {}; choose another path",
             path.string(), system_reason(reason));
    return {bytes.data(), static_cast<std::size_t>(count)};
}

bool begins_as(std::string_view bytes, std::string_view beginning) {
    const std::size_t star = beginning.find('*');
    const std::string_view start = beginning.substr(0, star);
    const auto fits = [](char expected, char c) { return expected == '?' || expected == c; };
    return bytes.size() >= start.size() &&
           std::ranges::equal(start, bytes.substr(0, start.size()), fits) &&
           (star == beginning.npos ||
            bytes.find(beginning.substr(star + 1), start.size()) != bytes.npos);
}

}  // namespace

bool is_replaceable(const fs::path& path, const FileKind& kind) {
    const std::string bytes = read_beginning(path);
    if (bytes.empty()) return true;
    std::string_view left = kind.beginnings;
    while (true) {
        const std::size_t end = left.find('|');
        if (begins_as(bytes, left.substr(0, end))) return true;
        if (end == left.npos) return false;
        left.remove_prefix(end + 1);
    }
}

void require_replaceable(const fs::path& path, const FileKind& kind) {
    if (!is_replaceable(path, kind))
        fail(Exit::usage, "{} is not {} and would be lost; remove it or choose another path",
             path.string(), kind.name);
}

}  // namespace oiler
