// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "oiler/sim/bodies.hpp"

namespace oiler {

/// A body, or two that are linked, whose springs and dampers a method cannot follow at a rate.
struct Risk {
    std::size_t row;
    std::optional<std::size_t> linked;  ///< the other row
    double omega_dt;                    ///< ω·dt; of linked bodies at most so much
    double damping_dt;                  ///< c·dt, c = 2ζω
};

/// Each body of which springs and dampers are outside of the method's region of stability, the
/// worst first: unstable at the step, or at one of four shorter ones. It changes nothing.
[[nodiscard]] std::vector<Risk> preflight(const Bodies& bodies, const Method& method,
                                          const Steps& steps);

/// "spring of body 3: ω·dt = 2.4, semi_implicit_euler needs < 2: rate ≥ 74 Hz, or implicit_euler"
/// Finding the limit takes some tens of milliseconds.
[[nodiscard]] std::string describe(const Risk& risk, const Method& method, const Steps& steps,
                                   const NameOfRow& name);

/// Throws Error{diverged} that names step, body, field and the likely cause.
[[noreturn]] void fail_diverged(const Bodies& bodies, const Divergence& at, const Method& method,
                                const Steps& steps, const NameOfRow& name);

}  // namespace oiler
