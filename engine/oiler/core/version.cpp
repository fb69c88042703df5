// SPDX-License-Identifier: MIT
#include "oiler/core/version.hpp"

#include <fmt/core.h>

namespace oiler {

std::string_view version() { return OILER_VERSION; }

std::string compiler() {
#ifdef __clang__
    return fmt::format("clang++ {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
    return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

}  // namespace oiler
