// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace oiler {

/// Returns "; did you mean `stiffness`?" if `word` is close to one of `words`, else empty.
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       std::span<const std::string_view> words);

}  // namespace oiler
