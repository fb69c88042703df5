// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <tuple>

#include "oiler/core/error.hpp"
#include "oiler/physics/contacts/plane.hpp"
#include "oiler/physics/forces/forces.hpp"
#include "oiler/physics/stepping.hpp"

namespace oiler {

/// A body in the public API. Axes that the world lacks must be zero.
struct Body {
    double mass = 1;  ///< kg, positive
    Vec3 position{};  ///< m
    Vec3 velocity{};  ///< m/s
    /// Absent: it passes through planes.
    std::optional<Contact> contact{};
};

/// A meeting of the body in a row with a plane.
struct BodyImpact {
    Meeting kind;
    std::size_t row;
    std::size_t plane;  ///< in the order of adding
    double time;        ///< s
    Vec3 point;         ///< m, where the body touches the plane
    Vec3 before;        ///< m/s
    Vec3 after;         ///< m/s
};

/// A spring between two bodies: force −k·(d − L·d̂) − b·(ḋ·d̂)·d̂ on the first, d = x₁ − x₂, and
/// the opposite on the second; 0 at d = 0. Without a rest length it is damped in all directions:
/// force −k·d − b·ḋ.
struct Link {
    double stiffness = 0;    ///< k, N/m
    double damping = 0;      ///< b, N·s/m
    double rest_length = 0;  ///< L, m
};

/// A handle of a link. It knows when the link is gone, with either of its bodies or by unlink.
struct LinkHandle {
    std::uint32_t slot = 0;
    std::uint32_t generation = 0;  ///< 0 for no link
    friend bool operator==(const LinkHandle&, const LinkHandle&) = default;
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

/// A force of a single body: Spring, LinearDrag, QuadraticDrag, CoilSpring, Attractor, Wind
/// or Drive.
template <class Force>
concept BodyForce = !Force::everywhere && requires(GivenForces given) {
    std::get<std::optional<Force>>(given);
};

/// The error of a number that is not finite in the precision of the columns.
class NotFinite : public Error {
public:
    using Error::Error;
};

/// Checks whether columns of a precision and a number of axes can hold a value. The checks run
/// before anything is stored and throw Error{usage}, for numbers NotFinite.
class Limits {
public:
    Limits(Precision precision, int axes);

    /// Requires finite numbers on the axes of the world and 0 on the others. The message names
    /// `what`.
    void check(const Vec3& vector, std::string_view what) const;
    void check(const Body& body) const;
    /// Checks the forces per unit mass, as they are stored.
    void check(const GivenForces& forces, double mass) const;
    void check(const Link& link) const;
    void check(const Plane& plane) const;
    void check(const Contact& contact) const;

    void check(double number, std::string_view what) const;

private:
    double largest_;
    int axes_;
};

}  // namespace oiler
