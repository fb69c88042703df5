// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <tuple>

#include "oiler/physics/contacts/plane.hpp"
#include "oiler/physics/forces/forces.hpp"
#include "oiler/sim/obstacle.hpp"

namespace oiler {

/// A body in the public API. Axes that the world lacks must be zero.
struct Body {
    double mass = 1;  ///< kg, positive
    Vec3 position{};  ///< m
    Vec3 velocity{};  ///< m/s
    /// Absent: it passes through obstacles.
    std::optional<Contact> contact{};
};

/// A meeting of the body in a row with an obstacle.
struct BodyImpact {
    Meeting kind;
    std::size_t row;
    ObstacleHandle obstacle;
    double time;  ///< s
    Vec3 point;   ///< m, where the body touches the obstacle
    Vec3 normal;  ///< of the obstacle there
    Vec3 before;  ///< m/s
    Vec3 after;   ///< m/s
};

/// A spring between two bodies: force −k·(d − L·d̂) − b·(ḋ·d̂)·d̂ on the first, d = x₁ − x₂, and
/// the opposite on the second; 0 at d = 0. Without a rest length it is damped in all directions:
/// force −k·d − b·ḋ.
///
/// A rope pulls only: while |d| ≤ L it is slack and has neither force nor damping; while it is taut
/// it is a link like any other. The step in which it becomes taut or slack is not divided: the
/// force has a kink there, so that a method has order 2 at most, and order 1 if the rope is damped,
/// because damping begins with a jump. Implicit methods take the damping of a step from its start.
struct Link {
    double stiffness = 0;     ///< k, N/m
    double damping = 0;       ///< b, N·s/m
    double rest_length = 0;   ///< L, m; above 0 for a rope
    bool pulls_only = false;  ///< a rope
};

/// A handle of a link. It becomes stale when the link is removed, by unlink or with either body.
struct LinkHandle {
    std::uint32_t slot = 0;
    std::uint32_t generation = 0;  ///< 0 for no link
    friend bool operator==(const LinkHandle&, const LinkHandle&) = default;
};

/// The ends of a link: a row, and another row or a fixed point.
struct LinkEnds {
    std::size_t row = 0;
    std::optional<std::size_t> other{};  ///< absent for a point
    Vec3 point{};                        ///< m
    friend bool operator==(const LinkEnds&, const LinkEnds&) = default;
};

struct Energy {
    double kinetic = 0;    ///< J
    double potential = 0;  ///< J
    [[nodiscard]] double total() const { return kinetic + potential; }
};

template <class List>
struct OptionalOf;
template <class... Force>
struct OptionalOf<std::tuple<Force...>> {
    using type = std::tuple<std::optional<Force>...>;
};
/// At most one force of each kind.
using GivenForces = OptionalOf<ForceList<double, 3>>::type;

/// Calls f(force) for each given force.
template <class F>
void for_each_given(const GivenForces& forces, F f) {
    std::apply([&](const auto&... force) { ((force ? f(*force) : void()), ...); }, forces);
}

/// A force of a single body: any but Gravity.
template <class Force>
concept BodyForce = !Force::everywhere && requires(GivenForces given) {
    std::get<std::optional<Force>>(given);
};

/// The number of types in `All` that are `Force`.
template <class Force, class... All>
inline constexpr int count_of = (int{std::same_as<Force, All>} + ... + 0);

/// The force of type `Wanted`, or none.
template <class Wanted, class... Force>
[[nodiscard]] auto force_or_none(const Force&... force) {
    if constexpr (count_of<Wanted, Force...> == 0)
        return std::nullopt;
    else
        return std::get<const Wanted&>(std::tie(force...));
}

/// The forces as GivenForces. Each is constructed in place: g++ would write zeros to all of an
/// empty one that is assigned to later.
template <class... Force>
[[nodiscard]] GivenForces given(const Force&... force) {
    if constexpr (!(BodyForce<Force> && ...)) {
        static_assert((BodyForce<Force> && ...),
                      "a body is given forces such as Spring and LinearDrag; a Link joins two "
                      "bodies: world.link(a, b, Link{...})");
        return {};
    } else {
        static_assert(((count_of<Force, Force...> == 1) && ...),
                      "a body has at most one force of each kind");
        return [&]<class... Kind>(const std::tuple<std::optional<Kind>...>*) {
            return GivenForces(force_or_none<Kind>(force...)...);
        }(static_cast<const GivenForces*>(nullptr));
    }
}

/// The index of a kind of force among GivenForces.
template <BodyForce Force>
inline constexpr std::size_t kind_of =
    index_of<std::optional<Force>>(static_cast<GivenForces*>(nullptr));

}  // namespace oiler
