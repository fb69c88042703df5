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

/// A ball that bounces on a floor.
struct BouncingBall {
    std::function<void()> step;
    std::function<double()> height;    ///< m, of its lowest point above the floor
    std::function<double()> velocity;  ///< m/s, upwards
    /// The number of impacts in the last step; null if the library does not list them.
    std::function<long()> impacts{};
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

// A ball with a radius of ball_radius under −9.81 m/s², thrown up at `speed` m/s and stepped by
// `dt` s, with the default settings of the library.
inline constexpr double ball_radius = 0.5;  ///< m
[[nodiscard]] BouncingBall bullet_ball(double speed, double restitution, double dt);
/// 8 iterations for velocities and 3 for positions, as in the manual.
[[nodiscard]] BouncingBall box2d_ball(double speed, double restitution, double dt);
/// dWorldQuickStep. Impacts below 0.1 m/s do not bounce, as in its demos.
[[nodiscard]] BouncingBall ode_ball(double speed, double restitution, double dt);

}  // namespace oiler::bench
