// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <sstream>
#include <string>

#include "support/test.hpp"

namespace oiler::test {

/// The length at the beginning of a text, such as "7.5 cm", in m.
inline double metres_in(const std::string& text) {
    static const std::map<std::string, double> units{
        {"m", 1}, {"cm", 0.01}, {"mm", 1e-3}, {"µm", 1e-6}, {"nm", 1e-9}};
    std::istringstream words(text);
    double number = NAN;
    std::string unit;
    words >> number >> unit;
    while (!unit.empty() && !units.contains(unit)) unit.pop_back();  // of "cm;" the semicolon
    EXPECT_FALSE(unit.empty()) << text;
    return unit.empty() ? NAN : number * units.at(unit);
}

}  // namespace oiler::test
