// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "oiler/capture/frame_record.hpp"
#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// Describes how the bodies of a frame differ: the body and coordinate with the largest distance in
/// units in the last place (ulp) of `precision`, "float" or "double". Names bodies that were added,
/// removed or swapped. Empty if neither a bit nor the order differs.
[[nodiscard]] std::string describe_state_change(const std::vector<BodyState>& golden,
                                                const std::vector<BodyState>& actual,
                                                std::string_view precision);

/// Describes how the obstacles of a frame differ: the first that does, and the first of its
/// numbers. Empty if none does.
[[nodiscard]] std::string describe_obstacle_change(const std::vector<ObstacleState>& golden,
                                                   const std::vector<ObstacleState>& actual);

/// Describes how two pictures differ, for example "3 discs moved by at most 0.4 px; 1 line: width 2
/// → 1.9". Distances are in pixels of a frame of that size. Elements are matched by their keys;
/// those without a key by their order. Empty if the pictures are equal.
[[nodiscard]] std::string describe_picture_change(const Picture& golden, const Picture& actual,
                                                  Size size);

}  // namespace oiler
