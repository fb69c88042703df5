#version 330 core
// SPDX-License-Identifier: MIT
// One quad per instance: the box around a turned image with its soft edge, clamped to the frame.
layout(location = 0) in vec4 centre_and_half_size;  // pixels
layout(location = 1) in vec3 direction_and_smooth;  // cosine and sine of the angle
layout(location = 2) in vec4 start_and_extent;  // texels
layout(location = 3) in vec4 colour;

uniform vec2 frame;

flat out vec4 box;
flat out vec3 turn;
flat out vec4 part;
flat out vec4 tint;

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    vec2 half_size = centre_and_half_size.zw;
    vec2 direction = abs(direction_and_smooth.xy);
    vec2 reach = vec2(dot(half_size, direction), dot(half_size, direction.yx)) + 1.0;
    vec2 position = clamp(centre_and_half_size.xy + corner * reach, vec2(-1.0), frame + 1.0);
    box = centre_and_half_size;
    turn = direction_and_smooth;
    part = start_and_extent;
    tint = colour;
    gl_Position = vec4(2.0 * position / frame - 1.0, 0.0, 1.0);
}
