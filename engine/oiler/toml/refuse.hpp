// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>
#include <utility>

namespace oiler {

/// A place in a TOML file.
struct Place {
    std::string_view file;
    int line = 1;
};

/// Throws Error{usage} with the message "FILE:LINE: …".
[[noreturn]] void refuse_text(const Place& place, const std::string& text);

template <class... Args>
[[noreturn]] void refuse(const Place& place, fmt::format_string<Args...> text, Args&&... args) {
    refuse_text(place, fmt::format(text, std::forward<Args>(args)...));
}

/// Makes text from a file safe for one line on a terminal: printable ASCII, at most `most` bytes
/// and "...".
[[nodiscard]] std::string printable(std::string_view text, std::size_t most = 60);

}  // namespace oiler
