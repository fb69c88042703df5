// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// "blue" or "#0072b2"; nothing for any other text.
[[nodiscard]] std::optional<Colour> find_colour(std::string_view text);

/// The colours that have a name: those of the palette.
[[nodiscard]] std::vector<std::string_view> colour_words();

}  // namespace oiler
