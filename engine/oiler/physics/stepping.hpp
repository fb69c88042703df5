// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "oiler/physics/methods/methods.hpp"
#include "oiler/physics/precision.hpp"
#include "oiler/physics/rate.hpp"

namespace oiler {

/// How a run is stepped, wherever it is kept: in games, scenes, options, manifests and advice.
struct Stepping {
    const Method* method = &find_method("semi_implicit_euler");
    Rate rate{100};
    Precision precision = Precision::double_;
    std::optional<Damping> damping{};  ///< the method's own if absent

    friend bool operator==(const Stepping&, const Stepping&) = default;
};

}  // namespace oiler
