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

// What a ledger is put together from.

/// A scene without one of the things that it has.
struct Leaving {
    std::string words;    ///< what is left out, as the scene file has it
    std::string part_of;  ///< the words of a larger thing that is left out, too; empty for a pass
    std::string pass;     ///< the force's name, "links" or "moving"; empty for part of one
    Scene scene;
};

/// Every way to leave something out of a scene whose bodies have `forces`. Springs and attractors
/// are also left out one by one, and springs' dampers, where they are not too many.
[[nodiscard]] std::vector<Leaving> leavings(const Scene& scene,
                                            const std::vector<std::string_view>& forces,
                                            bool linked);

/// How a force is called where people read of it.
struct ForceWords {
    std::string_view name;                  ///< of the force
    std::string_view plural;                ///< "coil springs"
    std::vector<std::string_view> numbers;  ///< of its fields, by the keys of the scene file
    std::string_view words;                 ///< all of them in the scene file
    std::function<void(Scene&)> leave_out;
};

/// Of every force, in the order of the list of forces.
[[nodiscard]] const std::vector<ForceWords>& force_words();

/// Enters what the bodies store and what they do not; returns the names of the forces that they
/// have.
std::vector<std::string_view> enter_columns(Ledger& ledger, const Bodies& bodies);

/// How the scene without something fared beside the whole.
struct Fared {
    double change = 0;                      ///< m, the largest at any look
    std::optional<std::string> diverged{};  ///< how
};

struct Comparison {
    std::int64_t steps = 0;
    std::int64_t looks = 0;
    double seconds_per_step = 0;            ///< of all worlds together
    Vec3 moved{};                           ///< m, of any body from its start, at any look
    std::optional<std::string> diverged{};  ///< how, where the whole scene did
    std::vector<Fared> without;             ///< each of the leavings
};

/// Steps all of them beside the whole scene, at most `steps` times.
[[nodiscard]] Comparison compare(const Scene& scene, const std::vector<Leaving>& leavings,
                                 std::int64_t steps, const LedgerProgress& progress);

/// Seconds that each scene takes for `steps` steps, after one in which it prepares what all others
/// share: the least of several rounds, in which the scenes take turns, so that whatever else the
/// machine is doing meets all of them alike.
[[nodiscard]] std::vector<double> race(const std::vector<const Scene*>& scenes, std::int64_t steps,
                                       const LedgerProgress& progress);

}  // namespace oiler::lab
