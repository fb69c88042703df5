// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace oiler {

/// A file that is written whole or not at all, so that a failed or interrupted run never leaves
/// half a frame under a good name: bytes go to a temporary file in the same folder, which takes the
/// name at commit() and is removed without one. "-" is standard output. A device, a pipe, and
/// whatever standard output or standard error goes to (/dev/stdout) cannot be replaced: they are
/// written in place. Every failure throws Error(Exit::io) with the path, the reason and a remedy.
class File {
public:
    explicit File(const std::filesystem::path& path);
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    /// Buffered: a full disk may show only at commit().
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);

    /// Flushes, closes and gives the file its name; nothing may be written afterwards.
    void commit();

private:
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    int open_temporary();

    std::filesystem::path path_;       // as the user named it, for messages
    std::filesystem::path target_;     // path_ with symbolic links followed
    std::filesystem::path temporary_;  // empty when written in place, or committed
    std::unique_ptr<std::FILE, Closer> file_;
};

/// Writes all of `bytes` to `path` through File.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Makes the folder and its parents; says whether it was missing. Throws Error(Exit::io).
bool make_folder(const std::filesystem::path& path);

}  // namespace oiler
