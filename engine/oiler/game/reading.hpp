// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "oiler/core/error.hpp"

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

/// Throws Error{usage} if two readings have one name.
inline void require_distinct_names(const std::vector<Reading>& readings) {
    for (std::size_t i = 0; i < readings.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (readings[i].name == readings[j].name)
                fail(Exit::usage, "two readings are named {}; rename one", readings[i].name);
}

}  // namespace oiler
