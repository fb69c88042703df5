// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "oiler/sim/bodies.hpp"

namespace oiler::lab {

/// Where a body is and how fast it goes, so many seconds after the start.
using ExactMotion = std::function<State<long double, 3>(long double t)>;

/// The closed form of each body's motion from its present state, by the textbook and not by what
/// steps it; none where any body has none: where bodies are linked, springs have rest lengths, drag
/// is quadratic, or an attractor is not alone or not circled.
[[nodiscard]] std::optional<std::vector<ExactMotion>> exact_motions(const Bodies& bodies);

}  // namespace oiler::lab
