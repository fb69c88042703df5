// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "oiler/lab/reference/motion.hpp"
#include "oiler/physics/closed_forms.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::lab {

/// A motion with linear forces: x'' = acceleration − k·x − c·x'.
struct LinearMotion {
    Vec<long double, 3> acceleration{};  ///< m/s², at the origin
    long double k = 0;                   ///< 1/s²
    long double c = 0;                   ///< 1/s
    State<long double, 3> start{};

    /// The point where a spring balances the acceleration; the origin without a spring.
    Vec<long double, 3> rest = k > 0 ? acceleration*(1 / k) : Vec<long double, 3>{};
};

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
    std::variant<LinearMotion, OrbitMotion, GivenMotion> motion_;
};

/// The closed form of each body's motion from its present state. It shares no code with the
/// methods. Returns none if any body has none: with links, springs with rest lengths, quadratic
/// drag, an attractor beside other forces, or an orbit that is not closed.
[[nodiscard]] std::optional<std::vector<ExactMotion>> exact_motions(const Bodies& bodies);

/// The closed forms of a scene. Bodies with equal stiffness and damping share the factors of a
/// time.
class ExactMotions : public Motion {
public:
    explicit ExactMotions(std::vector<ExactMotion> motions);

    [[nodiscard]] std::size_t bodies() const override { return motions_.size(); }
    [[nodiscard]] State<long double, 3> at(std::size_t row, long double t) const override {
        return motions_[row](t);
    }
    void all_at(long double t, std::span<State<long double, 3>> states) const override;
    [[nodiscard]] Walk walk(std::int64_t rate) const override;
    [[nodiscard]] double bend(std::size_t row, const State<long double, 3>& first,
                              const State<long double, 3>& last, long double from,
                              long double to) const override {
        return motions_[row].bend(first, last, from, to);
    }
    [[nodiscard]] double bend_of_any(std::size_t row, long double h) const override {
        const auto length = static_cast<double>(h);
        return length * length * length * length * steady_bends_[row];
    }
    [[nodiscard]] Ball enclosure(std::size_t row,
                                 const State<long double, 3>& state) const override {
        return motions_[row].enclosure(state);
    }

private:
    class Blocks;
    static constexpr std::size_t alone = static_cast<std::size_t>(-1);

    std::vector<ExactMotion> motions_;
    std::vector<double> steady_bends_;  ///< see ExactMotion::steady_bend
    /// The first body of each group with equal k and c, and the group of each body.
    std::vector<std::size_t> first_of_group_;
    std::vector<std::size_t> group_;
};

}  // namespace oiler::lab
