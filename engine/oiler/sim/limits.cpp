// SPDX-License-Identifier: MIT
#include "oiler/sim/limits.hpp"

#include <algorithm>
#include <cmath>

namespace oiler {

void Limits::refuse(double number, std::string_view what) const {
    throw NotFinite(Exit::usage,
                    fmt::format("{} of {}: give a number that is finite and at most {:g}", what,
                                number, largest_));
}

void Limits::refuse(const Vec3& vector, std::string_view what) const {
    for (const double number : vector.axis) check(number, what);
    const auto axes = 3 - std::ranges::count(largest_on_axis_, 0.0);
    std::size_t lacking = static_cast<std::size_t>(axes);
    while (vector.axis[lacking] == 0) ++lacking;
    fail(Exit::usage, "{} has {} = {}, but the world has {} axes: leave it 0", what,
         axis_names[lacking], vector.axis[lacking], axes);
}

void Limits::check(const Body& body) const {
    if (!(body.mass > 0) || !std::isfinite(body.mass))
        fail(Exit::usage, "a body of mass {} kg cannot be moved: give a positive, finite mass",
             body.mass);
    check(body.position, "a position");
    check(body.velocity, "a velocity");
    if (body.contact) check(*body.contact);
}

void Limits::check(const GivenForces& forces, double mass) const {
    const auto check_given = [&]<class Force>(const std::optional<Force>& force) {
        if (!force) return;
        const Force specific = force->per_unit_mass(mass);
        for_each_field<Force>(
            [&](const auto& field) { check(specific.*field.member, Force::name); });
    };
    std::apply([&](const auto&... force) { (check_given(force), ...); }, forces);
}

void Limits::check(const Link& link) const {
    check(link.stiffness, "a link's stiffness");
    check(link.damping, "a link's damping");
    check(link.rest_length, "a link's rest length");
    if (link.stiffness < 0)
        fail(Exit::usage, "a link's stiffness of {} N/m: give 0 or more", link.stiffness);
    if (link.damping < 0)
        fail(Exit::usage, "a link's damping of {} N·s/m: give 0 or more", link.damping);
    if (link.rest_length < 0)
        fail(Exit::usage, "a link's rest length of {} m: give 0 or more", link.rest_length);
}

void Limits::check(const Plane& plane) const {
    check(plane.normal, "a plane's normal");
    check(plane.offset, "a plane's offset");
    const double size = length(plane.normal);
    if (!(size > 0)) fail(Exit::usage, "a plane's normal is 0: give the direction away from it");
    if (!(size > 1e-30 && size < 1e30))
        fail(Exit::usage, "a plane's normal of length {:g}: give one of length 1", size);
    check(plane.offset / size, "a plane's offset, by the length of its normal,");
    if (!(plane.restitution >= 0 && plane.restitution <= 1))
        fail(Exit::usage, "a plane's restitution of {}: give 0 (no bounce) to 1 (no loss)",
             plane.restitution);
    check(plane.friction, "a plane's friction");
    if (plane.friction < 0)
        fail(Exit::usage, "a plane's friction of {}: give 0 or more", plane.friction);
}

void Limits::check(const Contact& contact) const {
    check(contact.radius, "a contact's radius");
    if (contact.radius < 0)
        fail(Exit::usage, "a contact's radius of {} m: give 0 or more", contact.radius);
}

}  // namespace oiler
