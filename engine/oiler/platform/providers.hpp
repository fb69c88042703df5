// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "oiler/platform/surface.hpp"

namespace oiler {

/// Both throw Error{no_display} with the Debian packages to install.
[[nodiscard]] std::unique_ptr<Surface> open_osmesa();
[[nodiscard]] std::unique_ptr<Surface> open_egl();

}  // namespace oiler
