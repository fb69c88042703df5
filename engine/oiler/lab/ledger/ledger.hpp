// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "oiler/scene/scene.hpp"

namespace oiler::lab {

/// A number of each body and where it is: in a column, or stored once because all bodies agree.
struct LedgerColumn {
    std::string of;           ///< "position", "velocity", "mass", a force or "handle"
    std::size_t index = 0;    ///< of several forces of a kind
    std::string number;       ///< "x", "stiffness", "anchor.y"
    bool shared = false;      ///< stored once
    std::size_t bytes = 0;    ///< of each body; 0 where shared
    std::int64_t bodies = 0;  ///< for which any number of the same thing is other than 0
};

/// One force, all links, or moving: what is left of the step where nothing acts.
struct LedgerPass {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    std::string name;
    double ns = unknown;  ///< per body and step; of a force what it adds to the others, from 0
    double saves_ns = unknown;              ///< the same as measured; NaN for moving
    double saves_percent = unknown;         ///< of the whole step
    double changes_position = unknown;      ///< m, see Ledger::steps; NaN for moving
    std::optional<std::string> diverged{};  ///< how, where the scene does without it
};

/// What a scene pays for: memory, time, and what each part of it is good for.
struct Ledger {
    std::int64_t bodies = 0;
    std::int64_t links = 0;
    std::size_t bytes_per_link = 0;
    std::vector<LedgerColumn> columns;
    std::vector<std::string> absent;  ///< what is neither stored nor evaluated
    std::int64_t steps = 0;        ///< after which the scene is held against itself without a part
    std::int64_t looks = 0;        ///< how often on the way
    std::int64_t timed_steps = 0;  ///< the first ones, again and again
    double ns = LedgerPass::unknown;        ///< per body and step, of the whole step
    double noise_ns = LedgerPass::unknown;  ///< by which the whole step differs from itself
    std::vector<LedgerPass> passes;
    std::vector<std::string> flags;         ///< what has no effect, and what to do about it
    std::optional<std::string> diverged{};  ///< how, where the scene itself does; nothing is timed

    /// With the share of the links, without what steps keep for themselves and without padding.
    [[nodiscard]] double bytes_per_body() const;
};

/// Called with the share that is done, from 0 to 1.
using LedgerProgress = std::function<void(double)>;

/// Makes the scene's world, and one without each thing that it has; steps them side by side at most
/// `steps` times, as far as about 10 s go; then times them for about 3 s. `steps` is at least 2:
/// the first prepares what the others are timed with. Throws Error{usage} where the method cannot
/// step the scene.
[[nodiscard]] Ledger ledger(
    const Scene& scene, std::int64_t steps, const LedgerProgress& progress = [](double) {});

}  // namespace oiler::lab
