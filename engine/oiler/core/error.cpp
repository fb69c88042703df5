// SPDX-License-Identifier: MIT
#include "oiler/core/error.hpp"

#include <system_error>

namespace oiler {

std::string system_reason(int error_number) {
    return std::generic_category().message(error_number);
}

}  // namespace oiler
