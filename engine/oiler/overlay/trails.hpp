// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "oiler/overlay/drawn_bodies.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/whatif/moment.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// The paths of bodies as drawn, and their true paths. When time goes back, later samples are
/// removed.
class Trails {
public:
    static constexpr double duration = 2;         ///< s of simulated time
    static constexpr double longest_frame = 0.5;  ///< s; a longer one interrupts the path

    /// Samples the drawn positions of bodies at `time`, s. `ghosts` are at the same time.
    void add(const DrawnBodies& drawn, const World& world, const std::vector<Entity>& bodies,
             const std::vector<Ghost>& ghosts, double time);
    /// Adds the paths under the bodies, the true ones thin. Errors are drawn `factor` times as
    /// long.
    void draw(Picture& picture, double factor) const;
    void clear() { trails_.clear(); }

private:
    struct Sample {
        double time;
        std::uint32_t jumps;
        Point at;
        std::optional<Point> off;  ///< from the drawn to the true position
    };
    struct Trail {
        Entity body{};
        DrawnBodies::Body look{};
        std::deque<Sample> samples{};
    };

    Trail& trail_of(Entity body);

    std::vector<Trail> trails_;
};

}  // namespace oiler
