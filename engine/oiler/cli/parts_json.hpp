// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "oiler/lab/advise.hpp"
#include "oiler/lab/rates.hpp"

namespace oiler {

// What several commands write of the same thing.

[[nodiscard]] nlohmann::ordered_json rates_json(const Rates& rates);

/// The scene's own method, and those that people would think of as far as they can step it.
[[nodiscard]] std::vector<const Method*> usual_methods(const Scene& scene);

}  // namespace oiler
