// SPDX-License-Identifier: MIT
#include "oiler/toml/refuse.hpp"

#include <algorithm>

#include "oiler/core/error.hpp"

namespace oiler {

void refuse_text(const Place& place, const std::string& text) {
    fail(Exit::usage, "{}:{}: {}", place.file, place.line, text);
}

std::string printable(std::string_view text, std::size_t most) {
    std::string line(text.substr(0, most));
    std::ranges::replace_if(
        line, [](char c) { return c < ' ' || c > '~'; }, '?');
    return text.size() > most ? line + "..." : line;
}

}  // namespace oiler
