#version 330 core
// SPDX-License-Identifier: MIT
// Averages the texels under a pixel with texelFetch, because filtered samples and mipmaps differ
// between rasterisers. Colours are averaged by their alpha.
uniform sampler2D image;  // top row first

flat in vec4 box;
flat in vec3 turn;
flat in vec4 part;  // texels: a corner, and the way to the opposite one
flat in vec4 tint;

out vec4 colour;

vec4 fetch(ivec2 at) {
    ivec2 first = ivec2(min(part.xy, part.xy + part.zw));
    ivec2 last = ivec2(max(part.xy, part.xy + part.zw)) - 1;
    vec4 texel = texelFetch(image, clamp(at, first, last), 0);
    return vec4(texel.rgb * texel.a, texel.a);
}

vec4 bilinear(vec2 at) {
    ivec2 low = ivec2(floor(at - 0.5));
    vec2 beyond = at - 0.5 - vec2(low);
    return mix(mix(fetch(low), fetch(low + ivec2(1, 0)), beyond.x),
               mix(fetch(low + ivec2(0, 1)), fetch(low + ivec2(1, 1)), beyond.x), beyond.y);
}

void main() {
    vec2 offset = gl_FragCoord.xy - box.xy;
    vec2 local = vec2(dot(offset, turn.xy), dot(offset, vec2(-turn.y, turn.x)));
    vec2 inside = clamp(box.zw - abs(local) + 0.5, 0.0, 1.0);
    vec2 texels_per_pixel = part.zw / (2.0 * box.zw);
    vec2 at = part.xy + (vec2(local.x, -local.y) + box.zw) * texels_per_pixel;
    int taps = int(clamp(ceil(max(abs(texels_per_pixel.x), abs(texels_per_pixel.y))), 1.0, 16.0));
    vec4 sum = vec4(0.0);
    for (int j = 0; j < taps; ++j) {
        for (int i = 0; i < taps; ++i) {
            vec2 shift = (vec2(i, j) + 0.5) / float(taps) - 0.5;
            vec2 place = at + shift * texels_per_pixel;
            sum += turn.z > 0.5 ? bilinear(place) : fetch(ivec2(floor(place)));
        }
    }
    sum /= float(taps * taps);
    vec3 straight = sum.a > 0.0 ? sum.rgb / sum.a : vec3(0.0);
    colour = vec4(straight * tint.rgb, sum.a * tint.a * inside.x * inside.y);
}
