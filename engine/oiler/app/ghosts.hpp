// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "oiler/app/moment.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// A body where a run has it, and where the reference has it at the same time, m.
struct Ghost {
    Entity body{};
    Vec3 at{};
    Vec3 truth{};
};

inline constexpr std::size_t most_ghosts = 100;

/// The bodies of a run that the reference has, too, unless they were teleported in one of the two.
/// Of more than `most_ghosts` bodies, those that are furthest off.
[[nodiscard]] std::vector<Ghost> ghosts_of(const Moment& run, const Moment& reference);

/// Adds a ring where each body truly is, relative to its disc in the picture if that has one, and
/// as large; and the distances of the five that are furthest off, if they can be seen. With a
/// factor, the distances are drawn so many times as long.
void add_ghosts(Picture& picture, const std::vector<Ghost>& ghosts, double factor);

}  // namespace oiler
