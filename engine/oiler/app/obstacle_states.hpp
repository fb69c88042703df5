// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "oiler/capture/frame_record.hpp"
#include "oiler/game/game.hpp"

namespace oiler {

/// The obstacles of a game after its last step, in the order of their slots; absent above 1000.
[[nodiscard]] std::optional<std::vector<ObstacleState>> obstacle_states_of(const AnyGame& game);

}  // namespace oiler
