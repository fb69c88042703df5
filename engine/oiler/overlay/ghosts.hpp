// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/picture/picture.hpp"
#include "oiler/whatif/moment.hpp"

namespace oiler {

/// Adds a ring at the true position of each body, relative to its disc in the picture and as large.
/// Labels the five largest errors if they are visible. Errors are drawn `factor` times as long.
void add_ghosts(Picture& picture, const std::vector<Ghost>& ghosts, double factor);

}  // namespace oiler
