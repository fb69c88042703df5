// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "oiler/math/vec.hpp"
#include "oiler/sim/obstacle.hpp"

namespace oiler {

/// A handle: the slot in the world, and the generation of the entities in that slot. A handle may
/// safely outlive its entity, because the world recognises stale handles.
struct Entity {
    std::uint32_t index = ~std::uint32_t{0};
    std::uint32_t generation = 0;
    friend bool operator==(const Entity&, const Entity&) = default;

    /// Both numbers as one, never 0 for an entity of a world. It is the object of a picture's
    /// element.
    [[nodiscard]] std::uint64_t id() const { return (std::uint64_t{generation} + 1) << 32 | index; }
};

/// A meeting of a body with an obstacle, for sounds and scores.
struct Impact {
    Meeting kind;
    Entity entity;
    ObstacleHandle obstacle;  ///< may be gone, see World::alive
    double time;              ///< s; within a step
    Vec3 point;               ///< m, where the body touches the obstacle
    Vec3 normal;              ///< of the obstacle there, of length 1
    Vec3 before;              ///< velocity, m/s
    Vec3 after;
};

class World;

/// The moving body of an entity during a visit, see World::each_body.
class Moving {
public:
    Moving(World& world, Entity entity) : world_(world), entity_(entity) {}

    [[nodiscard]] Vec3 position() const;
    [[nodiscard]] Vec3 velocity() const;
    [[nodiscard]] double mass() const;  ///< kg
    void set_position(const Vec3& position) const;
    void set_velocity(const Vec3& velocity) const;
    void apply_force(const Vec3& force) const;
    void apply_impulse(const Vec3& impulse) const;

private:
    World& world_;
    Entity entity_;
};

}  // namespace oiler
