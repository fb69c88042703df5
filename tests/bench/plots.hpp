// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "bench/bench.hpp"
#include "oiler/world/world.hpp"

namespace oiler::bench {

/// Hz
inline constexpr std::array bounce_rates{20, 40, 80, 160, 320, 640};
/// 1/s, per unit mass
inline constexpr double bounce_drag = 0.3;

// The sections of the report. Their rows have a column for each rate, see column_of.
inline constexpr std::string_view free_bounces = "Bounces, error of the tenth apex, m";
inline constexpr std::string_view dragged_bounces =
    "Bounces with a linear drag of 0.3/s, error of the tenth apex, m";
[[nodiscard]] std::string column_of(int rate);

/// Bounces the body as most engines do, after a step that ignored the plane: a body that is below
/// the plane and moves down is put onto it with the reflected velocity.
void bounce_at_end(World& world, Entity body, const Plane& plane, double radius);

/// Draws the errors over the rate.
void draw_bounce_errors(const Report& report, const std::filesystem::path& folder);
/// Draws the path of assets/scenes/bouncing_ball.toml at 20 Hz with both kinds of bounces, over the
/// exact path.
void draw_ball_path(const std::filesystem::path& folder);

/// Draws the cost of a step over the number of bodies, beside the limits of this machine: one PNG
/// per measured scene, in float and three axes. Draws bounces if they were measured.
void draw_plots(const Report& report, const std::filesystem::path& folder);

}  // namespace oiler::bench
