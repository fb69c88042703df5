// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace oiler {

/// The name of a type as the compiler writes it.
template <class T>
[[nodiscard]] constexpr std::string_view type_name() {
    const std::string_view text = __PRETTY_FUNCTION__;
    const std::size_t begin = text.find("T = ") + 4;
    return text.substr(begin, text.find_first_of(";]", begin) - begin);
}

}  // namespace oiler
