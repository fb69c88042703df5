// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace oiler {

/// The version of the library, for example "0.1.0".
[[nodiscard]] std::string_view version();

/// The compiler that built the library, for example "g++ 12.2.0".
[[nodiscard]] std::string compiler();

}  // namespace oiler
