// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/core/json.hpp"

namespace oiler {

// Texts and data in HTML and XML.

/// Escapes a text for an element or for an attribute between double quotes.
[[nodiscard]] std::string escaped(std::string_view text);

/// Writes JSON that cannot end the script element around it.
[[nodiscard]] std::string for_script(const Json& json);

/// Returns the data URL of a PNG file.
[[nodiscard]] std::string data_url_of(const std::vector<std::byte>& png);

/// Replaces each name in the page by its part in one pass, so that names inside of parts stay.
[[nodiscard]] std::string fill_in(std::string_view page,
                                  const std::map<std::string, std::string>& parts);

}  // namespace oiler
