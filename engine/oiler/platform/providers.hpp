// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "oiler/platform/surface.hpp"

namespace oiler {

/// Each throws Error{no_display} with the Debian packages that cure it.
[[nodiscard]] std::unique_ptr<Surface> open_osmesa();
[[nodiscard]] std::unique_ptr<Surface> open_egl();

}  // namespace oiler
