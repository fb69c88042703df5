// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/math/vec.hpp"
#include "oiler/world/entity.hpp"

namespace oiler {

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
