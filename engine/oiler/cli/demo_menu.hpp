// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "oiler/cli/startable.hpp"

namespace oiler::cli {

/// Lists demos and scenes in a window until the user chooses one, with the mouse or the keys, and
/// returns its index; empty if the user left. `remark` is a line at the bottom, `selected` the
/// index that is marked at first. Throws Error{no_display}.
[[nodiscard]] std::optional<std::size_t> choose_in_window(const std::vector<Startable>& all,
                                                          std::size_t selected,
                                                          const std::string& remark);

}  // namespace oiler::cli
