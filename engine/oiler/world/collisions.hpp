// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "oiler/world/box_grid.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// Two bodies that touch, or touched on their ways since the update before.
struct Collision {
    Entity a;  ///< its row is before that of b
    Entity b;
    /// The part of the way from the update before at which they first touch; 0 if they touched
    /// then.
    double fraction;
    bool touching;  ///< at the update
};

/// Detects which bodies with a contact touch each other: discs with two axes, spheres with three.
/// Each body moves along a straight line between two updates, so that no fast body is missed. The
/// motion of the bodies does not change.
///
/// It is a value that a game keeps and updates after each step, so other games do not pay for it.
class Collisions {
public:
    /// Finds the collisions since the update before, of the same world. A body that was created or
    /// teleported in between, or without a contact at the update before, stays at its present
    /// place, and so do all bodies at the first update. What an entity's body does between two
    /// updates, also if it is removed and added again, is one motion. Positions that overflow
    /// double are left out.
    ///
    /// The time is proportional to the number of bodies and of pairs whose paths have overlapping
    /// bounds: nearly n² for n bodies in one place, or n long paths across a crowd. Bodies of any
    /// sizes may be anywhere. Memory is reused.
    void update(const World& world);

    /// Each pair once, in the order of the rows of a, then of b. A distance that equals the sum of
    /// the radii is a touch.
    [[nodiscard]] const std::vector<Collision>& pairs() const { return pairs_; }
    /// Calls f(a, A&, b, B&) for each pair of an entity that has A and one that has B, whichever
    /// has the earlier row. It is a visit: see World::each. Of a pair that both have both, a is the
    /// earlier.
    template <class A, class B, class F>
    void each(World& world, F&& f) const {
        for (const Collision& pair : pairs_)
            for (const auto& [a, b] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
                A* const first = world.find<A>(a);
                B* const second = world.find<B>(b);
                if (!first || !second) continue;
                f(a, *first, b, *second);
                break;
            }
    }

private:
    /// The way of a body since the update before.
    struct Path {
        Vec3 start;     ///< m
        Vec3 end;       ///< m
        double radius;  ///< m
        std::uint32_t row;
    };
    /// The place of an entity at an update.
    struct Mark {
        Vec3 position{};
        std::uint64_t update = 0;  ///< from 1
        std::uint32_t generation = 0;
        std::uint32_t jumps = 0;
    };
    struct Meet {
        std::uint32_t a;  ///< its row
        std::uint32_t b;
        double fraction;
        bool touching;
    };

    void add_path(const World& world, std::size_t row, double radius);
    void meet(const Path& a, const Path& b);
    void add_meet(const Path& a, const Path& b, double fraction, bool touching);
    void list_pairs(const World& world);

    std::uint64_t updates_ = 0;
    std::vector<Mark> marks_;  ///< for each slot of an entity
    std::vector<Path> paths_;
    std::vector<Path> sorted_;  ///< in the order of the grid, so that pairs are close in memory
    BoxGrid grid_;
    std::vector<Meet> meets_;
    std::vector<Collision> pairs_;
};

}  // namespace oiler
