// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
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
    /// lasts. `name_of` names a body of either.
    [[nodiscard]] std::optional<Found> compare(const Moment& play, const Moment& truth, double time,
                                               double late,
                                               const std::function<std::string(Entity)>& name_of);
    /// The beginning of the first difference that there still is, s; infinity: there is none.
    [[nodiscard]] double since() const;
    [[nodiscard]] bool differs() const { return rest_ || !bodies_.empty(); }

private:
    void compare_bodies(const Moment& play, const Moment& truth, double time);

    /// A body that only one has, or that was teleported more often in one.
    struct Different {
        Entity body;
        double from;  ///< s
    };

    std::optional<Found> rest_;                  ///< readings, restarts and the end
    std::map<std::uint64_t, Different> bodies_;  ///< by their entities
};

}  // namespace oiler
