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
    auto lacking = static_cast<std::size_t>(axes());
    while (vector.axis[lacking] == 0) ++lacking;
    fail(Exit::usage, "{} has {} = {}, but the world has {} axes: leave it 0", what,
         axis_names[lacking], vector.axis[lacking], axes());
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
    if (link.pulls_only && link.rest_length == 0)
        fail(Exit::usage,
             "a link that pulls only has a rest length of 0 m and would never be slack: give its "
             "length, or leave pulls_only out");
}

void Limits::check(const Obstacle& obstacle) const {
    std::visit([&](const auto& shape) { check_shape(shape); }, obstacle.shape);
    const bool is_plane = std::holds_alternative<HalfSpaceShape>(obstacle.shape);
    const std::string_view whose = is_plane ? "a plane's" : "an obstacle's";
    if (!(obstacle.restitution >= 0 && obstacle.restitution <= 1))
        fail(Exit::usage, "{} restitution of {}: give 0 (no bounce) to 1 (no loss)", whose,
             obstacle.restitution);
    check(obstacle.friction, fmt::format("{} friction", whose));
    if (obstacle.friction < 0)
        fail(Exit::usage, "{} friction of {}: give 0 or more", whose, obstacle.friction);
    if (obstacle.layers == 0) fail(Exit::usage, "an obstacle without a layer: give it one");
    check(obstacle.velocity, "an obstacle's velocity");
    if (obstacle.swing) {
        check(obstacle.swing->way, "an obstacle's swing");
        check(obstacle.swing->phase, "the phase of an obstacle's swing");
        if (!(obstacle.swing->period > 0) || !std::isfinite(obstacle.swing->period))
            fail(Exit::usage, "an obstacle's swing with a period of {} s: give more than 0",
                 obstacle.swing->period);
    }
    check(obstacle.belt, "an obstacle's belt");
    if (obstacle.belt != 0 && axes() != 2)
        fail(Exit::usage, "an obstacle's belt needs a world of two axes: leave it 0");
    if (!obstacle.one_way) return;
    check(*obstacle.one_way, "an obstacle's one_way");
    if (!(length(*obstacle.one_way) > 0))
        fail(Exit::usage, "an obstacle's one_way is 0: give the direction from which it is met");
}

void Limits::check_shape(const HalfSpaceShape& plane) const {
    check(plane.normal, "a plane's normal");
    check(plane.offset, "a plane's offset");
    const double size = length(plane.normal);
    if (!(size > 0)) fail(Exit::usage, "a plane's normal is 0: give the direction away from it");
    if (!(size > 1e-30 && size < 1e30))
        fail(Exit::usage, "a plane's normal of length {:g}: give one of length 1", size);
    check(plane.offset / size, "a plane's offset, by the length of its normal,");
}

void Limits::check_shape(const CircleShape& circle) const {
    check(circle.centre, "a circle's centre");
    check(circle.radius, "a circle's radius");
    if (!(circle.radius > 0))
        fail(Exit::usage, "a circle's radius of {} m: give more than 0", circle.radius);
}

void Limits::check_shape(const SegmentShape& segment) const {
    if (axes() < 2) fail(Exit::usage, "a segment needs a world of two axes or more: take a box");
    check(segment.from, "a segment's end");
    check(segment.to, "a segment's end");
    if (!(length(segment.to - segment.from) > 0))
        fail(Exit::usage, "a segment from a point to itself: give two points");
}

void Limits::check_shape(const BoxShape& box) const {
    check(box.centre, "a box's centre");
    check(box.size, "a box's size");
    check(box.angle, "a box's angle");
    for (int i = 0; i < axes(); ++i)
        if (!(box.size[i] > 0))
            fail(Exit::usage, "a box's size of {} m in {}: give more than 0", box.size[i],
                 axis_names[static_cast<std::size_t>(i)]);
    if (box.angle != 0 && axes() < 2)
        fail(Exit::usage, "a box is turned in a world of two axes or more: leave its angle 0");
}

void Limits::check(const Contact& contact) const {
    check(contact.radius, "a contact's radius");
    if (contact.radius < 0)
        fail(Exit::usage, "a contact's radius of {} m: give 0 or more", contact.radius);
}

}  // namespace oiler
