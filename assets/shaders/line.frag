#version 330 core
// SPDX-License-Identifier: MIT
// A box filter of one pixel across the line: the coverage integrates to the line's width.
in vec2 offset;
flat in vec2 stroke;
flat in vec4 tint;

out vec4 colour;

void main() {
    float coverage = clamp(stroke.x + 0.5 - length(offset), 0.0, 1.0);
    colour = vec4(tint.rgb, tint.a * coverage * stroke.y);
}
