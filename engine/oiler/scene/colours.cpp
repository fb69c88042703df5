// SPDX-License-Identifier: MIT
#include "oiler/scene/colours.hpp"

#include <array>
#include <charconv>
#include <cstdint>
#include <utility>

#include "oiler/picture/palette.hpp"

namespace oiler {
namespace {

constexpr std::array<std::pair<std::string_view, Colour>, 11> named{{
    {"black", palette::black},
    {"orange", palette::orange},
    {"sky_blue", palette::sky_blue},
    {"green", palette::green},
    {"blue", palette::blue},
    {"vermilion", palette::vermilion},
    {"purple", palette::purple},
    {"ink", palette::ink},
    {"grey", palette::grey},
    {"pale", palette::pale},
    {"paper", palette::paper},
}};

std::optional<Colour> from_hexadecimal(std::string_view text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    std::uint32_t rgb = 0;
    const auto [last, error] = std::from_chars(text.begin() + 1, text.end(), rgb, 16);
    if (error != std::errc() || last != text.end()) return std::nullopt;
    return Colour{static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U),
                  static_cast<std::uint8_t>(rgb)};
}

}  // namespace

std::optional<Colour> find_colour(std::string_view text) {
    for (const auto& [name, colour] : named)
        if (name == text) return colour;
    return from_hexadecimal(text);
}

std::vector<std::string_view> colour_names() {
    std::vector<std::string_view> words;
    for (const auto& [name, colour] : named) words.push_back(name);
    return words;
}

}  // namespace oiler
