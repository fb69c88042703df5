// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "bench/measure.hpp"
#include "bench/nets.hpp"

namespace oiler::bench {

/// Another library that does the same work.
struct PeerWork {
    Work step;                        ///< of all bodies, `times` times
    std::function<double()> measure;  ///< a number that changes with the work
};

/// s
inline constexpr double peer_dt = 1.0 / 60;
/// N/m, of oscillators of 1 kg
inline constexpr double peer_stiffness = 0.01;

// Bodies that fall, each on its own, under gravity of −9.81 m/s², collisions off.
[[nodiscard]] PeerWork bullet_fall(std::size_t bodies);
/// With mass alone, its cheapest body.
[[nodiscard]] PeerWork box2d_fall(std::size_t bodies);
/// With a circle each, the usual source of mass, in the broad phase.
[[nodiscard]] PeerWork box2d_fall_fixtures(std::size_t bodies);
[[nodiscard]] PeerWork ode_fall(std::size_t bodies);

// Oscillators in double without damping.
[[nodiscard]] PeerWork odeint_rk4(std::size_t oscillators);
[[nodiscard]] PeerWork odeint_symplectic_euler(std::size_t oscillators);
[[nodiscard]] PeerWork gsl_rk4(std::size_t oscillators);

[[nodiscard]] PeerWork bullet_net(const Net& net);

}  // namespace oiler::bench
