#version 330 core
// SPDX-License-Identifier: MIT
// Triangles in pixels, with the upper left corner of the frame at (0, 0).
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texture_position;
layout(location = 2) in vec4 colour;

uniform vec2 frame;

out vec2 at;
out vec4 tint;

void main() {
    at = texture_position;
    tint = colour;
    gl_Position = vec4(2.0 * position.x / frame.x - 1.0, 1.0 - 2.0 * position.y / frame.y, 0.0, 1.0);
}
