// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "oiler/overlay/drawn_bodies.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// A spring with its ends and its length.
struct DrawnSpring {
    struct End {
        std::optional<Entity> body{};  ///< empty: a fixed point
        Vec3 at{};                     ///< m
    };
    End from{};
    End to{};
    double rest_length = 0;  ///< m

    [[nodiscard]] double stretch() const;  ///< m, negative if it is compressed
    [[nodiscard]] bool has_strain() const { return rest_length > 0; }
};

/// The first ten thousand links of a world, and the springs of its first ten thousand bodies.
[[nodiscard]] std::vector<DrawnSpring> springs_of(const World& world);

/// The springs at `alpha` between two steps; `after` if they are not the same springs.
[[nodiscard]] std::vector<DrawnSpring> between(const std::vector<DrawnSpring>& before,
                                               const std::vector<DrawnSpring>& after, double alpha);

/// The strain (a fraction) or, of springs without a rest length, the stretch (m) that has the full
/// colour. 0: there are no such springs, or they are relaxed.
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

}  // namespace oiler
