#version 330 core
// SPDX-License-Identifier: MIT
// One quad per instance, large enough for a disc with its soft edge. It is clamped to the frame,
// because the fixed-point coordinates of a rasteriser are limited.
layout(location = 0) in vec2 centre;               // pixels
layout(location = 1) in vec2 radius_and_strength;  // pixels, 1
layout(location = 2) in vec4 colour;

uniform vec2 frame;

flat out vec2 middle;
flat out vec2 stroke;
flat out vec4 tint;

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    vec2 position = centre + corner * (radius_and_strength.x + 1.0);
    position = clamp(position, vec2(-1.0), frame + 1.0);
    middle = centre;
    stroke = radius_and_strength;
    tint = colour;
    gl_Position = vec4(2.0 * position / frame - 1.0, 0.0, 1.0);
}
