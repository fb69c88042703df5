// SPDX-License-Identifier: MIT
#include "oiler/stability/attractor_risks.hpp"

#include <cmath>

namespace oiler {
namespace {

/// The attractors of a body, and whether they are all that moves it.
struct Attraction {
    std::vector<Attractor> attractors{};
    bool is_alone = true;
};

Attraction attraction_of(const Bodies& bodies, std::size_t row) {
    Attraction of;
    for (std::size_t i = 0; i < bodies.most_forces_of_a_kind(); ++i) {
        for_each_given(bodies.forces_per_mass(row, i), [&]<class Force>(const Force& force) {
            if constexpr (!std::is_same_v<Force, Attractor>)
                of.is_alone = of.is_alone && !acts(force);
            else if (force.gm != 0)
                of.attractors.push_back(force);
        });
    }
    of.is_alone = of.is_alone && of.attractors.size() == 1;
    return of;
}

bool has_attractors(const Bodies& bodies) {
    for (const Stored& stored : bodies.stored())
        if (stored.of == Attractor::name && stored.rows > 0) return true;
    return false;
}

/// Methods that gain energy at any rate lose an orbit sooner or later: they may change its energy
/// by 10 %. The energy error of others is bounded.
double orbit_tolerance(Region& region) { return region.contains({0.1, 0}) ? 1 : 0.1; }

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
        if (is_implicit(region_.method()) || !(attractor.gm > 0)) return std::nullopt;
        const bool is_orbit = is_alone && std::isfinite(squared_length(orbit.v));
        risk.at = is_orbit ? orbit.closest() : distance;
        risk.of = risk.at < distance * (1 - 1e-6) ? Risk::Of::periapsis : Risk::Of::attractor;
        risk.omega_dt = std::sqrt(2 * attractor.gm / risk.at) / risk.at * rate_.dt();
        if (is_orbit && orbit.energy() < 0 && std::isfinite(risk.omega_dt)) {
            if (follows(orbit, risk.omega_dt)) return std::nullopt;
            risk.orbit = orbit;
        } else if (is_slow(risk.omega_dt)) {
            return std::nullopt;
        }
        return risk;
    }

    /// Whether the local frequency is in the method's region. Below ω·dt = 1 a passage is too short
    /// for a slow gain of energy.
    [[nodiscard]] bool is_slow(double omega_dt) {
        return omega_dt <= 1 || region_.contains({omega_dt, 0});
    }
    [[nodiscard]] bool follows(const Orbit& orbit, double omega_dt) {
        constexpr std::int64_t most_steps_of_trials = 2'000'000;
        constexpr double certainly_slow = 0.15;
        const bool gains = !region_.contains({0.1, 0});
        if (!gains && omega_dt < certainly_slow) return true;
        if (steps_of_trials_ > most_steps_of_trials) return is_slow(omega_dt);
        return is_followed(orbit, region_.method(), region_.damping(), rate_,
                           orbit_tolerance(region_), steps_of_trials_);
    }

    const Bodies& bodies_;
    Region& region_;
    Rate rate_;
    std::int64_t steps_of_trials_ = 0;
};

}  // namespace

void add_attractor_risks(const Bodies& bodies, Region& region, const Rate& rate,
                         std::vector<Risk>& risks) {
    if (!has_attractors(bodies)) return;
    const std::vector<bool> linked = bodies.linked_rows();
    AttractorTest test(bodies, region, rate);
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (auto risk = test.find_risk(row, linked[row])) risks.push_back(std::move(*risk));
}

double orbit_limit(const Orbit& orbit, const Method& method, Damping damping, const Rate& rate) {
    constexpr double ratio = 0.85;
    constexpr double least = 1e-4;
    Region region(method, damping);
    const double tolerance = orbit_tolerance(region);
    std::int64_t steps = 0;
    double limit = 0;
    int in_a_row = 0;
    for (double factor = ratio; in_a_row < 4; factor *= ratio) {
        if (factor < least) return 0;
        const bool follows =
            is_followed(orbit, method, damping, scaled_rate(rate, factor), tolerance, steps);
        if (follows && in_a_row == 0) limit = factor;
        in_a_row = follows ? in_a_row + 1 : 0;
    }
    return limit;
}

}  // namespace oiler
