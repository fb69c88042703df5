// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "oiler/scene/scene.hpp"

namespace oiler {

/// Returns the text of a scene file with the rate, method, precision and damping of `stepping`. All
/// other bytes stay, comments and spacing included, and so do values that already agree. Throws
/// Error{usage} if the text is not a valid scene, or if its forces do not suit the method.
[[nodiscard]] std::string apply(std::string_view text, std::string_view file,
                                const Stepping& stepping);

}  // namespace oiler
