// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace oiler {

/// Removes the first code point from a text that is not empty, and returns it. A byte outside a
/// well-formed sequence (RFC 3629) is U+FFFD.
char32_t take_code(std::string_view& text);

/// Decodes UTF-8. Every byte outside a well-formed sequence becomes U+FFFD, so that a
/// label shows where its bad bytes are.
[[nodiscard]] std::u32string decode_utf8(std::string_view text);

/// Makes text with other people's names safe for a terminal and for the log of a CI. Control
/// characters, those that turn the direction of text, and bytes that are not UTF-8 become \x1b or
/// \u202e. So does the first character of a command that a CI reads from a log: "::" at the start
/// of a line, "##" anywhere. Line ends stay.
[[nodiscard]] std::string for_terminal(std::string_view text);

/// Whether all bytes are in well-formed sequences.
[[nodiscard]] bool is_utf8(std::string_view text);

}  // namespace oiler
