// SPDX-License-Identifier: MIT
#include "oiler/core/error.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "oiler/core/require.hpp"

namespace oiler {

Exit exit_of_open(int error_number) {
    constexpr std::array wrong_paths{ENOENT, ENOTDIR, EISDIR, ENXIO, ELOOP, ENAMETOOLONG};
    return std::ranges::find(wrong_paths, error_number) == wrong_paths.end() ? Exit::io
                                                                             : Exit::usage;
}

std::string system_reason(int error_number) {
    return std::generic_category().message(error_number);
}

void throw_mistake(const char* what) { throw Mistake(what); }

}  // namespace oiler
