// SPDX-License-Identifier: MIT
#include <algorithm>

#include "oiler/core/error.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

/// The ends of springs with a rest length that are in one point.
struct PointSprings {
    std::vector<std::size_t> rows{};   ///< of springs to an anchor
    std::vector<std::size_t> links{};  ///< indices
};

bool has_no_direction(const Vec3& d) { return !(Direction<double, 3>(d).length > 0); }

Vec3 end_of_link(const Bodies& bodies, const LinkEnds& ends) {
    return ends.other ? bodies.position(*ends.other) : ends.point;
}

PointSprings point_springs(const Bodies& bodies) {
    PointSprings found;
    const bool has_coils = any_body_has(bodies, []<class Force>() { return LineSpring<Force>; });
    for (std::size_t row = 0; has_coils && row < bodies.size(); ++row)
        for_each_force_on(bodies, row, [&]<class Force>(const Force& force) {
            if constexpr (LineSpring<Force>) {
                const CoilSpring spring = force.line_spring();
                if (spring.stiffness > 0 && spring.rest_length > 0 &&
                    has_no_direction(bodies.position(row) - spring.anchor))
                    found.rows.push_back(row);
            }
        });
    for (std::size_t i = 0; i < bodies.link_count(); ++i) {
        const LinkEnds ends = bodies.link_ends(i);
        const Link link = bodies.link_at(i);
        if (link.stiffness > 0 && link.rest_length > 0 && !link.pulls_only &&
            has_no_direction(bodies.position(ends.row) - end_of_link(bodies, ends)))
            found.links.push_back(i);
    }
    return found;
}

}  // namespace

void add_point_risks(const Bodies& bodies, const Method& method, const Steps& steps,
                     std::vector<Risk>& risks) {
    const PointSprings start = point_springs(bodies);
    if (start.rows.empty() && start.links.empty()) return;
    Bodies later = bodies;
    if (later.try_step(method, {steps.rate, steps.first, 2, steps.damping})) return;
    const PointSprings end = point_springs(later);
    for (const std::size_t row : start.rows)
        if (std::ranges::count(end.rows, row) > 0)
            risks.push_back({.row = row,
                             .of = Risk::Of::told,
                             .message = "spring of body {}: both ends are in one point and stay "
                                        "there, because it has no direction: move the body"});
    for (const std::size_t i : start.links)
        if (std::ranges::count(end.links, i) > 0) {
            const LinkEnds ends = bodies.link_ends(i);
            risks.push_back({.row = ends.row,
                             .linked = ends.other,
                             .of = Risk::Of::told,
                             .message = ends.other
                                            ? "link of bodies {} and {}: both are in one point and "
                                              "stay there, because it has no direction: move one"
                                            : "link of body {} to a point: it is in that point and "
                                              "stays there, because the link has no direction: "
                                              "move the body"});
        }
}

}  // namespace oiler
