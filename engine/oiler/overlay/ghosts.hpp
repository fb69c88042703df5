// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/picture/picture.hpp"
#include "oiler/whatif/moment.hpp"

namespace oiler {

/// Adds a ring where each body truly is, relative to its disc in the picture if that has one, and
/// as large; and the distances of the five that are furthest off, if they can be seen. With a
/// factor, the distances are drawn so many times as long.
void add_ghosts(Picture& picture, const std::vector<Ghost>& ghosts, double factor);

}  // namespace oiler
