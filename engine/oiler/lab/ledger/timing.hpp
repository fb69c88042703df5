// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/core/median.hpp"
#include "oiler/lab/ledger/ledger.hpp"

namespace oiler::lab {

struct Timing {
    std::int64_t rounds = 0;
    std::int64_t steps_per_turn = 0;  ///< timed, in one call
    Median seconds{};                 ///< of a turn of the first scene
    std::vector<Median> ratios{};     ///< of the others' times to the first's in the same round
};

/// Times the scenes in many short rounds, within the first `steps` steps of the first scene. In
/// each round every scene takes a turn; the scene that begins changes. Ratios within a round do not
/// change if other load slows the whole machine. All turns of a round begin with a state of the
/// first scene's run: in a run that stays at rest, implicit methods take fewer iterations. In each
/// turn the first step prepares data and is not timed.
[[nodiscard]] Timing race(const std::vector<const Scene*>& scenes, std::int64_t steps,
                          const StepTimer& timer, const LedgerProgress& progress);

}  // namespace oiler::lab
