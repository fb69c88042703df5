// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace oiler {

/// A result of the play that a game offers, such as a score, an apex or the time of a hit:
/// `std::vector<Reading> readings() const`. --what-if compares them between settings. Whole numbers
/// count as state of the play: where they differ, it is another play.
struct Reading {
    std::string name;
    double value = 0;
    std::string unit{};  ///< "m"; empty for a count
    friend bool operator==(const Reading&, const Reading&) = default;
};

}  // namespace oiler
