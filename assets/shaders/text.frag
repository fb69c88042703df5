#version 330 core
// SPDX-License-Identifier: MIT
// texelFetch, because filtered samples differ between rasterisers.
uniform sampler2D atlas;

flat in ivec2 to_texel;
flat in vec4 tint;

out vec4 colour;

void main() {
    float coverage = texelFetch(atlas, ivec2(gl_FragCoord.xy) + to_texel, 0).r;
    colour = vec4(tint.rgb, tint.a * coverage);
}
