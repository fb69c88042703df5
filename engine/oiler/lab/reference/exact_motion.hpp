// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "oiler/lab/reference/landing_motion.hpp"
#include "oiler/lab/reference/linear_motion.hpp"
#include "oiler/lab/reference/motion.hpp"
#include "oiler/physics/closed_forms.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::lab {

/// An elliptic orbit around one attractor.
struct OrbitMotion {
    long double gm = 0;            ///< m³/s²
    Vec<long double, 3> centre{};  ///< m
    Ellipse<long double> ellipse;  ///< around the centre
    long double nearest = 0;       ///< m, distance of the pericentre
};

/// A motion that is given as a function of time.
using GivenMotion = std::function<State<long double, 3>(long double t)>;

/// The closed form of a body's motion.
class ExactMotion {
public:
    ExactMotion(const LinearMotion& motion) : motion_(motion) {}
    ExactMotion(const OrbitMotion& motion) : motion_(motion) {}
    ExactMotion(LandingMotion motion) : motion_(std::move(motion)) {}
    template <class F>
    requires std::invocable<const F&, long double> ExactMotion(F motion)
        : motion_(GivenMotion(std::move(motion))) {}

    /// Position and velocity t seconds after the start.
    State<long double, 3> operator()(long double t) const;
    [[nodiscard]] const LinearMotion* linear() const { return std::get_if<LinearMotion>(&motion_); }
    [[nodiscard]] const OrbitMotion* orbit() const { return std::get_if<OrbitMotion>(&motion_); }
    /// See Motion::bend; 0 for a given motion.
    [[nodiscard]] double bend(const State<long double, 3>& first, const State<long double, 3>& last,
                              long double from, long double to) const;
    /// A bound of all bends over 1 s, of the whole motion; those over h s are h⁴ times that.
    [[nodiscard]] double steady_bend() const;
    /// See Motion::enclosure.
    [[nodiscard]] Ball enclosure(const State<long double, 3>& state) const;

private:
    std::variant<LinearMotion, OrbitMotion, LandingMotion, GivenMotion> motion_;
};

/// The closed form of each body's motion from its present state up to `until` s. It shares no code
/// with the methods. Returns none if any body has none: with links, springs with rest lengths,
/// quadratic drag, an attractor beside other forces or planes, an orbit that is not closed, or a
/// landing that landing_motion does not know.
[[nodiscard]] std::optional<std::vector<ExactMotion>> exact_motions(const Bodies& bodies,
                                                                    double until);

}  // namespace oiler::lab
