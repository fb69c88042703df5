// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <variant>

#include "oiler/physics/contacts/plane.hpp"

namespace oiler {

/// The side of a plane to which its normal does not point.
struct HalfSpaceShape {
    Vec3 normal{0, 1};
    double offset = 0;  ///< m, of n·x
    friend bool operator==(const HalfSpaceShape&, const HalfSpaceShape&) = default;
};
/// A circle; a sphere in a world of three axes.
struct CircleShape {
    Vec3 centre{};      ///< m
    double radius = 1;  ///< m
    friend bool operator==(const CircleShape&, const CircleShape&) = default;
};
/// A segment, met from both sides by bodies with a radius. A point passes it.
struct SegmentShape {
    Vec3 from{};  ///< m
    Vec3 to{};    ///< m
    friend bool operator==(const SegmentShape&, const SegmentShape&) = default;
};
/// A box, turned by an angle about the z axis.
struct BoxShape {
    Vec3 centre{};     ///< m
    Vec3 size{};       ///< m, the lengths of its sides
    double angle = 0;  ///< rad, anticlockwise
    friend bool operator==(const BoxShape&, const BoxShape&) = default;
};
using Shape = std::variant<HalfSpaceShape, CircleShape, SegmentShape, BoxShape>;

/// An oscillation about the place of an obstacle: way·sin(2πt/period + phase).
struct Swing {
    Vec3 way{};         ///< m
    double period = 1;  ///< s
    double phase = 0;   ///< rad
    friend bool operator==(const Swing&, const Swing&) = default;
};

/// What bodies with a contact meet.
struct Obstacle {
    Shape shape{};
    double restitution = 0;  ///< from 0 to 1: the part of the normal speed that a bounce keeps
    double friction = 0;     ///< Coulomb's coefficient, 0 or more
    double belt = 0;         ///< m/s of the surface, clockwise: on top to the right; two axes only
    Vec3 velocity{};         ///< m/s
    std::optional<Swing> swing{};
    /// The direction of the side from which bodies meet it, within 60°; from others they pass.
    std::optional<Vec3> one_way{};
    std::uint32_t layers = 1;  ///< one per bit, of which a body must meet one, see Contact::meets
    /// Absent for an area: bodies pass it, and impacts list when they enter and leave it.
    bool solid = true;
    friend bool operator==(const Obstacle&, const Obstacle&) = default;
};

/// A handle of an obstacle. It becomes stale when the obstacle is removed.
struct ObstacleHandle {
    std::uint32_t slot = 0;
    std::uint32_t generation = 0;  ///< 0 for no obstacle
    friend bool operator==(const ObstacleHandle&, const ObstacleHandle&) = default;
};

/// The centre of a circle or a box, m; the middle of a segment; the point of a plane that is
/// nearest to the origin.
[[nodiscard]] Vec3 centre_of(const Shape& shape);

/// A touch of a body and an obstacle.
struct Touch {
    ObstacleHandle obstacle{};
    Vec3 normal{};       ///< of length 1, away from the obstacle
    Vec3 velocity{};     ///< m/s, of the surface there
    bool bears = false;  ///< whether the forces press the body onto it
};

/// The first obstacle along a ray.
struct Hit {
    ObstacleHandle obstacle{};
    double fraction = 0;  ///< of the way
    Vec3 point{};         ///< m
    Vec3 normal{};        ///< of length 1; 0 if the ray starts in the obstacle
};

}  // namespace oiler

/// A game may have a map from its obstacles.
template <>
struct std::hash<oiler::ObstacleHandle> {
    std::size_t operator()(const oiler::ObstacleHandle& handle) const noexcept {
        return std::hash<std::uint64_t>()(std::uint64_t{handle.generation} << 32U | handle.slot);
    }
};
