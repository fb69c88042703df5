// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "trap/motion.hpp"

namespace oiler::trap {

struct CoupledBody {
    Real mass = 1;            ///< kg
    Real drag = 0;            ///< N·s/m
    Real quadratic_drag = 0;  ///< N·s²/m²
    Point x{};                ///< m, at the start
    Point v{};                ///< m/s, at the start
};

struct CoupledSpring {
    std::size_t body = 0;
    std::optional<std::size_t> to{};  ///< if absent, `anchor` holds
    Point anchor{};                   ///< m
    Real stiffness = 0;               ///< N/m
    Real damping = 0;                 ///< N·s/m
    Real rest_length = 0;             ///< m
};

struct Attractor {
    Point centre{};  ///< m
    Real gm = 0;     ///< m³/s²
};

/// Bodies with the forces on them and between them.
struct System {
    std::vector<CoupledBody> bodies{};
    std::vector<CoupledSpring> springs{};
    std::vector<Attractor> attractors{};
    Point gravity{};  ///< m/s²

    [[nodiscard]] bool is_linear() const;
    /// At most the shortest period of the springs without damping, s.
    [[nodiscard]] Real shortest_spring_period() const;
};

}  // namespace oiler::trap
