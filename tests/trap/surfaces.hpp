// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "oiler/scene/scene.hpp"

namespace oiler::trap {

using Real = long double;
using Point = std::array<Real, 3>;

/// What a body does not enter: a half-space, a bar or a disc. Boxes and segments are bars along
/// their faces and discs at their corners: the centre of a ball then meets the same shapes,
/// thicker by its radius.
struct Surface {
    enum class Shape { half_space, bar, disc };
    Shape shape = Shape::half_space;
    Point centre{};  ///< m; a point of the face of a half-space
    Point normal{};  ///< of length 1; a bar has a face on the other side too
    Real size = 0;   ///< m, half of the thickness of a bar, or the radius of a disc
    Real reach = 0;  ///< m, half of the length of a bar
    Real restitution = 0;
    Real friction = 0;
    Point velocity{};  ///< m/s
    Point swing{};     ///< m
    Real omega = 0;    ///< rad/s, of the swing
    Real phase = 0;    ///< rad

    [[nodiscard]] Point velocity_at(Real t) const;
    [[nodiscard]] Point acceleration_at(Real t) const;
    [[nodiscard]] Point normal_at(const Real* x, Real t) const;
    /// From the face, whose ends do not count, to a ball, m.
    [[nodiscard]] Real height(const Real* x, Real t, Real contact) const;
    /// How far a point is beyond the ends of a bar, m; negative between them.
    [[nodiscard]] Real beyond(const Real* x, Real t) const;
    /// Negative if a ball is inside. `lid` thickens a bar.
    [[nodiscard]] Real gap(const Real* x, Real t, Real contact, Real lid = 0) const;
    /// Of the path of a ball's centre along it, 1/m.
    [[nodiscard]] Real curvature(Real contact) const;

private:
    [[nodiscard]] Point from_centre(const Real* x, Real t) const;
};

/// All that bodies with a contact radius meet in a scene without layers, belts and one-way sides.
[[nodiscard]] std::vector<Surface> surfaces_of(const Scene& scene);

}  // namespace oiler::trap
