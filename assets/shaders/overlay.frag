#version 330 core
// SPDX-License-Identifier: MIT
uniform sampler2D image;

in vec2 at;
in vec4 tint;

out vec4 colour;

void main() { colour = tint * texture(image, at); }
