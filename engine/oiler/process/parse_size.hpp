// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <charconv>
#include <string>

#include "oiler/core/error.hpp"
#include "oiler/core/size.hpp"

namespace oiler {

/// Parses a width and a height in pixels such as "1280x720". Throws Error{usage}.
[[nodiscard]] inline Size parse_size(const std::string& words) {
    constexpr int largest_side = 16384;
    Size size;
    const char* const end = words.data() + words.size();
    const auto width = std::from_chars(words.data(), end, size.width);
    if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
        const auto height = std::from_chars(width.ptr + 1, end, size.height);
        const bool in_range = std::min(size.width, size.height) >= 1 &&
                              std::max(size.width, size.height) <= largest_side;
        if (height.ec == std::errc() && height.ptr == end && in_range) return size;
    }
    fail(Exit::usage, "--size {}: give WIDTHxHEIGHT, each from 1 to {}, such as 1280x720", words,
         largest_side);
}

}  // namespace oiler
