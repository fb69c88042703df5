// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>
#include <utility>

namespace oiler {

/// A place in a scene file.
struct Place {
    std::string_view file;
    int line = 1;
};

/// Throws Error{usage} with the line "FILE:LINE: …".
[[noreturn]] void refuse_text(const Place& place, const std::string& text);

template <class... Args>
[[noreturn]] void refuse(const Place& place, fmt::format_string<Args...> text, Args&&... args) {
    refuse_text(place, fmt::format(text, std::forward<Args>(args)...));
}

/// What a file holds, fit for a line on a terminal: nothing but printable ASCII, and of that at
/// most `most` bytes.
[[nodiscard]] std::string printable(std::string_view text, std::size_t most = 60);

}  // namespace oiler
