// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/picture/picture.hpp"

/// Colours that stay distinct for any colour vision: Okabe and Ito, Color Universal Design, 2008.
namespace oiler::palette {

inline constexpr Colour black{0, 0, 0};
inline constexpr Colour orange{230, 159, 0};
inline constexpr Colour sky_blue{86, 180, 233};
inline constexpr Colour green{0, 158, 115};
inline constexpr Colour blue{0, 114, 178};
inline constexpr Colour vermilion{213, 94, 0};
inline constexpr Colour purple{204, 121, 167};

inline constexpr Colour ink{40, 44, 52};
inline constexpr Colour grey{128, 132, 140};
inline constexpr Colour pale{222, 225, 230};
inline constexpr Colour paper{255, 255, 255};

/// Returns the colour with another opacity.
[[nodiscard]] constexpr Colour faded(Colour colour, std::uint8_t alpha) {
    colour.a = alpha;
    return colour;
}

/// Returns the colour at `share` of the way from one to another, from 0 to 1; opacity, too.
[[nodiscard]] constexpr Colour mix(Colour from, Colour to, float share) {
    const auto part = [&](std::uint8_t a, std::uint8_t b) {
        const float mixed = static_cast<float>(a) + share * static_cast<float>(b - a);
        return static_cast<std::uint8_t>(mixed + 0.5F);
    };
    return {part(from.r, to.r), part(from.g, to.g), part(from.b, to.b), part(from.a, to.a)};
}

/// A colour of a scale from blue over purple to orange, for a share from 0 to 1. It can be told
/// from light and from dark grounds.
[[nodiscard]] constexpr Colour scale(float share) {
    const float place = 2 * (share < 0 ? 0 : share > 1 ? 1 : share);
    return place < 1 ? mix(blue, purple, place) : mix(purple, orange, place - 1);
}

}  // namespace oiler::palette
