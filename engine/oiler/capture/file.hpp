// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace oiler {

/// A file that is written completely or not at all, so that a failed or interrupted run leaves no
/// partial frame. Bytes go to a temporary file in the same folder. commit() renames it to its final
/// name; without commit() it is deleted. A missing folder is made. "-" is the standard output.
/// Devices, pipes and the targets of standard output and standard error (/dev/stdout) cannot be
/// replaced and are written in place.
/// Every failure throws Error(Exit::io) with the path, the reason and a remedy.
class File {
public:
    explicit File(const std::filesystem::path& path);
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    /// Writes are buffered, so a full disk may be reported only by commit().
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);

    /// Flushes, closes and renames the file. No write may follow.
    void commit();

private:
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    int open_temporary();

    std::filesystem::path path_;       // as given by the user, for messages
    std::filesystem::path target_;     // path_ with symbolic links followed
    std::filesystem::path temporary_;  // empty if written in place or committed
    std::unique_ptr<std::FILE, Closer> file_;
};

/// Writes all of `bytes` to `path` through File.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

/// Makes the folder and its parents. Returns whether it was missing. Throws Error(Exit::io).
bool make_folder(const std::filesystem::path& path);

}  // namespace oiler
