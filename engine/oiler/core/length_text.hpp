// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace oiler {

/// A length of 0 or more as a user reads it: "30 nm", "2 mm", "7.5 cm", "3.1 m".
[[nodiscard]] std::string length_text(double metres);

}  // namespace oiler
