// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "oiler/sim/bodies.hpp"

namespace oiler {

/// A body, or two linked bodies, whose springs and dampers are unstable with a method at a rate.
struct Risk {
    std::size_t row;
    std::optional<std::size_t> linked;  ///< the other row
    double omega_dt;                    ///< ω·dt; for linked bodies an upper bound
    double damping_dt;                  ///< c·dt, c = 2ζω
};

/// Finds the bodies whose springs and dampers are outside the method's region of stability, the
/// worst first: unstable at the step, or at one of four shorter steps. It changes no state.
[[nodiscard]] std::vector<Risk> preflight(const Bodies& bodies, const Method& method,
                                          const Steps& steps);

/// Describes a risk: "spring of body 3: ω·dt = 2.4, semi_implicit_euler needs < 2: rate ≥ 74 Hz, or
/// implicit_euler". Finding the limit takes some tens of milliseconds.
[[nodiscard]] std::string describe(const Risk& risk, const Method& method, const Steps& steps,
                                   const NameOfRow& name);

/// Throws Error{diverged} with step, body, field and the likely cause.
[[noreturn]] void fail_diverged(const Bodies& bodies, const Divergence& at, const Method& method,
                                const Steps& steps, const NameOfRow& name);

}  // namespace oiler
