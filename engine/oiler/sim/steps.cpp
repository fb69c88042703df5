// SPDX-License-Identifier: MIT
#include "oiler/sim/steps.hpp"

#include <fmt/core.h>

#include "oiler/math/vec.hpp"

namespace oiler {

std::string describe(const Divergence& at, const Method& method, const Rate& rate, bool linked,
                     const NameOfRow& name) {
    const std::string when =
        fmt::format("diverged at step {} (t = {} s)", at.tick, rate.time(at.tick));
    if (at.of == Divergence::Of::solution) {
        const std::string whose =
            linked ? "the linked bodies" : fmt::format("body {}", name(at.row));
        return fmt::format("{}: {} found no solution of the equations of {}", when, method.name,
                           whose);
    }
    return fmt::format("{}: {} {} of body {} is no longer finite", when,
                       at.of == Divergence::Of::velocity ? "velocity" : "position",
                       axis_names[static_cast<std::size_t>(at.axis)], name(at.row));
}

}  // namespace oiler
