#version 330 core
// SPDX-License-Identifier: MIT
// The strip of a polyline: positions in pixels, with the lower left corner of the frame at (0, 0).
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 from_centre_line;  // pixels across the line, and beyond its end
layout(location = 2) in vec2 half_width_and_strength;
layout(location = 3) in vec4 colour;

uniform vec2 frame;

out vec2 offset;
flat out vec2 stroke;
flat out vec4 tint;

void main() {
    offset = from_centre_line;
    stroke = half_width_and_strength;
    tint = colour;
    gl_Position = vec4(2.0 * position / frame - 1.0, 0.0, 1.0);
}
