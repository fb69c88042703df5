// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "oiler/scene/scene.hpp"

namespace oiler {

/// The text of a scene file with another choice in its table `scene`; all else, comments and
/// spacing too, stays as it was, and so does what says the same already. Throws Error{usage} where
/// the text is no scene, or would be none with that choice: not every method takes every force.
[[nodiscard]] std::string apply(std::string_view text, std::string_view file,
                                const Stepping& stepping);

}  // namespace oiler
