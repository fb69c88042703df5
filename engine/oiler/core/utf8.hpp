// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace oiler {

/// The code points of UTF-8 text (RFC 3629); every byte that is not part of a well-formed sequence
/// becomes U+FFFD, so that a label with foreign bytes shows where they are.
[[nodiscard]] std::u32string decode_utf8(std::string_view text);

}  // namespace oiler
