// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/core/json.hpp"
#include "oiler/lab/advice/advise.hpp"

namespace oiler::lab {

[[nodiscard]] Json json_of(const Advice& advice, const Scene& scene, const Reference& reference,
                           const Requirements& requirements);

}  // namespace oiler::lab
