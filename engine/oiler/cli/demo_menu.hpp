// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "oiler/cli/startable.hpp"
#include "oiler/picture/bitmap.hpp"

namespace oiler::cli {

/// The pictures of demos and scenes, empty where there is none that can be read.
[[nodiscard]] std::vector<std::shared_ptr<const Bitmap>> load_pictures(
    const std::vector<Startable>& all);

/// Shows demos and scenes in a window until the user chooses one, with the mouse or the keys, and
/// returns its index; empty if the user left. `pictures` are those of `all`. `remark` is a line at
/// the bottom, `selected` the index that is marked at first. Throws Error{no_display}.
[[nodiscard]] std::optional<std::size_t> choose_in_window(
    const std::vector<Startable>& all, const std::vector<std::shared_ptr<const Bitmap>>& pictures,
    std::size_t selected, const std::string& remark);

}  // namespace oiler::cli
