// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "bench/bench.hpp"
#include "oiler/world/world.hpp"

namespace oiler::bench {

/// Pairs of bodies.
using Links = std::vector<std::array<std::size_t, 2>>;

/// A net of n × n bodies 1 m apart.
struct Net {
    std::size_t side;

    [[nodiscard]] std::size_t bodies() const { return side * side; }
    /// Stretches and bends the net a little, so that every spring pulls.
    [[nodiscard]] Vec3 position(std::size_t i) const;
    /// All horizontal ones row by row, then all vertical ones row by row.
    [[nodiscard]] Links links() const;
    /// As many links as the net has, between random pairs of bodies.
    [[nodiscard]] Links random_links() const;
};

/// In float and three axes.
[[nodiscard]] World make_net(const Net& net, const Links& links, const Link& link);

/// Another library that does the same work.
struct PeerWork {
    Work step;                        ///< of all bodies, `times` times
    std::function<double()> measure;  ///< a number that changes with the work
};

/// The function of a peer; null if it was not found, so that the function is never linked.
template <bool found, auto make>
constexpr auto if_found() -> decltype(make) {
    if constexpr (found)
        return make;
    else
        return nullptr;
}

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

enum class Phase { flying, bouncing, resting };
/// Level ground of 1000 m by boxes side by side, 1000 or less of them in a row, and balls with a
/// radius of 0.1 m above it that do not meet each other.
struct TiledGround {
    std::size_t tiles;
    std::size_t balls;
    Phase phase;

    [[nodiscard]] double width() const { return 1000.0 / static_cast<double>(columns()); }
    [[nodiscard]] std::size_t columns() const { return tiles < 1000 ? tiles : 1000; }
    /// The centre of a tile, m; its height is 1 m.
    [[nodiscard]] Vec3 tile(std::size_t i) const;
    /// Balls in all phases of flights of 147 steps; flying ones go straight on, without gravity.
    [[nodiscard]] Body ball(std::size_t i) const;
    [[nodiscard]] double gravity() const { return phase == Phase::flying ? 0 : -9.81; }
    [[nodiscard]] double restitution() const { return phase == Phase::resting ? 0 : 1; }
};
[[nodiscard]] PeerWork box2d_tiles(const TiledGround& ground);
[[nodiscard]] PeerWork bullet_tiles(const TiledGround& ground);

// A ball with a radius of ball_radius under −9.81 m/s², thrown up at `speed` m/s and stepped by
// `dt` s, with the default settings of the library.
inline constexpr double ball_radius = 0.5;  ///< m
[[nodiscard]] BouncingBall bullet_ball(double speed, double restitution, double dt);
/// 8 iterations for velocities and 3 for positions, as in the manual.
[[nodiscard]] BouncingBall box2d_ball(double speed, double restitution, double dt);
/// dWorldQuickStep. Impacts below 0.1 m/s do not bounce, as in its demos.
[[nodiscard]] BouncingBall ode_ball(double speed, double restitution, double dt);

}  // namespace oiler::bench
