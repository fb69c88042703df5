// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "oiler/lab/reference/landing_motion.hpp"
#include "oiler/lab/reference/motion.hpp"
#include "oiler/physics/closed_forms.hpp"

namespace oiler {
class Bodies;
}

namespace oiler::lab {

/// An elliptic orbit around one attractor.
struct OrbitMotion {
    Real gm = 0;            ///< m³/s²
    Real3 centre{};         ///< m
    Ellipse<Real> ellipse;  ///< around the centre
    Real nearest = 0;       ///< m, distance of the pericentre

    /// The state t s after the start.
    [[nodiscard]] State3 at(Real t) const;
};

/// A motion that is given as a function of time.
struct GivenMotion {
    std::function<State3(Real t)> at;
};

/// The closed form of a body's motion.
class ExactMotion {
public:
    ExactMotion(const LinearMotion& motion) : motion_(motion) {}
    ExactMotion(const OrbitMotion& motion) : motion_(motion) {}
    ExactMotion(LandingMotion motion) : motion_(std::move(motion)) {}
    template <class F>
    requires std::invocable<const F&, Real> ExactMotion(F motion)
        : motion_(GivenMotion{std::move(motion)}) {}

    /// Position and velocity t seconds after the start.
    State3 operator()(Real t) const;
    [[nodiscard]] const LinearMotion* linear() const { return std::get_if<LinearMotion>(&motion_); }
    [[nodiscard]] const OrbitMotion* orbit() const { return std::get_if<OrbitMotion>(&motion_); }
    /// See Motion::cubic_error; 0 for a given motion.
    [[nodiscard]] double cubic_error(const State3& first, const State3& last, Real from,
                                     Real to) const;
    /// A bound of all cubic errors over 1 s, of the whole motion; those over h s are h⁴ times that.
    [[nodiscard]] double steady_cubic_error() const;
    /// See Motion::enclosure.
    [[nodiscard]] Ball enclosure(const State3& state) const;
    /// See Motion::kinks; none of a given motion.
    [[nodiscard]] std::vector<Kink> kinks() const;

private:
    std::variant<LinearMotion, OrbitMotion, LandingMotion, GivenMotion> motion_;
};

/// The closed form of each body's motion from its present state up to `until` s. It shares no code
/// with the methods. Returns none if any body has none: with links, springs with rest lengths,
/// quadratic drag, an attractor beside other forces or planes, an orbit that is not closed, a
/// contact among obstacles other than planes that stand, or a landing that landing_motion does not
/// know.
[[nodiscard]] std::optional<std::vector<ExactMotion>> exact_motions(const Bodies& bodies,
                                                                    double until);

/// The closed forms of a scene. Bodies with equal stiffness and damping share the factors of a
/// time.
class ExactMotions : public Motion {
public:
    explicit ExactMotions(std::vector<ExactMotion> motions);

    [[nodiscard]] std::size_t bodies() const override { return motions_.size(); }
    [[nodiscard]] State3 at(std::size_t row, Real t) const override { return motions_[row](t); }
    void all_at(Real t, std::span<State3> states) const override;
    [[nodiscard]] AtTicks at_ticks(std::int64_t rate) const override;
    [[nodiscard]] double cubic_error(std::size_t row, const State3& first, const State3& last,
                                     Real from, Real to) const override {
        return motions_[row].cubic_error(first, last, from, to);
    }
    [[nodiscard]] double largest_cubic_error(std::size_t row, Real h) const override {
        const auto length = static_cast<double>(h);
        return length * length * length * length * steady_cubic_errors_[row];
    }
    [[nodiscard]] Ball enclosure(std::size_t row, const State3& state) const override {
        return motions_[row].enclosure(state);
    }
    [[nodiscard]] std::vector<Kink> kinks(std::size_t row) const override {
        return motions_[row].kinks();
    }

private:
    class Blocks;
    static constexpr std::size_t alone = static_cast<std::size_t>(-1);

    std::vector<ExactMotion> motions_;
    std::vector<double> steady_cubic_errors_;  ///< see ExactMotion::steady_cubic_error
    /// The first body of each group with equal k and c, and the group of each body.
    std::vector<std::size_t> first_of_group_;
    std::vector<std::size_t> group_;
};

}  // namespace oiler::lab
