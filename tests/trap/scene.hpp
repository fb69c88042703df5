// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/scene/scene.hpp"
#include "trap/advice.hpp"
#include "trap/truth.hpp"

namespace oiler::trap {

/// A random scene with its true motion, and a question about it.
struct Trap {
    std::string kind{};
    std::string text{};  ///< the scene file
    Scene scene{};
    std::unique_ptr<Truth> truth{};
    double extent = 0;  ///< m, the largest distance of a body from its start
    Question question{};
};

/// The same trap for the same seed. `plain` asks without --at-steps and --display.
[[nodiscard]] Trap make_trap(std::uint64_t seed, bool plain);

}  // namespace oiler::trap
