// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "oiler/stability/modes.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

/// Up to this number of freedoms, the step matrix of unevenly damped bodies is computed.
constexpr std::size_t most_dense_freedoms = 30;
/// Up to this number, all oscillations of evenly damped bodies are computed.
constexpr std::size_t most_modes = 100;
/// Up to this number, a warning of damped bodies is confirmed with the step matrix, in 0.2 s at
/// most.
constexpr std::size_t most_confirmed_freedoms = 100;
/// Growth per step that is not distinguished from round-off, see spectral_radius_of_step.
constexpr double radius_round_off = 1e-6;

bool is_stable_step(const Component& component, const Method& method, Damping damping, double dt) {
    return spectral_radius_of_step(component, method, damping, dt) <= 1 + radius_round_off;
}

/// An upper bound of the highest eigenvalue: no mode is faster than the stiffest coupling with all
/// couplings at its two ends (Anderson and Morley, Eigenvalues of the Laplacian of a graph, 1985,
/// with masses).
double highest_bound(const Component& component, const std::vector<Coupling>& couplings) {
    std::vector<double> sum(component.rows.size());
    const auto each_end = [&](const Coupling& coupling, auto f) {
        f(coupling.a);
        if (coupling.b != Coupling::ground) f(coupling.b);
    };
    for (const Coupling& coupling : couplings)
        each_end(coupling, [&](std::size_t end) {
            const double root = component.inverse_root_mass[end];
            sum[end] += (coupling.along + coupling.all) * root * root;
        });
    double highest = 0;
    for (const Coupling& coupling : couplings) {
        double both = 0;
        each_end(coupling, [&](std::size_t end) { both += sum[end]; });
        highest = std::max(highest, both);
    }
    return highest;
}

/// The stability of one component with a method.
class ComponentTest {
public:
    ComponentTest(Component component, Region& region, double dt)
        : component_(std::make_shared<const Component>(std::move(component))),
          region_(region),
          dt_(dt),
          split_(splits_dampers(region.method(), region.damping())) {}

    [[nodiscard]] std::optional<Risk> find_risk() {
        if (is_implicit(region_.method()) || region_.contains_all_up_to(upper_bound()))
            return std::nullopt;
        const bool is_even = has_even_drag() && component_->dampers.empty();
        if (component_->freedoms() > (is_even ? most_modes : most_dense_freedoms))
            add_ritz_pairs();
        else if (is_even)
            add_modes();
        else
            return find_exact_risk();
        const auto all = [&](const ScaledOscillation& of) { return region_.contains(of); };
        if (std::all_of(oscillations_.begin(), oscillations_.end(), all)) return std::nullopt;
        if (is_kept_stable_by_dampers()) return std::nullopt;
        return risk_at(worst_outside());
    }

private:
    [[nodiscard]] ScaledOscillation upper_bound() const {
        const double most_drag =
            *std::max_element(component_->drag.begin(), component_->drag.end());
        const double k = highest_bound(*component_, component_->springs);
        const double c = most_drag + highest_bound(*component_, component_->dampers);
        return {std::sqrt(k) * dt_, c * dt_};
    }
    [[nodiscard]] bool has_even_drag() const {
        const double first = component_->drag.front();
        return std::all_of(component_->drag.begin(), component_->drag.end(),
                           [&](double drag) { return drag == first; });
    }

    void add(double k, double c, WeightedVectors vector) {
        oscillations_.push_back({std::sqrt(std::max(k, 0.0)) * dt_, std::max(c, 0.0) * dt_});
        vectors_.push_back(std::move(vector));
    }
    void add_modes() {
        for (const Mode& mode : stiffness_modes(*component_))
            add(mode.value, component_->drag.front(), to_vectors(mode.vector, *component_));
    }
    /// Adds the Rayleigh quotients of a vector.
    void add_quotients(const WeightedVectors& u) {
        add(quotient(*component_, {1, 0, split_}, u), quotient(*component_, {0, 1, split_}, u), u);
    }

    /// Adds the fastest oscillation and, if damping is uneven, the extremes of stiffness and
    /// damping together, all relative to their ranges.
    void add_ritz_pairs() {
        const RitzPair stiffest = highest_ritz_pair(*component_, {1, 0, split_});
        const double k = stiffest.value + stiffest.residual;
        add(k, quotient(*component_, {0, 1, split_}, stiffest.vector), stiffest.vector);
        if (has_even_drag() && (split_ || component_->dampers.empty())) return;
        const RitzPair most_damped = highest_ritz_pair(*component_, {0, 1, split_});
        add_quotients(most_damped.vector);
        if (!(k > 0) || !(most_damped.value > 0)) return;
        for (const double part : {-4.0, -1.0, -0.25, 0.25, 1.0, 4.0})
            add_quotients(
                highest_ritz_pair(*component_, {1 / k, part / most_damped.value, split_}).vector);
    }

    [[nodiscard]] std::optional<Risk> find_exact_risk() {
        const auto holds = [&](double part) {
            return is_stable_step(*component_, region_.method(), region_.damping(), dt_ * part);
        };
        if (std::all_of(std::begin(tested_steps), std::end(tested_steps), holds))
            return std::nullopt;
        const Mode stiffest = stiffness_modes(*component_).back();
        const WeightedVectors u = to_vectors(stiffest.vector, *component_);
        add(stiffest.value, quotient(*component_, {0, 1, split_}, u), u);
        const Mode damped = fastest_damping(*component_, split_);
        add_quotients(to_vectors(damped.vector, *component_));
        Risk risk = risk_at(worst_outside());
        risk.component = component_;
        return risk;
    }

    /// Dampers in half-steps around the step raise the limit; the oscillations leave them out.
    [[nodiscard]] bool is_kept_stable_by_dampers() const {
        return split_ && !component_->dampers.empty() &&
               component_->freedoms() <= most_confirmed_freedoms &&
               is_stable_step(*component_, region_.method(), region_.damping(), dt_);
    }

    /// The largest oscillation outside the region; the first one if all are inside.
    [[nodiscard]] std::size_t worst_outside() {
        std::size_t worst = 0;
        double largest = 0;
        for (std::size_t i = 0; i < oscillations_.size(); ++i) {
            if (size(oscillations_[i]) <= largest || region_.contains(oscillations_[i])) continue;
            worst = i;
            largest = size(oscillations_[i]);
        }
        return worst;
    }

    [[nodiscard]] Risk risk_at(std::size_t i) const {
        Risk risk{.row = component_->rows.front(),
                  .omega_dt = oscillations_[i].omega_dt,
                  .damping_dt = oscillations_[i].damping_dt,
                  .oscillations = oscillations_};
        if (const Coupling* const most = component_->most_strained(vectors_[i])) {
            risk.row = component_->rows[most->a];
            risk.is_rope = most->is_rope;
            if (most->b != Coupling::ground) risk.linked = component_->rows[most->b];
        }
        return risk;
    }

    std::shared_ptr<const Component> component_;
    Region& region_;
    double dt_;
    bool split_;
    std::vector<ScaledOscillation> oscillations_{};
    std::vector<WeightedVectors> vectors_{};
};

/// Tests the stability of a component with the region's method. The test of few bodies is exact: by
/// the eigenvalues of the stiffness matrix up to 100 freedoms if damping is even, else by those of
/// the step up to 30. Larger components are tested at their fastest oscillation and, if damping is
/// uneven, where stiffness and damping are most uneven.
std::optional<Risk> find_risk(Component component, Region& region, double dt) {
    return ComponentTest(std::move(component), region, dt).find_risk();
}

/// The factor on dt up to which the steps of a component are stable, to 7 digits; 0 if it is below
/// 10⁻⁷.
double component_limit(const Component& component, const Method& method, Damping damping,
                       double dt) {
    const auto is_stable = [&](double factor) {
        return is_stable_step(component, method, damping, dt * factor);
    };
    const Descent descent = descend(1, 1e-7, is_stable);
    return descent.found ? edge_between(descent.stable, descent.unstable, 1e-7, is_stable) : 0;
}

ScaledOscillation scaled(const Oscillation& of, double dt) {
    return {std::sqrt(of.k) * dt, of.c * dt};
}

/// The largest ω·dt and c·dt of the springs and dampers that act in all directions.
ScaledOscillation largest_of(const std::vector<OwnMotion>& own, double dt) {
    ScaledOscillation largest;
    for (const auto& [of, all, has_lines] : own) {
        if (of.k < 0 || of.c < 0) continue;
        const auto [omega_dt, damping_dt] = scaled(of, dt);
        largest.omega_dt = std::max(largest.omega_dt, omega_dt);
        largest.damping_dt = std::max(largest.damping_dt, damping_dt);
    }
    return largest;
}

/// The factor below a limit at which the region contains all oscillations: on the edge of stability
/// amplitudes grow a hundredfold.
double inner_limit(double limit, const std::vector<ScaledOscillation>& all, Region& region) {
    const auto is_inside = [&](double factor) {
        return std::ranges::all_of(all, [&](const ScaledOscillation& of) {
            return region.contains({of.omega_dt * factor, of.damping_dt * factor});
        });
    };
    if (is_inside(limit * (1 - 1e-9)) || !is_inside(0.99 * limit)) return limit;
    return edge_between(0.99 * limit, limit, 1e-9, is_inside);
}

/// The rate at which wind damps slow motions across it, 1/s, which is half of that along it.
double damping_by_wind(const Bodies& bodies, std::size_t row) {
    double rate = 0;
    for_each_force_on(bodies, row, [&]<class Force>(const Force& force) {
        if constexpr (DragsInAir<Force>) {
            const auto [coefficient, air] = force.air_drag();
            rate += coefficient * length(air);
        }
    });
    return rate;
}

}  // namespace

void add_spring_risks(const Bodies& bodies, Region& region, double dt, std::vector<Risk>& risks) {
    const std::vector<OwnMotion> own = own_motions(bodies);
    const std::vector<bool> linked = bodies.linked_rows();
    const bool all_inside = region.contains_all_up_to(largest_of(own, dt));
    for (std::size_t row = 0; row < own.size(); ++row) {
        if (linked[row]) continue;
        if (own[row].has_lines) {
            if (auto risk = find_risk(component_of_row(bodies, row), region, dt))
                risks.push_back(std::move(*risk));
            continue;
        }
        // Negative stiffness or damping diverges by itself with any method.
        if (all_inside || own[row].linear.k < 0 || own[row].linear.c < 0) continue;
        const ScaledOscillation of = scaled(own[row].linear, dt);
        const double wind = damping_by_wind(bodies, row) * dt;
        if (!region.contains(of) && !region.contains({of.omega_dt, of.damping_dt + wind}))
            risks.push_back({.row = row, .omega_dt = of.omega_dt, .damping_dt = of.damping_dt});
    }
    if (bodies.link_count() == 0) return;
    for (Component& component : linked_components(bodies, component_labels(bodies)))
        if (auto risk = find_risk(std::move(component), region, dt))
            risks.push_back(std::move(*risk));
}

double spring_limit(const Risk& risk, const Method& method, Damping damping, double dt) {
    if (risk.component) return component_limit(*risk.component, method, damping, dt);
    std::vector<ScaledOscillation> all = risk.oscillations;
    all.push_back({risk.omega_dt, risk.damping_dt});
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return size(a) > size(b); });
    double limit = std::numeric_limits<double>::infinity();
    Region region(method, damping);
    for (const ScaledOscillation& of : all) {
        // Limits are slow to find. Most oscillations are stable below the limit of the largest.
        const double below = std::min(limit, 1.0) * (1 - 1e-9);
        if (std::isfinite(limit) && region.contains({of.omega_dt * below, of.damping_dt * below}))
            continue;
        if (size(of) > 0)
            limit =
                std::min(limit, stability_limit(method, damping, unit_oscillation(of)) / size(of));
    }
    return std::isfinite(limit) ? inner_limit(limit, all, region) : limit;
}

}  // namespace oiler
