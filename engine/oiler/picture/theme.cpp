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

constexpr Theme light = made_of(palette::paper, palette::ink);
constexpr Theme dark = made_of({28, 31, 38}, {236, 238, 242});

}  // namespace

double contrast(Colour a, Colour b) {
    constexpr double flare = 0.05;
    const auto [low, high] = std::minmax({luminance(a), luminance(b)});
    return (high + flare) / (low + flare);
}

const Theme& theme_of(Colour background) {
    const bool is_dark =
        contrast(background, palette::paper) > contrast(background, palette::black);
    return is_dark ? dark : light;
}

}  // namespace oiler
