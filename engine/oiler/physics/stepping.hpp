// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "oiler/physics/methods/methods.hpp"
#include "oiler/physics/precision.hpp"
#include "oiler/physics/rate.hpp"

namespace oiler {

/// The setting of a run (method, rate, precision, damping), in games, scenes, options, manifests
/// and advice.
struct Stepping {
    const Method* method = &find_method("semi_implicit_euler");
    Rate rate{100};
    Precision precision = Precision::double_;
    std::optional<Damping> damping{};  ///< the method's default if absent

    friend bool operator==(const Stepping&, const Stepping&) = default;
};

}  // namespace oiler
