// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "oiler/core/timing.hpp"
#include "oiler/physics/steps.hpp"
#include "oiler/scene/scene.hpp"

namespace oiler {
class Bodies;
}

namespace oiler::lab {

/// A number that bodies have: stored in a column, or once if all bodies agree.
struct LedgerColumn {
    std::string of;  ///< "position", "velocity", "mass", "contact", a force's name or "handle"
    std::size_t index = 0;    ///< index among forces of one kind
    std::string number;       ///< "x", "stiffness", "anchor.y"
    bool shared = false;      ///< stored once
    std::size_t bytes = 0;    ///< per body; 0 if shared
    std::int64_t bodies = 0;  ///< bodies with a nonzero number in this group
};

/// The cost of one force, of all links, or of moving: the rest of the step without forces and
/// links.
struct LedgerPass {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    std::string name;
    /// Per body and step. For a force, the cost that it adds to the others, at least 0.
    double ns = unknown;
    double saves_ns = unknown;          ///< may be negative; NaN for moving
    double saves_percent = unknown;     ///< percent of the whole step in the same round, the median
    double spread_percent = unknown;    ///< half the interquartile range over the rounds
    double changes_position = unknown;  ///< m, the largest at any sample; NaN for moving
    std::optional<std::string> diverged{};  ///< how the scene diverges without it

    [[nodiscard]] bool is_within_spread() const {
        return std::abs(saves_percent) <= spread_percent;
    }
};

/// The costs of a scene, memory and time, and the effect of each of its parts.
struct Ledger {
    std::int64_t bodies = 0;
    std::int64_t links = 0;
    double bytes_per_link = 0;  ///< the mean
    std::vector<LedgerColumn> columns;
    std::vector<std::string> absent;         ///< forces that are neither stored nor evaluated
    std::int64_t steps = 0;                  ///< number of steps compared with the ablations
    std::int64_t samples = 0;                ///< number of comparisons
    std::int64_t timed_steps = 0;            ///< in one call
    std::int64_t rounds = 0;                 ///< number of times that each scene was timed
    double ns = LedgerPass::unknown;         ///< per body and step, the whole step, the median
    double spread_ns = LedgerPass::unknown;  ///< half the interquartile range over the rounds
    std::vector<LedgerPass> passes;
    std::vector<std::string> flags;         ///< parts without effect, and the remedy
    std::optional<std::string> diverged{};  ///< how the scene itself diverges; then no times

    /// Includes the share of the links, but not scratch memory of steps or padding.
    [[nodiscard]] double bytes_per_body() const;
};

/// Called with the fraction that is done, from 0 to 1.
using LedgerProgress = std::function<void(double)>;

/// Takes the steps on this thread and returns their time, s; NaN if they diverge.
using StepTimer = std::function<double(Bodies&, const Method&, const Steps&)>;

/// Returns the computing time without the time in which other programs run.
[[nodiscard]] double cpu_seconds(Bodies& bodies, const Method& method, const Steps& steps);

/// Makes the scene's world and its ablations: one world without each part. Steps them side by side,
/// at most `steps` times and for about 10 s, then times them for about 3 s. `steps` is at least 2,
/// because the first step prepares data and is not timed. Throws Error{usage} if the method cannot
/// step the scene.
[[nodiscard]] Ledger ledger(
    const Scene& scene, std::int64_t steps, const LedgerProgress& progress = [](double) {},
    const StepTimer& timer = cpu_seconds);

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
