// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oiler {

/// Compresses a text as one member of a gzip file. Members may follow each other in one file; gzip
/// -d and zcat join their texts. The same text always gives the same bytes.
[[nodiscard]] std::vector<std::byte> gzip(std::string_view text);

/// Returns the texts of all members. Throws Error{usage} for damaged bytes and for a member of more
/// than 256 MiB; `file` is named in the message.
[[nodiscard]] std::string gunzip(std::span<const std::byte> bytes, std::string_view file);

}  // namespace oiler
