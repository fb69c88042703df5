// SPDX-License-Identifier: MIT
// What every test needs: Google Test, the usual headers of the standard library, texts and errors.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/core/require.hpp"

namespace oiler::test {

/// Reference values are computed in it.
using Real = long double;
/// The largest relative change of a double by a rounding.
inline constexpr double round_off = std::numeric_limits<double>::epsilon() / 2;

/// Whether the text has this part; a test that fails prints the text.
inline testing::AssertionResult holds(const std::string& text, const std::string& part) {
    return testing::AssertionResult(text.find(part) != std::string::npos) << text;
}

inline std::ptrdiff_t lines(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

inline std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

/// The message that `f` throws in an Error with this exit code.
template <class F>
std::string line_of_error(Exit exit, F f) {
    try {
        f();
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), exit) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "nothing thrown";
    return {};
}

/// The message of the Mistake that `f` makes; empty without one.
template <class F>
std::string mistake_of(F f) {
    try {
        f();
    } catch (const Mistake& mistake) {
        return mistake.what();
    }
    return {};
}

}  // namespace oiler::test
