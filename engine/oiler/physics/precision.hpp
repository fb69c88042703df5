// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace oiler {

enum class Precision {
    single,
    double_,
    extended,  ///< long double: for references, not for games
};

/// "float" or "double", as in options and files, or "long double".
[[nodiscard]] std::string_view name_of(Precision precision);
/// The precision of a game that has such a name; empty if there is none.
[[nodiscard]] std::optional<Precision> find_precision(std::string_view name);

}  // namespace oiler
