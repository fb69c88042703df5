// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace oiler {

/// "; did you mean `stiffness`?" of the word that `word` is a misspelling of, else empty.
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       std::span<const std::string_view> words);

}  // namespace oiler
