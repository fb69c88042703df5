// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/core/json.hpp"
#include "oiler/lab/rates.hpp"

namespace oiler::lab {

[[nodiscard]] Json json_of(const Rates& rates);

}  // namespace oiler::lab
