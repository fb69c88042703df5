// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/core/json.hpp"

namespace oiler::cli {

// How texts and numbers get into HTML and XML.

/// For contents, and for values between double quotes.
[[nodiscard]] std::string escaped(std::string_view text);

/// For a script: no end of it can hide in a text.
[[nodiscard]] std::string for_script(const Json& json);

/// A PNG file as an address.
[[nodiscard]] std::string address_of(const std::vector<std::byte>& png);

/// The template with each of the names replaced, in one pass: what is put in is not looked at
/// again.
[[nodiscard]] std::string filled(std::string_view page,
                                 const std::map<std::string, std::string>& parts);

}  // namespace oiler::cli
