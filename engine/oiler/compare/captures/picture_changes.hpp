// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// Describes how two pictures differ, for example "3 discs moved by at most 0.4 px; 1 line: width 2
/// → 1.9". Distances are in pixels of a frame of that size. Elements are matched by their keys;
/// those without a key by their order. Empty if the pictures are equal.
[[nodiscard]] std::string describe_picture_change(const Picture& golden, const Picture& actual,
                                                  Size size);

}  // namespace oiler
