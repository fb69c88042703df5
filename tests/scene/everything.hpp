// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace oiler::test {

/// A scene with every key. Every number has an effect: all bodies move, and no force on them is 0.
/// Each body of the scatter meets an obstacle in the first step: a tile, the chain and the circle.
/// One obstacle out of reach is in all layers, so that each may lose its other ones.
inline const std::string everything = R"(
[scene]
title = "Everything"
axes = 2
rate = 100
method = "velocity_verlet"
precision = "double"
damping = "kick"
duration = 4.0

[gravity]
acceleration = [0.5, -9.81]

[[body]]
name = "a"
mass = 1.5
position = [0.5, 0.25]
velocity = [1.0, 2.0]
linear_drag = 0.1
quadratic_drag = 0.2
contact = 0.25
meets = ["front", "pegs", "slope", "level"]
radius = 0.3
colour = "orange"

[[body]]
name = "b"
position = [2.0, 0.0]

[[body]]
name = "c"
position = [3.0, 1.0]

[[spring]]
body = "a"
anchor = [0.0, 1.0]
stiffness = 15.0
damping = 0.1
rest_length = 0.4
pulls_only = false
colour = "green"

[[spring]]
body = "a"
to = "b"
stiffness = 15.0

[[wind]]
body = "b"
velocity = [4.0, -1.0]
drag = 0.3

[[drive]]
body = "c"
amplitude = [6.0, 0.5]
frequency = 2.5
phase = 0.5

[[attractor]]
position = [5.0, 5.0]
gm = 2.0
radius = 0.2
colour = "black"

[[plane]]
name = "wall"
normal = [-1.0, 0.25]
offset = -0.5
restitution = 0.5
friction = 0.3
layers = ["front"]
colour = "green"

[[obstacle]]
name = "peg"
shape = "circle"
centre = [-0.7, 1.2313]
radius = 0.3
restitution = 0.5
friction = 0.03
belt = 0.5
velocity = [0.1, -0.2]
swing = [0.001, 0.0005]
period = 20.0
phase = 0.2
one_way = [0.0, -1.0]
solid = true
layers = ["pegs"]
colour = "green"

[[obstacle]]
shape = "box"
centre = [-3.0, -1.0]
size = [1.0, 0.5]
angle = 0.5
layers = ["front", "solid", "pegs", "slope", "level"]

[[obstacle]]
shape = "segment"
from = [-3.0, 1.0]
to = [-2.0, 1.5]

[[chain]]
name = "hill"
points = [[0.0, 0.3], [0.02, 0.8], [1.0, 1.0]]
closed = false
restitution = 0.5
friction = 0.3
belt = 0.5
velocity = [0.1, -0.2]
swing = [0.001, 0.0005]
period = 20.0
phase = 0.2
one_way = [-1.0, 0.0]
layers = ["slope"]
colour = "green"

[[tiles]]
name = "rock"
origin = [-0.35, -0.0624]
tile = 0.2
rows = ["##......=", ". "]
one_way = "="
restitution = 0.5
friction = 0.3
layers = ["level"]
colour = "green"

[[grid]]
count = [3, 2]
origin = [6.0, 0.0]
spacing = 1.0
velocity = [0.0, 1.0]
mass = 0.5
linear_drag = 0.1
quadratic_drag = 0.2
contact = 0.1
meets = ["front", "pegs", "slope", "level"]
stiffness = 100.0
damping = 0.3
rest_length = 0.8
diagonals = true
hang = "corners"
radius = 0.05
colour = "purple"

[[scatter]]
count = 3
seed = 7
position_from = [-1.0, 0.0]
position_to = [1.0, 2.0]
velocity_from = [0.0, 0.0]
velocity_to = [3.0, 4.0]
mass = 0.5
linear_drag = 0.1
quadratic_drag = 0.2
contact = 0.1
meets = ["front", "pegs", "slope", "level"]
radius = 0.05
colour = "vermilion"

[camera]
centre = [1.0, 1.0]
height = 12.0

[view]
background = "pale"
trails = 3.0
fastest = 20.0
wind = true

[budget]
position_error = 1.0
energy_drift = 0.01
)";

/// Replaces the value of the first such key in the tables of that name. An empty value removes the
/// line.
inline std::string altered(std::string text, std::string_view table, std::string_view key,
                           std::string_view value) {
    const std::size_t header = text.find("[" + std::string(table) + "]");
    const std::size_t line = text.find("\n" + std::string(key) + " = ", header) + 1;
    if (header == std::string::npos || line == 0)
        throw std::invalid_argument("no " + std::string(table) + "." + std::string(key));
    const std::size_t end = text.find('\n', line) + 1;
    const std::string written =
        value.empty() ? "" : std::string(key) + " = " + std::string(value) + "\n";
    return text.replace(line, end - line, written);
}

}  // namespace oiler::test
