#version 330 core
// SPDX-License-Identifier: MIT
// An image as large as the frame, whose colours are multiplied by its alpha.
uniform usampler2D image;

out vec4 colour;

void main() {
    colour = vec4(texelFetch(image, ivec2(gl_FragCoord.xy), 0)) / 65535.0;
    if (colour.a == 0.0) discard;
}
