// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "oiler/lab/reference/motion.hpp"
#include "oiler/physics/closed_forms.hpp"
#include "oiler/physics/contacts/plane.hpp"

namespace oiler::lab {

/// A motion with linear forces: x'' = acceleration − k·x − c·x'.
struct LinearMotion {
    Real3 acceleration{};  ///< m/s², at the origin
    Real k = 0;            ///< 1/s²
    Real c = 0;            ///< 1/s
    State3 start{};

    /// The point where a spring balances the acceleration; the origin without a spring.
    Real3 rest = k > 0 ? acceleration*(1 / k) : Real3{};

    /// The state t s after the start.
    [[nodiscard]] State3 at(Real t) const;
};

/// The motions from (1 m, 0 m/s), from (0 m, 1 m/s), and from rest under 1 m/s². Each motion with
/// these k and c is a sum of them.
struct LinearFactors {
    oiler::Motion<Real> from_x;
    oiler::Motion<Real> from_v;
    oiler::Motion<Real> pushed;
};

/// The factors after t s.
[[nodiscard]] LinearFactors factors_at(const LinearMotion& motion, Real t);

/// The state that follows `start` after the time of the factors.
[[nodiscard]] State3 state_after(const LinearMotion& motion, const State3& start,
                                 const LinearFactors& factors);

/// The motion of a body under linear forces that meets planes: pieces of closed forms, from each
/// impact, stop or start of a slide to the next.
class LandingMotion {
public:
    struct Piece {
        Real from = 0;  ///< s
        LinearMotion motion;
    };

    explicit LandingMotion(std::vector<Piece> pieces);

    [[nodiscard]] State3 at(Real t) const;
    /// The piece that holds at both times, if one does.
    [[nodiscard]] const LinearMotion* piece(Real from, Real to) const;
    /// A bound of the speed, m/s.
    [[nodiscard]] double fastest() const { return fastest_; }
    [[nodiscard]] std::span<const Piece> pieces() const { return pieces_; }

private:
    [[nodiscard]] std::size_t index_at(Real t) const;

    std::vector<Piece> pieces_;
    double fastest_ = 0;
};

/// The motion up to the time `until`, s, of a body of `radius` m that moves freely as `free`. It
/// shares no code with the steps: impacts are roots of closed forms. Normals may have any length.
/// Returns none if the body starts below a plane, is borne by two planes at once, or slides in two
/// directions with friction.
[[nodiscard]] std::optional<LandingMotion> landing_motion(const LinearMotion& free,
                                                          std::span<const Plane> planes,
                                                          Real radius, Real until);

}  // namespace oiler::lab
