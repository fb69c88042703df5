#version 330 core
// SPDX-License-Identifier: MIT
// A quad over the whole frame.
void main() {
    gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0, 0.0, 1.0);
}
