// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace oiler {

/// The version of Oiler that the library was built as, "0.1.0".
[[nodiscard]] std::string_view version();

/// The compiler that the library was built by, "g++ 12.2.0".
[[nodiscard]] std::string compiler();

}  // namespace oiler
