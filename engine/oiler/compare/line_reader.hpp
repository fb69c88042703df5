// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace oiler {

/// Reads a text file line by line, in pieces: files may be larger than the memory, or pipes.
class LineReader {
public:
    /// Throws Error(Exit::io) if the file cannot be read, as next() does.
    explicit LineReader(const std::filesystem::path& path);

    /// The next line without its line end; empty after the last one. It is valid until the next
    /// call.
    [[nodiscard]] std::optional<std::string_view> next();

    /// The number of the line that next() returned, from 1.
    [[nodiscard]] std::int64_t number() const { return number_; }
    /// Whether that line has a line end. Without one, the file ends there or the line is longer
    /// than a MiB.
    [[nodiscard]] bool ended() const { return ended_; }

private:
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    void fill();
    [[noreturn]] void fail_read(int error_number) const;

    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Closer> file_;
    std::vector<char> buffer_;
    std::string_view unread_;  ///< in buffer_
    std::int64_t number_ = 0;
    bool ended_ = false;
};

}  // namespace oiler
