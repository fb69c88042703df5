// SPDX-License-Identifier: MIT
#include "oiler/physics/steps.hpp"

#include <fmt/core.h>

#include <tuple>

#include "oiler/math/vec.hpp"

namespace oiler {

void keep_earlier(std::optional<Divergence>& first, const std::optional<Divergence>& other) {
    if (!other) return;
    const auto order = [](const Divergence& d) {
        return std::tuple(d.tick, d.row, d.of == Divergence::Of::velocity, d.axis);
    };
    if (!first || order(*other) < order(*first)) first = other;
}

std::string describe(const Divergence& at, const Method& method, const Rate& rate, bool linked,
                     const NameOfRow& name) {
    const std::string when =
        fmt::format("diverged at step {} (t = {:.6g} s)", at.tick, rate.time(at.tick));
    if (at.of == Divergence::Of::solution) {
        const std::string whose =
            linked ? "the linked bodies" : fmt::format("body {}", name(at.row));
        return fmt::format("{}: {} found no solution of the equations of {}", when, method.name,
                           whose);
    }
    if (at.of == Divergence::Of::impacts)
        return fmt::format("{}: body {} meets planes too often to follow it", when, name(at.row));
    if (at.of == Divergence::Of::drawing)
        return fmt::format("{}: body {} is farther away than a picture reaches, 3.4e+38 m", when,
                           name(at.row));
    return fmt::format("{}: {} {} of body {} is no longer finite", when,
                       at.of == Divergence::Of::velocity ? "velocity" : "position",
                       axis_names[static_cast<std::size_t>(at.axis)], name(at.row));
}

}  // namespace oiler
