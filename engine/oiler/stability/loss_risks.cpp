// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "oiler/core/error.hpp"
#include "oiler/stability/modes.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

constexpr double longest = 20;  ///< s, in which a loss is warned of

/// An oscillation of a component at the start.
struct Part {
    double omega = 0;    ///< rad/s
    double energy = 0;   ///< J
    double damping = 0;  ///< 1/s, by which the energy falls
    WeightedVectors vector{};
};

/// The rates at which the method's error takes the energies of undamped oscillations, 1/s.
std::vector<double> losses_of(const std::vector<Part>& parts, const Method& method, Damping damping,
                              double dt) {
    std::vector<Oscillation> steps;
    for (const Part& part : parts) steps.push_back({part.omega * dt * part.omega * dt, 0});
    std::vector<double> losses;
    for (const StepMatrix& step : step_matrices(method, damping, steps)) {
        const double radius = static_cast<double>(std::log(spectral_radius(step)));
        losses.push_back(std::clamp(-2 * radius / dt, 0.0, 1e9));
    }
    return losses;
}

/// The least part of the energy at the start whose loss is told.
constexpr double least_part = 0.05;

/// The oscillations of which the method takes more than half as much as damping does.
std::vector<bool> taken_by_method(const std::vector<Part>& parts,
                                  const std::vector<double>& losses) {
    std::vector<bool> taken;
    for (std::size_t i = 0; i < parts.size(); ++i)
        taken.push_back(losses[i] > parts[i].damping / 2);
    return taken;
}

/// The time in which the method takes half of the energy that damping leaves of these oscillations,
/// if they are a twentieth of all: those that damping ends sooner hide no loss of the others.
std::optional<double> half_time(const std::vector<Part>& parts, const std::vector<double>& losses) {
    const std::vector<bool> taken = taken_by_method(parts, losses);
    double all = 0;
    for (const Part& part : parts) all += part.energy;
    const auto left = [&](double time, bool by_method) {
        double sum = 0;
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (taken[i])
                sum += parts[i].energy *
                       std::exp(-time * (parts[i].damping + (by_method ? losses[i] : 0)));
        return sum;
    };
    const auto lasts = [&](double time) { return left(time, true) > left(time, false) / 2; };
    if (!(left(0, false) > least_part * all) || lasts(longest)) return std::nullopt;
    return edge_between(0, longest, 1e-6, lasts);
}

class LossTest {
public:
    LossTest(const Bodies& bodies, const Method& method, const Steps& steps,
             std::vector<Vec3> accelerations)
        : bodies_(bodies),
          method_(method),
          steps_(steps),
          damping_(steps.damping.value_or(method.damping)),
          accelerations_(std::move(accelerations)) {}

    [[nodiscard]] std::optional<Risk> find_risk(const Component& component) const {
        constexpr std::size_t most_modes = 100;
        if (component.freedoms() > most_modes || meets_obstacles(component)) return std::nullopt;
        const std::vector<Part> parts = parts_of(component);
        if (parts.empty()) return std::nullopt;
        const double dt = steps_.rate.dt();
        const std::vector<double> losses = losses_of(parts, method_, damping_, dt);
        const auto time = half_time(parts, losses);
        if (!time) return std::nullopt;
        std::size_t most = 0;
        const std::vector<bool> is_taken = taken_by_method(parts, losses);
        const auto taken = [&](std::size_t i) {
            return is_taken[i] ? parts[i].energy * -std::expm1(-*time * losses[i]) : 0;
        };
        for (std::size_t i = 1; i < parts.size(); ++i)
            if (taken(i) > taken(most)) most = i;
        return risk_of(component, parts, most, *time);
    }

private:
    [[nodiscard]] bool meets_obstacles(const Component& component) const {
        return bodies_.has_obstacles() && std::ranges::any_of(component.rows, [&](std::size_t row) {
                   return bodies_.contact(row).has_value();
               });
    }
    /// The component of some vectors of the rows along a mode, times √mass.
    template <class VectorOfRow>
    [[nodiscard]] static double along(const Component& component, const WeightedVectors& mode,
                                      VectorOfRow vector_of_row) {
        double sum = 0;
        for (std::size_t i = 0; i < mode.size(); ++i)
            sum += dot(mode[i], vector_of_row(component.rows[i])) / component.inverse_root_mass[i];
        return sum;
    }
    /// The oscillations of more than a millionth of the coordinates.
    [[nodiscard]] std::vector<Part> parts_of(const Component& component) const {
        double coordinate = 0;
        double mass = 0;
        for (const std::size_t row : component.rows) {
            coordinate = std::max(coordinate, largest(bodies_.position(row)));
            mass += bodies_.mass(row);
        }
        std::vector<Part> parts;
        for (const Mode& mode : stiffness_modes(component)) {
            if (!(mode.value > 0)) continue;
            Part part{.omega = std::sqrt(mode.value), .vector = to_vectors(mode.vector, component)};
            const double v = along(component, part.vector,
                                   [&](std::size_t row) { return bodies_.velocity(row); });
            const double a =
                along(component, part.vector, [&](std::size_t row) { return accelerations_[row]; });
            part.energy = (v * v + a * a / mode.value) / 2;
            if (!(std::sqrt(2 * part.energy / mass) > 1e-6 * coordinate * part.omega)) continue;
            part.damping = std::max(quotient(component, {0, 1, false}, part.vector), 0.0);
            parts.push_back(std::move(part));
        }
        return parts;
    }

    /// The lowest rate at which the loss takes longer.
    [[nodiscard]] std::optional<double> rate_for(const std::vector<Part>& parts) const {
        const auto keeps = [&](double dt) {
            return !half_time(parts, losses_of(parts, method_, damping_, dt));
        };
        if (!keeps(1 / highest_rate)) return std::nullopt;
        const double dt = edge_between(1 / highest_rate, steps_.rate.dt(), 1e-3, keeps);
        return std::ceil(1 / dt);
    }
    [[nodiscard]] std::string remedy_of(const std::vector<Part>& parts) const {
        const auto rate = rate_for(parts);
        const std::string hertz = rate ? fmt::format("rate ≥ {:.0f} Hz", *rate) : "";
        for (const char* name : {"velocity_verlet", "implicit_midpoint"})
            if (holds(bodies_, find_method(name), {steps_.rate, steps_.first, steps_.count}))
                return fmt::format("take {}{}{}", name, rate ? ", or " : "", hertz);
        return rate ? hertz : "take another method";
    }
    [[nodiscard]] Risk risk_of(const Component& component, const std::vector<Part>& parts,
                               std::size_t most, double time) const {
        Risk risk{.row = component.rows.front(), .of = Risk::Of::told};
        if (const Coupling* const spring = component.most_strained(parts[most].vector)) {
            risk.row = component.rows[spring->a];
            if (spring->b != Coupling::ground) risk.linked = component.rows[spring->b];
        }
        risk.message = fmt::format(
            "{}: {} takes half of the energy of its oscillation of {:.3g} Hz in {:.3g} s: {}",
            risk.linked ? "link of bodies {} and {}" : "spring of body {}", method_.name,
            parts[most].omega / (2 * std::numbers::pi), time, remedy_of(parts));
        return risk;
    }

    const Bodies& bodies_;
    const Method& method_;
    Steps steps_;
    Damping damping_;
    std::vector<Vec3> accelerations_;
};

bool has_springs(const Bodies& bodies) {
    return bodies.link_count() > 0 || any_body_has(bodies, []<class Force>() {
               return LineSpring<Force> || std::is_same_v<Force, Spring>;
           });
}

/// The energies of a run and of one with finer steps, step by step, J.
struct Energies {
    std::vector<double> run{};
    std::vector<double> fine{};
    /// Of the finer run from a step to the end: the range of its kinetic energy, or a quarter of
    /// it. The last quarter of the run counts as a whole.
    std::vector<double> motion{};

    [[nodiscard]] double loss(std::size_t tick) const { return fine[tick] - run[tick]; }
};

std::vector<double> motions_of(std::vector<double> kinetic) {
    double least = INFINITY;
    double most = 0;
    for (std::size_t i = kinetic.size(); i-- > 0;) {
        least = std::min(least, kinetic[i]);
        most = std::max(most, kinetic[i]);
        kinetic[i] = std::max(most - least, most / 4);
    }
    const std::size_t last = kinetic.size() * 3 / 4;
    std::fill(kinetic.begin() + static_cast<std::ptrdiff_t>(last), kinetic.end(), kinetic[last]);
    return kinetic;
}

/// Steps for 20 s, or as long as takes some tens of milliseconds; empty if a run diverges.
Energies energies_of(const Bodies& bodies, const Method& method, const Steps& steps) {
    constexpr std::int64_t finer = 8;
    constexpr double most_work = 400'000;
    const double work = static_cast<double>(bodies.size() + 2 * bodies.link_count()) *
                        (is_implicit(method) ? 10 : 1);
    const double count = std::min(longest / steps.rate.dt(), most_work / work);
    Bodies run = bodies;
    Bodies fine = bodies;
    Energies all;
    std::vector<double> kinetic;
    for (std::int64_t tick = 0; static_cast<double>(tick) <= count; ++tick) {
        const Energy energy = fine.energy();
        all.run.push_back(run.energy().total());
        all.fine.push_back(energy.total());
        kinetic.push_back(energy.kinetic);
        if (run.try_step(method, {steps.rate, tick, 1, steps.damping}) ||
            fine.try_step(find_method("pefrl"),
                          {{steps.rate.steps * finer, steps.rate.seconds}, tick * finer, finer}))
            return {};
    }
    all.motion = motions_of(std::move(kinetic));
    return all;
}

/// The first and the last of the steps in which the method takes half of the energy of a motion of
/// which damping leaves a quarter or more. Motions that damping ended before do not count.
std::optional<std::pair<std::size_t, std::size_t>> steps_of_loss(const Energies& of) {
    std::size_t from = 0;
    for (std::size_t tick = 0; tick < of.run.size(); ++tick) {
        const double half = of.motion[tick] / 2;
        if (!(half > least_part * of.motion.front() / 2)) return std::nullopt;
        while (of.motion[from] > 8 * half) ++from;
        const double loss = std::min(of.loss(tick), of.loss(tick) - of.loss(from));
        if (loss >= half && loss > 1e-9 * std::abs(of.fine[tick])) return std::pair(from, tick);
    }
    return std::nullopt;
}

/// Adds a loss by half of the energy of the motion, by more than half of what damping takes, in a
/// trial of bodies whose forces are not linear.
void add_loss_of_trial(const Bodies& bodies, const Method& method, const Steps& steps,
                       std::vector<Risk>& risks) {
    const auto loss = steps_of_loss(energies_of(bodies, method, steps));
    if (!loss) return;
    const bool may_verlet = holds(bodies, find_method("velocity_verlet"), {steps.rate});
    risks.push_back(
        {.row = 0,
         .of = Risk::Of::told,
         .message = fmt::format(
             "{}: {} takes half of the energy of the motion in {:.3g} s: take {}",
             bodies.size() == 1 ? "spring of body {}" : "springs of all bodies", method.name,
             static_cast<double>(loss->second - loss->first) * steps.rate.dt(),
             may_verlet ? "velocity_verlet" : "a higher rate")});
}

}  // namespace

void add_oscillation_losses(const Bodies& bodies, const Method& method, const Steps& steps,
                            std::vector<Risk>& risks) {
    if (method.symplectic || std::holds_alternative<ExactFlow>(method.rule)) return;
    constexpr std::size_t most_tried = 64;
    const bool is_tried =
        bodies.size() <= most_tried && !has_sources(bodies) && has_springs(bodies);
    if (is_tried && !is_linear(bodies) && !meets_obstacles(bodies))
        return add_loss_of_trial(bodies, method, steps, risks);
    std::vector<Vec3> accelerations = accelerations_at_rest(bodies);
    if (accelerations.empty()) return;
    const LossTest test(bodies, method, steps, std::move(accelerations));
    const std::vector<bool> linked = bodies.linked_rows();
    const auto add = [&](const Component& component) {
        if (risks.size() >= most_distortions) return;
        if (auto risk = test.find_risk(component)) risks.push_back(std::move(*risk));
    };
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (!linked[row]) add(component_of_row(bodies, row));
    if (bodies.link_count() == 0) return;
    for (const Component& component : linked_components(bodies, component_labels(bodies)))
        add(component);
}

}  // namespace oiler
