// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/landing_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oiler::lab {
namespace {

constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
constexpr std::size_t most_pieces = 20'000;  // see most_impacts
/// More short flights in a row than this do not end, as in a corner.
constexpr int most_short_flights = 64;
/// Bounces with shorter flights, s, are at an end: they are less than 10⁻¹⁸ m high.
constexpr Real shortest_flight = 1e-9L;

struct Surface {
    Real3 normal;  ///< of length 1
    Real offset;   ///< m, with the body's radius
    Real restitution;
    Real friction;

    [[nodiscard]] Real gap(const State3& state) const { return dot(normal, state.x) - offset; }
    [[nodiscard]] Real speed(const State3& state) const { return dot(normal, state.v); }
};

Surface surface_of(const Plane& plane, Real radius) {
    const Real3 n = to_real(plane.normal);
    const Real size = std::sqrt(squared_length(n));
    return {n / size, plane.offset / size + radius, plane.restitution, plane.friction};
}

Real3 acceleration(const LinearMotion& motion, const State3& state) {
    return motion.acceleration - state.x * motion.k - state.v * motion.c;
}

/// The first time in [0, until] at which f, not negative at 0, becomes negative, where f turns at
/// most once. `slope` is its derivative.
template <class F, class Slope>
std::optional<Real> first_negative(F f, Slope slope, Real from, Real to) {
    const auto bisect = [](auto g, Real low, Real high) {
        for (int i = 0; i < 200; ++i) {
            const Real middle = (low + high) / 2;
            if (!(middle > low && middle < high)) break;
            (g(middle) < 0 ? high : low) = middle;
        }
        return low;
    };
    if (f(to) < 0) {
        // If it rises first, it falls after its top.
        const Real top = slope(from) > 0 && slope(to) < 0 ? bisect(slope, from, to) : from;
        return bisect(f, top, to);
    }
    if (!(slope(from) < 0 && slope(to) > 0)) return std::nullopt;
    const Real lowest = bisect([&](Real t) { return -slope(t); }, from, to);
    if (!(f(lowest) < 0)) return std::nullopt;
    return bisect(f, from, lowest);
}

/// Follows a body from piece to piece.
class LandingFollower {
public:
    LandingFollower(const LinearMotion& free, std::vector<Surface> surfaces, Real until)
        : free_(free), surfaces_(std::move(surfaces)), until_(until), state_(free.start) {}

    std::optional<LandingMotion> run() {
        for (const Surface& surface : surfaces_)
            if (surface.gap(state_) < -noise(surface)) return std::nullopt;
        while (pieces_.size() < most_pieces) {
            const Real before = t_;
            const bool going = bounce() || move();
            short_flights_ = t_ - before < shortest_flight ? short_flights_ + 1 : 0;
            if (!known_ || short_flights_ > most_short_flights) return std::nullopt;
            if (!going) return LandingMotion(std::move(pieces_));
        }
        return std::nullopt;
    }

private:
    [[nodiscard]] Real noise(const Surface& surface) const {
        return 64 * epsilon * (std::abs(surface.offset) + largest(state_.x) + largest(state_.v));
    }
    [[nodiscard]] bool touches(const Surface& surface) const {
        return surface.gap(state_) <= noise(surface);
    }
    [[nodiscard]] Real still(const State3& state) const { return 64 * epsilon * largest(state.v); }

    /// Changes the velocity where the body meets a plane.
    bool bounce() {
        for (const Surface& surface : surfaces_) {
            const Real speed = -surface.speed(state_);
            if (!touches(surface) || speed <= still(state_)) continue;
            Real3 along = state_.v + surface.normal * speed;
            const Real glide = std::sqrt(squared_length(along));
            const Real kept = surface.restitution * speed;
            const Real pull = -dot(surface.normal, acceleration(free_, state_));
            const bool over =
                pull > 0 && 2 * kept <= shortest_flight * pull && surface.restitution < 1;
            // The friction of all further bounces is that of a slide from the landing on.
            const Real braked = surface.friction * (over ? speed : speed + kept);
            along = braked < glide ? along * (1 - braked / glide) : Real3{};
            state_.v = along + surface.normal * (over ? Real(0) : kept);
            return true;
        }
        return false;
    }

    /// Adds the piece from now on, and goes to its end. Returns false at the end of the run.
    bool move() {
        const Surface* bearing = nullptr;
        for (const Surface& surface : surfaces_) {
            const bool bears = touches(surface) && surface.speed(state_) <= still(state_) &&
                               dot(surface.normal, acceleration(free_, state_)) < 0;
            if (!bears) continue;
            known_ = bearing == nullptr;
            if (!known_) return false;
            bearing = &surface;
        }
        return bearing ? glide(*bearing) : follow(moving_as(free_.acceleration), nullptr, {});
    }
    [[nodiscard]] LinearMotion moving_as(const Real3& acceleration) const {
        return LinearMotion{acceleration, free_.k, free_.c, state_};
    }

    /// Slides along a plane that bears the body, or rests on it.
    bool glide(const Surface& surface) {
        const Real3 a = acceleration(free_, state_);
        const Real press = -dot(surface.normal, a);
        const Real3 pull = a + surface.normal * press;
        const Real grip = surface.friction * press;
        state_.x -= surface.normal * surface.gap(state_);
        state_.v -= surface.normal * surface.speed(state_);
        const bool at_rest = largest(state_.v) <= still_;
        if (at_rest) state_.v = {};
        const Real strength = std::sqrt(squared_length(pull));
        if (at_rest && strength <= grip + 64 * epsilon * largest(a)) {
            pieces_.push_back({t_, LinearMotion{{}, 0, 0, state_}});
            return false;
        }
        const Real3 direction = normalised(at_rest ? pull : state_.v);
        const Real across = squared_length(pull - direction * dot(pull, direction));
        known_ = grip == 0 || across <= 1e-30L * strength * strength;
        if (!known_) return false;
        // The normal force holds the body on the plane, against the spring, too.
        const Real3 braked = free_.acceleration + surface.normal * press - direction * grip;
        return follow(moving_as(braked), &surface, grip > 0 ? direction : Real3{});
    }

    /// Adds a piece that ends at the first impact, or where the speed along `braked` changes sign.
    bool follow(const LinearMotion& motion, const Surface* bearing, const Real3& braked) {
        pieces_.push_back({t_, motion});
        const Real left = until_ - t_;
        // No coordinate turns twice in a quarter of a period.
        const Real part =
            motion.k > 0 ? std::numbers::pi_v<Real> / (2 * std::sqrt(motion.k)) : left;
        for (Real from = 0; from < left; from += part) {
            const Real to = std::min(from + part, left);
            std::optional<Real> end;
            bool stops = false;
            const auto keep = [&](std::optional<Real> time) {
                if (!time || (end && *end <= *time)) return false;
                end = time;
                return true;
            };
            for (const Surface& surface : surfaces_) {
                if (&surface == bearing) continue;
                const bool leaves = from == 0 && touches(surface);
                const auto gap = [&](Real t) {
                    return leaves && t == 0 ? Real(0) : surface.gap(motion.at(t));
                };
                const auto speed = [&](Real t) { return surface.speed(motion.at(t)); };
                if (leaves && gap(to) < 0 && !(speed(0) > 0)) continue;
                keep(first_negative(gap, speed, from, to));
            }
            if (largest(braked) > 0 && largest(motion.start.v) > 0) {
                const auto speed = [&](Real t) { return dot(motion.at(t).v, braked); };
                const auto slope = [&](Real t) {
                    return dot(acceleration(motion, motion.at(t)), braked);
                };
                stops = keep(first_negative(speed, slope, from, to));
            }
            if (!end) continue;
            state_ = motion.at(*end);
            if (stops) state_.v -= braked * dot(state_.v, braked);
            still_ = stops ? 1e-12L * largest(motion.start.v) : Real(0);
            t_ += *end;
            return true;
        }
        return false;
    }

    const LinearMotion& free_;
    std::vector<Surface> surfaces_;
    Real until_;
    State3 state_;
    Real t_ = 0;
    Real still_ = 0;  ///< m/s, the round-off of the speed after a stop
    int short_flights_ = 0;
    bool known_ = true;
    std::vector<LandingMotion::Piece> pieces_;
};

/// A bound of the speed of a piece that ends at `end`: without a spring the speed is largest at an
/// end, and with one v² + k·(x − rest)² never grows.
Real fastest_in(const LinearMotion& motion, const State3& end) {
    if (motion.k == 0)
        return std::sqrt(std::max(squared_length(motion.start.v), squared_length(end.v)));
    return std::sqrt(squared_length(motion.start.v) +
                     motion.k * squared_length(motion.start.x - motion.rest));
}

}  // namespace

LinearFactors factors_at(const LinearMotion& motion, Real t) {
    if (motion.k == 0)
        return {{1, 0},
                linear_drag_motion<Real>({0, 1}, 0, motion.c, t),
                linear_drag_motion<Real>({0, 0}, 1, motion.c, t)};
    // The velocity of the second motion plus c times its position is the position of the first.
    const oiler::Motion<Real> from_v = damped_oscillator<Real>(1, motion.k, motion.c, {0, 1}, t);
    return {{from_v.v + motion.c * from_v.x, -motion.k * from_v.x}, from_v, {}};
}

State3 state_after(const LinearMotion& motion, const State3& start, const LinearFactors& factors) {
    if (motion.k == 0)
        return {start.x + start.v * factors.from_v.x + motion.acceleration * factors.pushed.x,
                start.v * factors.from_v.v + motion.acceleration * factors.pushed.v};
    const Real3 from = start.x - motion.rest;
    return {motion.rest + from * factors.from_x.x + start.v * factors.from_v.x,
            from * factors.from_x.v + start.v * factors.from_v.v};
}

State3 LinearMotion::at(Real t) const { return state_after(*this, start, factors_at(*this, t)); }

LandingMotion::LandingMotion(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const Real length = i + 1 < pieces_.size() ? pieces_[i + 1].from - pieces_[i].from : 0;
        const State3 end = pieces_[i].motion.at(length);
        fastest_ = std::max(fastest_, static_cast<double>(fastest_in(pieces_[i].motion, end)));
    }
}

std::size_t LandingMotion::index_at(Real t) const {
    const auto later =
        std::ranges::upper_bound(pieces_.begin() + 1, pieces_.end(), t, {}, &Piece::from);
    return static_cast<std::size_t>(later - pieces_.begin()) - 1;
}

State3 LandingMotion::at(Real t) const {
    const Piece& piece = pieces_[index_at(t)];
    return piece.motion.at(t - piece.from);
}

const LinearMotion* LandingMotion::piece(Real from, Real to) const {
    const std::size_t index = index_at(from);
    const bool ends_before = index + 1 < pieces_.size() && pieces_[index + 1].from < to;
    return ends_before ? nullptr : &pieces_[index].motion;
}

std::optional<LandingMotion> landing_motion(const LinearMotion& free, std::span<const Plane> planes,
                                            Real radius, Real until) {
    std::vector<Surface> surfaces;
    for (const Plane& plane : planes) surfaces.push_back(surface_of(plane, radius));
    return LandingFollower(free, std::move(surfaces), until).run();
}

}  // namespace oiler::lab
