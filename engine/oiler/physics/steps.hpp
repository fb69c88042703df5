// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "oiler/physics/methods/methods.hpp"
#include "oiler/physics/rate.hpp"

namespace oiler {

/// The steps of a call: `count` steps from tick `first` on.
struct Steps {
    Rate rate;
    std::int64_t first = 0;
    std::int64_t count = 1;
    /// The method's default if absent.
    std::optional<Damping> damping{};
};

/// The place where a run was no longer finite, or an implicit step found no solution.
struct Divergence {
    enum class Of {
        position,
        velocity,
        solution,  ///< of an implicit method
        impacts,   ///< more in a step than can be followed
        drawing    ///< farther than a picture reaches
    };

    std::int64_t tick;  ///< the first tick whose state is not finite
    std::size_t row;
    int axis;
    Of of;
};

/// Keeps the earlier divergence: by tick, row, position before velocity, then axis.
void keep_earlier(std::optional<Divergence>& first, const std::optional<Divergence>& other);

/// Returns what messages call the body in a row, after "body ": "3", or "'bob'" if it has a name.
using NameOfRow = std::function<std::string(std::size_t)>;

/// "diverged at step 41 (t = 0.41 s): velocity x of body 0 is no longer finite"
[[nodiscard]] std::string describe(const Divergence& at, const Method& method, const Rate& rate,
                                   bool linked, const NameOfRow& name);

}  // namespace oiler
