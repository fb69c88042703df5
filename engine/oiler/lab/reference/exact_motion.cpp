// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/exact_motion.hpp"

#include <cmath>

#include "oiler/physics/closed_forms.hpp"

namespace oiler::lab {
namespace {

using Real = long double;
using Real3 = Vec<Real, 3>;

Real3 to_real(const Vec3& v) { return {v[0], v[1], v[2]}; }

/// The sum of the forces on a body, for those that have closed forms.
struct Influence {
    Real3 acceleration{};  ///< m/s², at the origin
    Real stiffness = 0;    ///< 1/s²
    Real damping = 0;      ///< 1/s
    std::vector<Attractor> attractors{};
    bool other = false;  ///< a force without a closed form acts
};

template <class Force>
const Force* get(const GivenForces& forces) {
    const auto& given = std::get<std::optional<Force>>(forces);
    return given ? &*given : nullptr;
}

void add(Influence& influence, const GivenForces& forces) {
    if (const auto* gravity = get<GravityForce<double, 3>>(forces))
        influence.acceleration = influence.acceleration + to_real(gravity->acceleration);
    if (const auto* spring = get<Spring>(forces)) {
        influence.acceleration =
            influence.acceleration + to_real(spring->anchor) * Real(spring->stiffness);
        influence.stiffness += spring->stiffness;
        influence.damping += spring->damping;
    }
    if (const auto* drag = get<LinearDrag>(forces)) influence.damping += drag->coefficient;
    if (const auto* drag = get<QuadraticDrag>(forces))
        influence.other = influence.other || drag->coefficient != 0;
    if (const auto* coil = get<CoilSpring>(forces))
        influence.other = influence.other || coil->stiffness != 0 || coil->damping != 0;
    if (const auto* attractor = get<Attractor>(forces))
        if (attractor->gm != 0) influence.attractors.push_back(*attractor);
}

Motion<Real> along(const State<Real, 3>& start, int axis) { return {start.x[axis], start.v[axis]}; }

/// The oscillation around the point where the spring balances the constant acceleration.
Motion<Real> oscillation(const Influence& influence, const State<Real, 3>& start, int axis,
                         Real t) {
    const Real rest = influence.acceleration[axis] / influence.stiffness;
    const Motion<Real> from{start.x[axis] - rest, start.v[axis]};
    const Motion<Real> to =
        damped_oscillator<Real>(1, influence.stiffness, influence.damping, from, t);
    return {rest + to.x, to.v};
}

ExactMotion linear_motion(const Influence& influence, const State<Real, 3>& start) {
    return [=](Real t) {
        State<Real, 3> state{};
        for (int axis = 0; axis < 3; ++axis) {
            const Motion<Real> motion =
                influence.stiffness > 0
                    ? oscillation(influence, start, axis, t)
                    : linear_drag_motion(along(start, axis), influence.acceleration[axis],
                                         influence.damping, t);
            state.x[axis] = motion.x;
            state.v[axis] = motion.v;
        }
        return state;
    };
}

/// Returns none for a body that escapes, falls straight in, or feels any other force.
std::optional<ExactMotion> orbit_motion(const Influence& influence, const State<Real, 3>& start) {
    if (influence.attractors.size() != 1 || influence.stiffness != 0 || influence.damping != 0 ||
        largest(influence.acceleration) != 0)
        return std::nullopt;
    const Real gm = influence.attractors[0].gm;
    const Real3 centre = to_real(influence.attractors[0].centre);
    const State<Real, 3> from{start.x - centre, start.v};
    if (!is_elliptic(gm, from)) return std::nullopt;
    return [=](Real t) {
        State<Real, 3> state = kepler(gm, from, t);
        state.x = state.x + centre;
        return state;
    };
}

std::optional<ExactMotion> motion_of(const Bodies& bodies, std::size_t row) {
    Influence influence;
    for (std::size_t index = 0; index < bodies.most_forces_of_a_kind(); ++index)
        add(influence, bodies.forces_per_mass(row, index));
    if (influence.other) return std::nullopt;
    const State<Real, 3> start = bodies.state(row);
    if (!influence.attractors.empty()) return orbit_motion(influence, start);
    if (influence.stiffness < 0 || influence.damping < 0) return std::nullopt;
    return linear_motion(influence, start);
}

}  // namespace

std::optional<std::vector<ExactMotion>> exact_motions(const Bodies& bodies) {
    if (bodies.link_count() > 0) return std::nullopt;
    std::vector<ExactMotion> motions;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        std::optional<ExactMotion> motion = motion_of(bodies, row);
        if (!motion) return std::nullopt;
        motions.push_back(std::move(*motion));
    }
    return motions;
}

}  // namespace oiler::lab
