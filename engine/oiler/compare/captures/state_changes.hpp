// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "oiler/capture/frame_record.hpp"

namespace oiler {

/// Describes how the bodies of a frame differ: the body and coordinate with the largest distance in
/// units in the last place (ulp) of `precision`, "float" or "double". Names bodies that were added,
/// removed or swapped. Empty if neither a bit nor the order differs.
[[nodiscard]] std::string describe_state_change(const std::vector<BodyState>& golden,
                                                const std::vector<BodyState>& actual,
                                                std::string_view precision);

}  // namespace oiler
