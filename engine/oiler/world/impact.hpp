// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/contacts/impact.hpp"
#include "oiler/world/entity.hpp"

namespace oiler {

/// A meeting of a body with a plane, for sounds and scores.
struct Impact {
    Meeting kind;
    Entity entity;
    std::size_t plane;  ///< its index, see World::add_plane
    double time;        ///< s; within a step
    Vec3 point;         ///< m, where the body touches the plane
    Vec3 before;        ///< velocity, m/s
    Vec3 after;
};

}  // namespace oiler
