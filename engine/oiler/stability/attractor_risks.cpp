// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "oiler/core/error.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {

double Orbit::energy() const { return squared_length(v) / 2 - gm / length(r); }

double Orbit::closest() const {
    const double distance = length(r);
    const double outwards = dot(r, v);
    if (energy() >= 0 && outwards >= 0) return distance;
    const double h2 = std::max(squared_length(r) * squared_length(v) - outwards * outwards, 0.0);
    const double e = std::sqrt(std::max(1 + 2 * energy() * h2 / (gm * gm), 0.0));
    return std::min(distance, h2 / (gm * (1 + e)));
}

double Orbit::farthest() const { return -gm / energy() - closest(); }

double Orbit::period() const {
    const double axis = -gm / (2 * energy());
    return 2 * std::numbers::pi * axis * std::sqrt(axis / gm);
}

Rate scaled_rate(const Rate& rate, double factor) {
    constexpr double parts = 1e13;
    return {static_cast<std::int64_t>(parts), std::llround(rate.dt() * factor * parts)};
}

namespace {

/// Whether the energy of an orbit drifts, so that a long run loses any orbit: a slow oscillation
/// gains or loses amplitude.
bool drifts(const Method& method, Damping damping) {
    const Oscillation slow{0.01, 0};
    return std::abs(spectral_radius(step_matrices(method, damping, {&slow, 1}).front()) - 1) > 1e-8;
}

/// Runs 100 revolutions of an orbit that returns, at most 200,000 steps, and returns the revolution
/// in which the body leaves an orbit of that size: its energy changes by half of the initial
/// energy. Passages stand for the revolutions that are left. A method whose energy drifts may
/// change it by a thousandth per revolution. No local frequency decides that: steps that are too
/// long scatter the body by chance. Adds the cost in steps to `cost`.
std::optional<double> lost_revolution(const Orbit& orbit, const Method& method, Damping damping,
                                      const Rate& rate, double& cost) {
    Bodies bodies(3, Precision::double_);
    bodies.add({.position = orbit.centre + orbit.r, .velocity = orbit.v},
               Attractor{orbit.centre, orbit.gm});
    const double price = is_implicit(method) ? 8 : 1;
    const double per_revolution = orbit.period() / rate.dt();
    const auto stride = static_cast<std::int64_t>(std::max(1.0, per_revolution / 1000));
    const double most = std::min(most_revolutions * per_revolution, 200'000 / price);
    const double tolerance =
        drifts(method, damping) ? std::min(most / per_revolution / 1000, 0.5) : 0.5;
    std::int64_t inside = 0;
    for (std::int64_t tick = 0; static_cast<double>(tick) < most; tick += stride) {
        cost += static_cast<double>(stride) * price;
        const double revolution = static_cast<double>(tick + stride) / per_revolution;
        if (bodies.try_step(method, {rate, tick, stride, damping})) return revolution;
        const Orbit now{{}, bodies.position(0) - orbit.centre, bodies.velocity(0), orbit.gm};
        // Close to the attractor the energy error is large and vanishes again.
        inside = length(now.r) < orbit.farthest() / 2 ? inside + stride : 0;
        if (static_cast<double>(inside) > 2 * per_revolution) return revolution;
        if (inside == 0 && std::abs(now.energy() / orbit.energy() - 1) >= tolerance)
            return revolution;
    }
    const bool is_whole = most >= most_revolutions * per_revolution;
    return is_whole ? std::nullopt : lost_by_passages(orbit, method, damping, rate);
}

/// The attractors of a body, and whether they are all that moves it.
struct Attraction {
    std::vector<Attractor> attractors{};
    bool is_alone = true;
};

Attraction attraction_of(const Bodies& bodies, std::size_t row) {
    Attraction of;
    for_each_force_on(bodies, row, [&]<class Force>(const Force& force) {
        if constexpr (!std::is_same_v<Force, Attractor>)
            of.is_alone = of.is_alone && !acts(force);
        else if (force.gm != 0)
            of.attractors.push_back(force);
    });
    of.is_alone = of.is_alone && of.attractors.size() == 1;
    return of;
}

/// √(2gm/r³), 1/s.
double local_frequency(double gm, double distance) {
    return std::sqrt(2 * gm / distance) / distance;
}

class AttractorTest {
public:
    AttractorTest(const Bodies& bodies, Region& region, const Rate& rate)
        : bodies_(bodies), region_(region), rate_(rate) {}

    /// The worst risk of one body and its attractors.
    [[nodiscard]] std::optional<Risk> find_risk(std::size_t row, bool linked) {
        const Attraction attraction = attraction_of(bodies_, row);
        std::optional<Risk> worst;
        for (const Attractor& attractor : attraction.attractors) {
            const auto risk = find_risk(row, attractor, attraction.is_alone && !linked);
            if (risk && (!worst || risk->omega_dt > worst->omega_dt)) worst = risk;
        }
        return worst;
    }

private:
    [[nodiscard]] std::optional<Risk> find_risk(std::size_t row, const Attractor& attractor,
                                                bool is_alone) {
        const Orbit orbit{attractor.centre, bodies_.position(row) - attractor.centre,
                          bodies_.velocity(row), attractor.gm};
        const double distance = std::sqrt(squared_length(orbit.r));
        if (!std::isfinite(distance)) return std::nullopt;
        Risk risk{.row = row, .omega_dt = INFINITY, .of = Risk::Of::on_attractor};
        if (distance == 0) return risk;
        if (!(attractor.gm > 0)) return std::nullopt;
        const bool is_orbit = is_alone && std::isfinite(squared_length(orbit.v));
        risk.at = is_orbit ? orbit.closest() : distance;
        risk.of = risk.at < distance * (1 - 1e-6) ? Risk::Of::periapsis : Risk::Of::attractor;
        risk.omega_dt = local_frequency(attractor.gm, risk.at) * rate_.dt();
        if (is_orbit && orbit.energy() < 0 && std::isfinite(risk.omega_dt)) {
            const auto lost = revolution_of_loss(orbit, risk.omega_dt);
            if (!lost) return std::nullopt;
            risk.orbit = orbit;
            risk.revolution = *lost;
        } else if (is_slow(risk.omega_dt)) {
            return std::nullopt;
        }
        return is_orbit && lands_before(row, orbit) ? std::nullopt : std::optional(risk);
    }

    /// Whether an obstacle keeps the body away from the attractor.
    [[nodiscard]] bool lands_before(std::size_t row, const Orbit& orbit) {
        const Steps steps{rate_, 0, 1, region_.damping()};
        const auto reached =
            distance_of_landing(bodies_, row, orbit, region_.method(), steps, landing_cost_);
        return reached && is_slow(local_frequency(orbit.gm, *reached) * rate_.dt());
    }

    /// Whether the local frequency is in the method's region. Below ω·dt = 1 a passage is too short
    /// for a slow gain of energy.
    [[nodiscard]] bool is_slow(double omega_dt) {
        return omega_dt <= 1 || region_.contains({omega_dt, 0});
    }
    /// The revolution in which the body is lost, 0 if unknown; empty if it stays.
    [[nodiscard]] std::optional<double> revolution_of_loss(const Orbit& orbit, double omega_dt) {
        constexpr double most_cost = 2e6;
        constexpr double certainly_slow = 0.15;
        if (omega_dt < certainly_slow && !drifts(region_.method(), region_.damping()))
            return std::nullopt;
        if (cost_ <= most_cost)
            return lost_revolution(orbit, region_.method(), region_.damping(), rate_, cost_);
        return is_slow(omega_dt) ? std::nullopt : std::optional<double>(0);
    }

    const Bodies& bodies_;
    Region& region_;
    Rate rate_;
    double cost_ = 0;  ///< of all trials, in steps
    double landing_cost_ = 0;
};

}  // namespace

void add_attractor_risks(const Bodies& bodies, Region& region, const Rate& rate,
                         std::vector<Risk>& risks) {
    if (!any_body_has(bodies, []<class Force>() { return std::is_same_v<Force, Attractor>; }))
        return;
    const std::vector<bool> linked = bodies.linked_rows();
    AttractorTest test(bodies, region, rate);
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (auto risk = test.find_risk(row, linked[row])) risks.push_back(std::move(*risk));
}

namespace {

/// The farthest point of the first revolution, m, if it is wrong by a fifth.
std::optional<double> wrong_farthest(const Orbit& orbit, const Method& method, const Steps& steps) {
    constexpr double most = 100'000;
    const double count = 1.25 * orbit.period() / steps.rate.dt();
    if (!(count < most)) return std::nullopt;
    Bodies bodies(3, Precision::double_);
    bodies.add({.position = orbit.centre + orbit.r, .velocity = orbit.v},
               Attractor{orbit.centre, orbit.gm});
    double farthest = length(orbit.r);
    for (std::int64_t tick = 0; static_cast<double>(tick) < count; ++tick) {
        if (bodies.try_step(method, {steps.rate, tick, 1, steps.damping})) return INFINITY;
        farthest = std::max(farthest, length(bodies.position(0) - orbit.centre));
    }
    const bool is_wrong = std::abs(farthest / orbit.farthest() - 1) > 0.2;
    return is_wrong ? std::optional(farthest) : std::nullopt;
}

/// The orbit of a body that one attractor alone holds.
std::optional<Orbit> orbit_of(const Bodies& bodies, std::size_t row) {
    const Attraction attraction = attraction_of(bodies, row);
    if (!attraction.is_alone) return std::nullopt;
    const Attractor& attractor = attraction.attractors.front();
    const Orbit orbit{attractor.centre, bodies.position(row) - attractor.centre,
                      bodies.velocity(row), attractor.gm};
    const bool returns = attractor.gm > 0 && orbit.energy() < 0 && orbit.closest() > 0;
    return returns ? std::optional(orbit) : std::nullopt;
}

/// The first rate, in steps of 5 %, that keeps the farthest point and follows the orbit.
std::string rate_for(const Orbit& orbit, const Method& method, const Steps& steps) {
    const Damping damping = steps.damping.value_or(method.damping);
    for (double hertz = std::ceil(1 / steps.rate.dt()) + 1; hertz <= highest_rate;
         hertz = std::ceil(1.05 * hertz)) {
        const Steps tried{{std::llround(hertz)}, 0, 1, steps.damping};
        if (!wrong_farthest(orbit, method, tried) && follows(orbit, method, damping, tried.rate))
            return fmt::format("rate ≥ {:.0f} Hz", hertz);
    }
    for (const char* name : {"velocity_verlet", "rk4", "blanes_moan_srkn6b"}) {
        const Method& other = find_method(name);
        if (!wrong_farthest(orbit, other, {steps.rate}) &&
            follows(orbit, other, other.damping, steps.rate))
            return fmt::format("take {}", name);
    }
    return "no rate or method that was tried follows it: give the body another position or "
           "velocity";
}

}  // namespace

void add_orbit_distortions(const Bodies& bodies, const Method& method, const Steps& steps,
                           std::vector<Risk>& risks) {
    if (!any_body_has(bodies, []<class Force>() { return std::is_same_v<Force, Attractor>; }))
        return;
    const std::vector<bool> linked = bodies.linked_rows();
    double cost = 0;
    for (std::size_t row = 0; row < bodies.size() && risks.size() < most_distortions; ++row) {
        const auto orbit = linked[row] ? std::nullopt : orbit_of(bodies, row);
        const auto farthest = orbit ? wrong_farthest(*orbit, method, steps) : std::nullopt;
        if (!farthest || distance_of_landing(bodies, row, *orbit, method, steps, cost)) continue;
        risks.push_back(
            {.row = row,
             .of = Risk::Of::told,
             .message = fmt::format("attractor of body {{}}: {} leads it as far as {:.3g} m from "
                                    "the attractor instead of {:.3g} m: {}",
                                    method.name, *farthest, orbit->farthest(),
                                    rate_for(*orbit, method, steps))});
    }
}

bool keeps_shape(const Orbit& orbit, const Method& method, const Steps& steps) {
    return !wrong_farthest(orbit, method, steps);
}

bool follows(const Orbit& orbit, const Method& method, Damping damping, const Rate& rate) {
    double cost = 0;
    return !lost_revolution(orbit, method, damping, rate, cost);
}

double orbit_limit(const Orbit& orbit, const Method& method, Damping damping, const Rate& rate) {
    const Descent descent = descend(0.85, 1e-4, [&](double factor) {
        return follows(orbit, method, damping, scaled_rate(rate, factor));
    });
    return descent.found ? descent.stable : 0;
}

}  // namespace oiler
