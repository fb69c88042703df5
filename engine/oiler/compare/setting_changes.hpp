// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "oiler/capture/manifest.hpp"
#include "oiler/compare/comparison.hpp"

namespace oiler {

/// The settings in which two captures differ, besides the renderer.
[[nodiscard]] std::vector<SettingChange> setting_changes(const Manifest& golden,
                                                         const Manifest& actual);

/// The first lines in which two scene files differ besides comments; empty if there are none.
[[nodiscard]] std::string scene_change(const std::string& golden, const std::string& actual);

}  // namespace oiler
