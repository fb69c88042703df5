// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "oiler/inspector/inspector.hpp"
#include "oiler/overlay/body_motion.hpp"
#include "oiler/overlay/spring_overlay.hpp"
#include "oiler/overlay/trails.hpp"

namespace oiler {

/// Draws over the picture of a game how its bodies move and its springs are strained. It reads the
/// game and never changes it.
class MotionOverlay {
public:
    /// A picture of the game, which is shown at `time`, s, on the way to its last step.
    struct Frame {
        double time = 0;
        std::vector<Ghost> ghosts{};  ///< at that time
        double factor = 1;            ///< of the distances of ghosts
        std::optional<Entity> followed{};
    };

    /// Adds what is `shown`. Of many bodies, the first hundred and the followed one have trails and
    /// arrows.
    void add(Picture& picture, const World& world, const Shown& shown, const Frame& frame);
    /// The scales of the last frame.
    [[nodiscard]] const Inspected::Scales& scales() const { return scales_; }

private:
    /// The game after a step.
    struct Sample {
        double time = 0;
        std::vector<BodyMotion> motions{};
        std::vector<DrawnSpring> springs{};
    };
    /// The largest values since the start, so that scales only grow.
    struct Largest {
        double speed = 0;
        double acceleration = 0;
        FullColour springs{};
    };

    void sample(const World& world, const Shown& shown, const std::vector<Entity>& bodies);
    void add_springs_at(Picture& picture, const DrawnBodies& drawn, double alpha);

    Shown shown_{};
    std::vector<Entity> bodies_;
    std::optional<Sample> before_;
    std::optional<Sample> after_;
    Trails trails_;
    Largest largest_;
    Inspected::Scales scales_;
};

}  // namespace oiler
