// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace oiler {

enum class Precision {
    single,
    double_,
    extended,  ///< long double: to measure the others against, not to play in
};

/// "float" or "double", as the options and files say it, or "long double".
[[nodiscard]] std::string_view name_of(Precision precision);

}  // namespace oiler
