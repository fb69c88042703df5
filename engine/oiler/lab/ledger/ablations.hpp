// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/lab/ledger/ledger.hpp"

namespace oiler::lab {

/// A scene without one of its parts.
struct Ablation {
    std::string words;  ///< the part, as in the scene file
    /// `words` of a larger ablation, which leaves out this part and others; empty if none does.
    std::string part_of;
    /// The name in the ledger of an ablation that is timed: the force's, "hang", "links",
    /// "obstacles" or "moving". Empty for others.
    std::string pass;
    Scene scene;
};

/// All ablations of a scene whose bodies have `forces`. Springs, their dampers and attractors are
/// also left out one by one, unless there are too many: see most_parts.
[[nodiscard]] std::vector<Ablation> ablations(const Scene& scene,
                                              const std::vector<std::string_view>& forces,
                                              bool linked);

/// The names of a force for people.
struct ForceDescription {
    std::string_view name;                    ///< the force's own
    std::string_view plural;                  ///< "coil springs"
    std::vector<std::string_view> numbers{};  ///< scene keys of its fields
    std::string words{};                      ///< all forces of this kind, as in the scene file
    std::function<void(Scene&)> leave_out{};
};

/// The description of every force, in the order of the list of forces.
[[nodiscard]] const std::vector<ForceDescription>& force_descriptions();

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

/// The fraction of the progress that comes before timing.
inline constexpr double comparing_share = 0.6;

}  // namespace oiler::lab
