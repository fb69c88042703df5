// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/lab/ledger/ledger.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::lab {

// The parts of a ledger.

/// A scene without one of its parts.
struct Ablation {
    std::string words;    ///< the part, as in the scene file
    std::string part_of;  ///< `words` of the ablation that contains this one; empty for a pass
    std::string pass;  ///< the force's name, "hang", "links", "planes" or "moving"; empty for part
                       ///< of a pass
    Scene scene;
};

/// All ablations of a scene whose bodies have `forces`. Springs, their dampers and attractors are
/// also left out one by one, unless there are too many: see most_parts.
[[nodiscard]] std::vector<Ablation> ablations(const Scene& scene,
                                              const std::vector<std::string_view>& forces,
                                              bool linked);

/// The names of a force for people.
struct ForceDescription {
    std::string_view name;                  ///< the force's own
    std::string_view plural;                ///< "coil springs"
    std::vector<std::string_view> numbers;  ///< scene keys of its fields
    std::string_view words;                 ///< all forces of this kind, as in the scene file
    std::function<void(Scene&)> leave_out;
};

/// The description of every force, in the order of the list of forces.
[[nodiscard]] const std::vector<ForceDescription>& force_descriptions();

/// Enters the stored columns and the absent forces. Returns the names of the bodies' forces.
std::vector<std::string_view> enter_columns(Ledger& ledger, const Bodies& bodies);

/// The difference between an ablation and the whole scene.
struct AblationResult {
    double change = 0;                      ///< m, the largest at any sample
    std::optional<std::string> diverged{};  ///< how
};

struct Comparison {
    std::int64_t steps = 0;
    std::int64_t samples = 0;
    Vec3 moved{};  ///< m, largest distance of any body from its start, per axis
    std::optional<std::string> diverged{};  ///< how the whole scene diverged
    std::vector<AblationResult> without;    ///< the result of each ablation
};

/// Steps the whole scene and all ablations side by side, at most `steps` times.
[[nodiscard]] Comparison compare(const Scene& scene, const std::vector<Ablation>& ablations,
                                 std::int64_t steps, const LedgerProgress& progress);

/// A median and half the interquartile range. NaN of no values.
struct Median {
    double value = LedgerPass::unknown;
    double spread = LedgerPass::unknown;
};

/// The median of the finite values.
[[nodiscard]] Median median_of(std::vector<double> values);

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

/// The fraction of the progress that comes before timing.
inline constexpr double comparing_share = 0.6;

}  // namespace oiler::lab
