// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "oiler/lab/reference/linear_motion.hpp"
#include "oiler/physics/contacts/plane.hpp"

namespace oiler::lab {

/// The motion of a body under linear forces that meets planes: pieces of closed forms, from each
/// impact, stop or start of a slide to the next.
class LandingMotion {
public:
    struct Piece {
        long double from = 0;  ///< s
        LinearMotion motion;
    };

    explicit LandingMotion(std::vector<Piece> pieces);

    [[nodiscard]] State<long double, 3> at(long double t) const;
    /// The piece that holds at both times, if one does.
    [[nodiscard]] const LinearMotion* piece(long double from, long double to) const;
    /// A bound of the speed, m/s.
    [[nodiscard]] double fastest() const { return fastest_; }
    [[nodiscard]] std::span<const Piece> pieces() const { return pieces_; }

private:
    [[nodiscard]] std::size_t index_at(long double t) const;

    std::vector<Piece> pieces_;
    double fastest_ = 0;
};

/// The motion up to the time `until`, s, of a body of `radius` m that moves freely as `free`. It
/// shares no code with the steps: impacts are roots of closed forms. Normals may have any length.
/// Returns none if the body starts below a plane, is borne by two planes at once, or slides in two
/// directions with friction.
[[nodiscard]] std::optional<LandingMotion> landing_motion(const LinearMotion& free,
                                                          std::span<const Plane> planes,
                                                          long double radius, long double until);

}  // namespace oiler::lab
