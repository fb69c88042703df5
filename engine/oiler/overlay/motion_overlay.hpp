// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "oiler/inspector/inspector.hpp"
#include "oiler/overlay/drawn_bodies.hpp"
#include "oiler/overlay/trails.hpp"
#include "oiler/whatif/moment.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// How a body moves.
struct BodyMotion {
    Entity body{};
    Vec3 position{};      ///< m
    Vec3 velocity{};      ///< m/s
    Vec3 acceleration{};  ///< m/s², by forces and links; impacts and pushes of the game add to it
};

/// The motions of these bodies now.
[[nodiscard]] std::vector<BodyMotion> motions_of(const World& world,
                                                 const std::vector<Entity>& bodies);

/// The motions at `alpha` between two steps, for the bodies that both have.
[[nodiscard]] std::vector<BodyMotion> between(const std::vector<BodyMotion>& before,
                                              const std::vector<BodyMotion>& after, double alpha);

/// The largest length of a vector of the motions.
[[nodiscard]] double largest(const std::vector<BodyMotion>& motions, Vec3 BodyMotion::*vector);

/// Adds an arrow for a vector of each motion, from the body; `per_metre` of it are drawn as 1 m.
void add_arrows(Picture& picture, const DrawnBodies& bodies, const std::vector<BodyMotion>& motions,
                Vec3 BodyMotion::*vector, double per_metre, Colour colour);

/// A spring with its ends and its length.
struct DrawnSpring {
    struct End {
        std::optional<Entity> body{};  ///< empty: a fixed point
        Vec3 at{};                     ///< m
    };
    End from{};
    End to{};
    double rest_length = 0;   ///< m
    bool pulls_only = false;  ///< a rope, which has no strain while it is slack

    [[nodiscard]] double stretch() const;  ///< m, negative if it is compressed
    [[nodiscard]] bool has_strain() const { return rest_length > 0; }
};

/// The first ten thousand links of a world, and the springs of its first ten thousand bodies.
[[nodiscard]] std::vector<DrawnSpring> springs_of(const World& world);

/// The springs at `alpha` between two steps; `after` if they are not the same springs.
[[nodiscard]] std::vector<DrawnSpring> between(const std::vector<DrawnSpring>& before,
                                               const std::vector<DrawnSpring>& after, double alpha);

/// The strain (a fraction), or for springs without a rest length the stretch (m), that gets the
/// full colour. 0: there are no such springs, or they are relaxed.
struct FullColour {
    double strain = 0;
    double stretch = 0;
};

/// The largest values of the springs, but at most twice their root mean square, so that a few
/// springs do not make all others grey.
[[nodiscard]] FullColour full_colour(const std::vector<DrawnSpring>& springs);

/// From compressed (blue) over relaxed (grey) to stretched (vermilion), for a strain of -1 to 1.
[[nodiscard]] Colour colour_of_strain(double strain);

/// Adds each spring as a straight line with the colour of its strain.
void add_springs(Picture& picture, const DrawnBodies& bodies,
                 const std::vector<DrawnSpring>& springs, const FullColour& full);

/// Draws the motion of the bodies and the strain of the springs over the picture of a game. It
/// never changes the game.
class MotionOverlay {
public:
    /// A picture of the game, which is shown at `time`, s, on the way to its last step.
    struct Frame {
        double time = 0;
        std::vector<Ghost> ghosts{};  ///< at that time
        double factor = 1;            ///< of the distances of ghosts
        std::optional<Entity> followed{};
    };

    /// Adds the overlays in `shown`. Trails and arrows are limited to the first hundred bodies and
    /// the followed one.
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
