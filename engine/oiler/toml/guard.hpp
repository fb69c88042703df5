// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace oiler {

/// Largest size of a TOML file, in bytes.
inline constexpr std::size_t most_toml_bytes = std::size_t{64} * 1024;

/// Refuses texts that may crash the TOML parser: more than `most_toml_bytes` bytes, bytes other
/// than ASCII text, keys of more than 32 parts, brackets nested deeper than 64. Throws Error{usage}
/// with the line.
void guard_toml(std::string_view text, std::string_view file);

}  // namespace oiler
