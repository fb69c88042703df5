// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "oiler/sim/store/box_grid.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// Two bodies that touch, or touched on their paths since the last update.
struct Collision {
    Entity a;  ///< its row is before that of b
    Entity b;
    /// The fraction of the path since the last update at which they first touch; 0 if they touched
    /// at that update.
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
    /// Finds the collisions since the last update, of the same world. Bodies stay at their present
    /// place if they were created or teleported since, or had no contact at that update; at the
    /// first update, all do. All that an entity's body does between two updates is one motion, even
    /// if it is removed and added again. Positions that overflow double are left out.
    ///
    /// The time is proportional to the number of bodies and of pairs whose paths have overlapping
    /// bounds: nearly n² for n bodies in one place, or n long paths across a crowd. Bodies of any
    /// sizes may be anywhere. Memory is reused.
    void update(const World& world);

    /// Each pair once, in the order of the rows of a, then of b. A distance that equals the sum of
    /// the radii is a touch.
    [[nodiscard]] const std::vector<Collision>& pairs() const { return pairs_; }
    /// Calls f(a, A&, b, B&) for each pair of an entity that has A and one that has B, in either
    /// order of their rows. If both have both, a has the earlier row. It is a visit: see
    /// World::each.
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
    /// The path of a body since the last update.
    struct Path {
        Vec3 start;     ///< m
        Vec3 end;       ///< m
        double radius;  ///< m
        std::uint32_t row;
    };
    /// The position of an entity at an update.
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
