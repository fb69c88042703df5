#version 330 core
// SPDX-License-Identifier: MIT
flat in vec2 middle;
flat in vec2 stroke;
flat in vec4 tint;

out vec4 colour;

void main() {
    float coverage = clamp(stroke.x + 0.5 - distance(gl_FragCoord.xy, middle), 0.0, 1.0);
    colour = vec4(tint.rgb, tint.a * coverage * stroke.y);
}
