// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/exact_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "oiler/sim/bodies.hpp"

namespace oiler::lab {
namespace {

/// The sum of the forces on a body, for those that have closed forms.
struct Influence {
    Real3 acceleration{};  ///< m/s², at the origin
    Real stiffness = 0;    ///< 1/s²
    Real damping = 0;      ///< 1/s
    std::vector<Attractor> attractors{};
    bool other = false;  ///< a force without a closed form acts
};

/// Whether a force may accelerate the body; a drag without a coefficient does not.
template <class Force>
bool may_act(const Force& force) {
    if constexpr (requires { force.coefficient; }) return force.coefficient != 0;
    return acts(force);
}

Influence influence_on(const Bodies& bodies, std::size_t row) {
    Influence influence;
    for_each_force_on(bodies, row, [&]<class Force>(const Force& force) {
        if constexpr (Linear<Force>) {
            const LinearForce<double, 3> linear = linear_form(force);
            influence.acceleration = influence.acceleration + to_real(linear.constant) +
                                     to_real(linear.centre) * Real(linear.stiffness);
            influence.stiffness += linear.stiffness;
            influence.damping += linear.damping;
        } else if constexpr (std::is_same_v<Force, Attractor>) {
            if (force.gm != 0) influence.attractors.push_back(force);
        } else {
            influence.other = influence.other || may_act(force);
        }
    });
    return influence;
}

double length(const Real3& a) { return static_cast<double>(std::sqrt(squared_length(a))); }

/// A bound of the fourth derivative from a state on, m/s⁴. Each derivative z of the motion obeys
/// the same equation, so that z² + z'²/k never grows.
double snap_of(const LinearMotion& motion, const State3& state, const State3&, Real) {
    const Real k = motion.k;
    const Real c = motion.c;
    if (k == 0) return static_cast<double>(c * c) * length(motion.acceleration - state.v * c);
    const Real3 y = state.x - motion.rest;
    const Real3 jerk = y * (c * k) + state.v * (c * c - k);
    const Real3 snap = y * (k * (k - c * c)) + state.v * (c * (2 * k - c * c));
    const Real3 crackle = jerk * -k - snap * c;
    const auto size = squared_length(snap) + squared_length(crackle) * (1 / k);
    return static_cast<double>(std::sqrt(size));
}

/// The smallest distance from the centre between two states `h` s apart. It is that of the
/// pericentre or of one of the states.
Real nearest_between(const OrbitMotion& motion, const State3& first, const State3& last, Real h) {
    const Real3 here = first.x - motion.centre;
    const Real3 there = last.x - motion.centre;
    const bool may_pass =
        h >= motion.ellipse.period() / 2 || (dot(here, first.v) <= 0 && dot(there, last.v) >= 0);
    if (may_pass) return motion.nearest;
    return std::sqrt(std::min(squared_length(here), squared_length(there)));
}

/// With |a| ≤ gm/r² and v² ≤ 2·gm/r, the fourth derivative is at most 14·gm²/r⁵.
double orbital_snap(const OrbitMotion& motion, Real r) {
    return static_cast<double>(14 * motion.gm * motion.gm / (r * r * r * r * r));
}

double snap_of(const OrbitMotion& motion, const State3& first, const State3& last, Real h) {
    return orbital_snap(motion, nearest_between(motion, first, last, h));
}

double snap_of(const GivenMotion&, const State3&, const State3&, Real) { return 0; }

/// The remainder of Hermite's cubic over h s: h⁴/384 times the fourth derivative.
template <class Any>
double cubic_error_of(const Any& motion, const State3& first, const State3& last, Real from,
                      Real to) {
    const auto h = static_cast<double>(to - from);
    return h * h * h * h / 384 * snap_of(motion, first, last, to - from);
}

/// Across an impact: the body and the cubic each stay within that distance of the first state.
double cubic_error_of(const LandingMotion& motion, const State3& first, const State3& last,
                      Real from, Real to) {
    if (const LinearMotion* const piece = motion.piece(from, to))
        return cubic_error_of(*piece, first, last, from, to);
    return 3 * motion.fastest() * static_cast<double>(to - from);
}

double steady_snap(const LinearMotion& motion) {
    return snap_of(motion, motion.start, motion.start, 0);
}
double steady_snap(const OrbitMotion& motion) { return orbital_snap(motion, motion.nearest); }
double steady_snap(const LandingMotion&) { return std::numeric_limits<double>::infinity(); }
double steady_snap(const GivenMotion&) { return 0; }

/// Returns none for a body that escapes, falls straight in, or feels any other force.
std::optional<ExactMotion> orbit_motion(const Influence& influence, const State3& start) {
    if (influence.attractors.size() != 1 || influence.stiffness != 0 || influence.damping != 0 ||
        largest(influence.acceleration) != 0)
        return std::nullopt;
    const Real gm = influence.attractors[0].gm;
    const Real3 centre = to_real(influence.attractors[0].centre);
    const State3 from{start.x - centre, start.v};
    if (!is_elliptic(gm, from)) return std::nullopt;
    const Real speed2 = squared_length(from.v);
    const Real distance = std::sqrt(squared_length(from.x));
    const Real along = dot(from.x, from.v);
    const Real area2 = distance * distance * speed2 - along * along;
    const Real e = std::sqrt(std::max(Real(0), 1 - area2 * (2 / distance - speed2 / gm) / gm));
    return OrbitMotion{gm, centre, Ellipse<Real>(gm, from), area2 / gm / (1 + e)};
}

/// What bodies with a contact meet, as far as landing_motion knows it.
struct Floors {
    std::vector<Plane> planes{};
    bool others = false;  ///< bounded, moving or one-way obstacles, or those in other layers
};
Floors floors_of(const Bodies& bodies) {
    Floors floors{.planes = bodies.planes()};
    floors.others = std::ranges::any_of(bodies.obstacles(), [&](ObstacleHandle handle) {
        const Obstacle one = bodies.obstacle(handle);
        return one.solid &&
               (!std::holds_alternative<HalfSpaceShape>(one.shape) || one.velocity != Vec3{} ||
                one.swing || one.belt != 0 || one.one_way || one.layers != 1);
    });
    return floors;
}

std::optional<ExactMotion> motion_of(const Bodies& bodies, std::size_t row, const Floors& floors,
                                     Real until) {
    const Influence influence = influence_on(bodies, row);
    if (influence.other) return std::nullopt;
    const State3 start = bodies.state(row);
    const std::optional<Contact> contact = bodies.contact(row);
    if (contact && (floors.others || contact->meets != ~0U)) return std::nullopt;
    const bool lands = contact && !floors.planes.empty();
    if (!influence.attractors.empty()) return lands ? std::nullopt : orbit_motion(influence, start);
    if (influence.stiffness < 0 || influence.damping < 0) return std::nullopt;
    const LinearMotion free{influence.acceleration, influence.stiffness, influence.damping, start};
    if (!lands) return free;
    auto landing = landing_motion(free, floors.planes, contact->radius, until);
    if (!landing) return std::nullopt;
    return std::move(*landing);
}

}  // namespace

State3 OrbitMotion::at(Real t) const {
    const State3 state = ellipse.at(t);
    return {state.x + centre, state.v};
}

State3 ExactMotion::operator()(Real t) const {
    return std::visit([&](const auto& motion) { return motion.at(t); }, motion_);
}

double ExactMotion::cubic_error(const State3& first, const State3& last, Real from, Real to) const {
    return std::visit(
        [&](const auto& motion) { return cubic_error_of(motion, first, last, from, to); }, motion_);
}

double ExactMotion::steady_cubic_error() const {
    return std::visit([](const auto& motion) { return steady_snap(motion) / 384; }, motion_);
}

Ball ExactMotion::enclosure(const State3& state) const {
    const LinearMotion* const motion = linear();
    if (!motion || motion->k == 0) return {};
    return {motion->rest, std::hypot(length(state.x - motion->rest),
                                     length(state.v) / static_cast<double>(std::sqrt(motion->k)))};
}

std::vector<Kink> ExactMotion::kinks() const {
    std::vector<Kink> kinks;
    const auto* const landing = std::get_if<LandingMotion>(&motion_);
    if (!landing) return kinks;
    const std::span<const LandingMotion::Piece> pieces = landing->pieces();
    for (std::size_t i = 1; i < pieces.size(); ++i)
        kinks.push_back({pieces[i].from,
                         pieces[i - 1].motion.at(pieces[i].from - pieces[i - 1].from),
                         pieces[i].motion.start});
    return kinks;
}

std::optional<std::vector<ExactMotion>> exact_motions(const Bodies& bodies, double until) {
    if (bodies.link_count() > 0) return std::nullopt;
    const Floors floors = floors_of(bodies);
    std::vector<ExactMotion> motions;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        std::optional<ExactMotion> motion = motion_of(bodies, row, floors, until);
        if (!motion) return std::nullopt;
        motions.push_back(std::move(*motion));
    }
    return motions;
}

ExactMotions::ExactMotions(std::vector<ExactMotion> motions) : motions_(std::move(motions)) {
    std::map<std::pair<Real, Real>, std::size_t> groups;
    for (std::size_t row = 0; row < motions_.size(); ++row) {
        const LinearMotion* const motion = motions_[row].linear();
        group_.push_back(alone);
        steady_cubic_errors_.push_back(motions_[row].steady_cubic_error());
        if (!motion) continue;
        const auto [at, is_new] =
            groups.try_emplace(std::pair(motion->k, motion->c), first_of_group_.size());
        if (is_new) first_of_group_.push_back(row);
        group_.back() = at->second;
    }
}

void ExactMotions::all_at(Real t, std::span<State3> states) const {
    std::vector<LinearFactors> factors;
    for (const std::size_t row : first_of_group_)
        factors.push_back(factors_at(*motions_[row].linear(), t));
    for (std::size_t row = 0; row < states.size(); ++row) {
        const LinearMotion* const motion = motions_[row].linear();
        states[row] =
            motion ? state_after(*motion, motion->start, factors[group_[row]]) : motions_[row](t);
    }
}

/// The states at consecutive ticks: linear motions from the states at the start of a block of
/// ticks, with factors that all blocks share; orbits from their latest solutions.
class ExactMotions::Blocks {
public:
    Blocks(const ExactMotions& motions, std::int64_t rate)
        : motions_(motions), rate_(static_cast<Real>(rate)), solutions_(motions.bodies()) {
        constexpr std::size_t most_factors = 1 << 16;
        const std::size_t groups = std::max<std::size_t>(1, motions.first_of_group_.size());
        length_ = std::clamp<std::int64_t>(static_cast<std::int64_t>(most_factors / groups), 1, 64);
        for (std::int64_t tick = 0; tick < length_; ++tick)
            for (const std::size_t row : motions.first_of_group_)
                factors_.push_back(
                    factors_at(*motions.motions_[row].linear(), static_cast<Real>(tick) / rate_));
    }

    void write(std::int64_t tick, std::span<State3> states) {
        if (const std::int64_t next = tick / length_; next != block_) {
            block_ = next;
            starts_.resize(states.size());
            motions_.all_at(static_cast<Real>(next * length_) / rate_, starts_);
        }
        const auto first =
            static_cast<std::size_t>(tick % length_) * motions_.first_of_group_.size();
        const Real t = static_cast<Real>(tick) / rate_;
        for (std::size_t row = 0; row < states.size(); ++row) {
            const ExactMotion& motion = motions_.motions_[row];
            if (const LinearMotion* const linear = motion.linear()) {
                states[row] =
                    state_after(*linear, starts_[row], factors_[first + motions_.group_[row]]);
            } else if (const OrbitMotion* const orbit = motion.orbit()) {
                states[row] = orbit->ellipse.at(t, solutions_[row]);
                states[row].x = states[row].x + orbit->centre;
            } else {
                states[row] = motion(t);
            }
        }
    }

private:
    const ExactMotions& motions_;
    Real rate_;
    std::int64_t length_ = 1;
    std::vector<LinearFactors> factors_;  ///< of each tick of a block, for each group
    std::int64_t block_ = -1;
    std::vector<State3> starts_;
    std::vector<Ellipse<Real>::Solution> solutions_;  ///< of the latest tick, for orbits
};

Motion::AtTicks ExactMotions::at_ticks(std::int64_t rate) const {
    return [blocks = Blocks(*this, rate)](std::int64_t tick, std::span<State3> states) mutable {
        blocks.write(tick, states);
    };
}

}  // namespace oiler::lab
