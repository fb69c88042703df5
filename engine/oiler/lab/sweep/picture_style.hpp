// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <array>
#include <string>

#include "oiler/lab/sweep/tradeoff.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/plot/plot.hpp"

namespace oiler::lab {

inline constexpr std::size_t most_methods = 6;

/// Methods differ in shape as well as in colour.
struct MethodStyle {
    Colour colour;
    Mark mark;
};
inline constexpr std::array<MethodStyle, most_methods> styles{{{palette::vermilion, Mark::disc},
                                                               {palette::blue, Mark::square},
                                                               {palette::green, Mark::diamond},
                                                               {palette::orange, Mark::triangle},
                                                               {palette::purple, Mark::ring},
                                                               {palette::sky_blue, Mark::disc}}};

/// Leaves room for the longest name of a method beside the box.
inline constexpr Box plot_box{{54, 62}, {420, 308}};

[[nodiscard]] inline std::string title_of(const char* words, const Tradeoff& tradeoff) {
    return fmt::format("{}: {}", words, tradeoff.title.empty() ? tradeoff.scene : tradeoff.title);
}

}  // namespace oiler::lab
