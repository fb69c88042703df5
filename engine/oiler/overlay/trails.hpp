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

/// The paths that bodies took as drawn, and those that they truly take. A path that was undone is
/// forgotten: time has gone back.
class Trails {
public:
    static constexpr double duration = 2;         ///< s of simulated time
    static constexpr double longest_frame = 0.5;  ///< s; a longer one is a leap, not a path

    /// Keeps where the bodies are drawn at `time`, s. `ghosts` are at the same time.
    void add(const DrawnBodies& drawn, const World& world, const std::vector<Entity>& bodies,
             const std::vector<Ghost>& ghosts, double time);
    /// Adds them under the bodies, the true ones thin. With a factor, their distances are drawn so
    /// many times as long.
    void draw(Picture& picture, double factor) const;
    void clear() { trails_.clear(); }

private:
    struct Sample {
        double time;
        std::uint32_t jumps;
        Point at;
        std::optional<Point> off;  ///< to where the body truly is
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
