// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/stability/preflight.hpp"

namespace oiler::test {

/// Steps bodies as a world does: a divergence is thrown with its likely cause.
inline void explained_step(Bodies& bodies, const Method& method, const Steps& steps) {
    if (const auto at = bodies.try_step(method, steps))
        fail_diverged(bodies, *at, method, steps, [](std::size_t row) { return row; });
}

}  // namespace oiler::test
