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

/// Whether all bytes are in well-formed sequences.
[[nodiscard]] bool is_utf8(std::string_view text);

}  // namespace oiler
