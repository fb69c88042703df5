// SPDX-License-Identifier: MIT
#include "oiler/compare/line_reader.hpp"

#include <cerrno>
#include <cstring>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 20;

}  // namespace

LineReader::LineReader(const std::filesystem::path& path)
    : path_(path),
      file_(std::fopen(path.c_str(), "rbe")),
      buffer_(buffer_size),
      unread_(buffer_.data(), 0) {
    if (!file_) fail_read(errno);
    std::setbuf(file_.get(), nullptr);
}

std::optional<std::string_view> LineReader::next() {
    std::size_t end = unread_.find('\n');
    if (end == unread_.npos) {
        fill();
        end = unread_.find('\n');
    }
    if (unread_.empty()) return std::nullopt;
    ++number_;
    ended_ = end != unread_.npos;
    const std::string_view line = unread_.substr(0, end);
    unread_.remove_prefix(ended_ ? end + 1 : unread_.size());
    return line;
}

/// Moves what is unread to the start of the buffer and reads until it is full or the file ends.
void LineReader::fill() {
    const std::size_t kept = unread_.size();
    std::memmove(buffer_.data(), unread_.data(), kept);
    const std::size_t read =
        std::fread(buffer_.data() + kept, 1, buffer_.size() - kept, file_.get());
    if (std::ferror(file_.get()) != 0) fail_read(errno);
    unread_ = {buffer_.data(), kept + read};
}

void LineReader::fail_read(int error_number) const {
    fail(Exit::io, "{}: cannot be read: {}", path_.string(), system_reason(error_number));
}

}  // namespace oiler
