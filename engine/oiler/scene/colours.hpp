// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// Reads "blue" or "#0072b2"; empty for any other text.
[[nodiscard]] std::optional<Colour> find_colour(std::string_view text);

/// The names of the palette.
[[nodiscard]] std::vector<std::string_view> colour_names();

}  // namespace oiler
