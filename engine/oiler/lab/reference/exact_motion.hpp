// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "oiler/sim/bodies.hpp"

namespace oiler::lab {

/// A body's position and velocity t seconds after the start.
using ExactMotion = std::function<State<long double, 3>(long double t)>;

/// The closed form of each body's motion from its present state. It shares no code with the
/// methods. Returns none if any body has none: with links, springs with rest lengths, quadratic
/// drag, an attractor beside other forces, or an orbit that is not closed.
[[nodiscard]] std::optional<std::vector<ExactMotion>> exact_motions(const Bodies& bodies);

}  // namespace oiler::lab
