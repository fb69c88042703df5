// SPDX-License-Identifier: MIT
#include "oiler/picture/theme.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/picture/palette.hpp"

namespace oiler {
namespace {

/// The relative luminance, 0 to 1 (WCAG 2.2).
double luminance(Colour colour) {
    const auto linear = [](std::uint8_t channel) {
        const double share = channel / 255.0;
        return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour.r) + 0.7152 * linear(colour.g) + 0.0722 * linear(colour.b);
}

constexpr Theme made_of(Colour paper, Colour ink) {
    const auto tint = [&](Colour colour, float share) {
        return palette::mix(paper, colour, share);
    };
    return {.ink = ink,
            .faint = tint(ink, 0.78F),
            .paper = paper,
            .panel = tint(ink, 0.06F),
            .field = paper,
            .heading = tint(palette::blue, 0.16F),
            .button = tint(palette::blue, 0.28F),
            .pressed = tint(palette::blue, 0.4F),
            .knob = tint(palette::blue, 0.6F)};
}

bool is_dark(Colour ground) {
    return contrast(ground, palette::paper) > contrast(ground, palette::black);
}

constexpr Theme light = made_of(palette::paper, palette::ink);
constexpr Theme dark = made_of({28, 31, 38}, {236, 238, 242});

}  // namespace

double contrast(Colour a, Colour b) {
    constexpr double flare = 0.05;
    const auto [low, high] = std::minmax({luminance(a), luminance(b)});
    return (high + flare) / (low + flare);
}

Colour readable(Colour colour, Colour ground) {
    constexpr double least = 4.5;
    const Colour end = is_dark(ground) ? palette::paper : palette::black;
    Colour text = colour;
    for (int percent = 1; contrast(text, ground) < least; ++percent)
        text = palette::mix(colour, end, static_cast<float>(percent) / 100);
    return text;
}

const Theme& theme_of(Colour background) { return is_dark(background) ? dark : light; }

}  // namespace oiler
