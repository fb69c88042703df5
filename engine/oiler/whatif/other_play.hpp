// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "oiler/whatif/moment.hpp"

namespace oiler {

/// Finds out since when a run is another play than the true one. A body, a count or a restart that
/// differs for less than 0.25 s is only late or early, and so is each of a stream of them.
class OtherPlay {
public:
    struct Found {
        double from = 0;   ///< s
        std::string text;  ///< "coins 2, true 3"
    };

    /// Compares the two at `time`, s; the run may be `late`, s. Returns the first difference that
    /// lasts.
    [[nodiscard]] std::optional<Found> compare(const Moment& play, const Moment& truth, double time,
                                               double late, const NameOfEither& name_of);
    /// The beginning of the first difference that there still is, s; infinity: there is none.
    [[nodiscard]] double since() const;
    [[nodiscard]] bool differs() const { return rest_ || !bodies_.empty(); }

private:
    void compare_bodies(const Moment& play, const Moment& truth, double time);

    std::optional<Found> rest_;  ///< readings, restarts and the end
    /// The bodies that only one has, or that were teleported more often in one, by their numbers:
    /// since when, s.
    std::map<std::uint64_t, double> bodies_;
};

}  // namespace oiler
