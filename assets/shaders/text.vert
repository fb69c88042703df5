#version 330 core
// SPDX-License-Identifier: MIT
// One quad per glyph, on whole pixels of the frame and of the atlas.
layout(location = 0) in ivec4 box;       // left, bottom, width, height in pixels
layout(location = 1) in ivec2 in_atlas;  // texel of the glyph's lower left corner
layout(location = 2) in vec4 colour;

uniform vec2 frame;

flat out ivec2 to_texel;
flat out vec4 tint;

void main() {
    ivec2 position = box.xy + ivec2(gl_VertexID & 1, gl_VertexID >> 1) * box.zw;
    to_texel = in_atlas - box.xy;
    tint = colour;
    gl_Position = vec4(2.0 * vec2(position) / frame - 1.0, 0.0, 1.0);
}
