// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/judge.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/lab/reference/path.hpp"
#include "oiler/lab/sweep/drawn_error.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::lab {
namespace {

/// A run whose error exceeds this multiple of the extent counts as unstable.
constexpr double lost = 10;

constexpr std::int64_t short_steps_rate = 1'000'000;  // Hz
/// Below this fraction of the largest coordinate, an error is never a loss of stability.
constexpr double negligible = 1e-9;

/// The times at which a run's oscillation crosses its level upwards, on the drawn lines.
class Crossings {
public:
    explicit Crossings(const std::optional<PeriodicCoordinate>& oscillation)
        : oscillation_(oscillation) {}

    void add(double t, const State3& state) {
        path_.t = {path_.t.back(), t};
        path_.x = {path_.x.back(), static_cast<double>(state.x[oscillation_->axis])};
        was_below_ = was_below_ || path_.x[0] < oscillation_->level - oscillation_->band;
        if (!was_below_ || !(path_.x[0] < oscillation_->level && path_.x[1] >= oscillation_->level))
            return;
        last_ = path_.time(1, path_.crossing(1, oscillation_->level));
        was_below_ = false;
        if (++count_ <= oscillation_->crossings.size())
            phase_ = 360 * (oscillation_->crossings[count_ - 1] - last_) / oscillation_->period;
    }
    void start(const State3& state) {
        path_ = {.t = {0}, .x = {static_cast<double>(state.x[oscillation_->axis])}};
    }
    /// Degrees, at the last crossing that both have.
    [[nodiscard]] double phase() const { return phase_; }

private:
    const std::optional<PeriodicCoordinate>& oscillation_;
    Path path_;
    bool was_below_ = false;
    std::size_t count_ = 0;
    double last_ = 0;
    double phase_ = unknown;
};

/// A run beside its reference, step by step.
class RunErrors {
public:
    RunErrors(const Scene& scene, const Settings& settings, const Reference& reference,
              const JudgeOptions& options)
        : reference_(reference),
          options_(options),
          world_(make_world(scene, settings, reference.start)),
          true_energy_(scene, reference),
          true_at_(reference.motion->at_ticks(settings.stepping.rate.steps)),
          floor_(reference.floor()),
          drawn_(*reference.motion, floor_.position, options.display),
          crossings_(reference.oscillation),
          run_(world_.body_count()),
          true_(run_.size()) {
        world_.require_applicable();
        read();
        lost_error_ = lost * reference.extent;
        for (const State3& state : true_)
            lost_error_ = std::max(lost_error_, negligible * static_cast<double>(largest(state.x)));
        if (reference.oscillation) crossings_.start(run_[reference.oscillation->row]);
        take_state();
    }

    /// Returns false if the run is lost.
    bool run() {
        const double until = reference_.meaningful_until;
        for (std::int64_t part = 1; part <= growth_parts; ++part) {
            const double end = part == growth_parts ? until : until * part / growth_parts;
            while (world_.time() < end && !ends_early())
                if (!step(until)) return false;
            growth_.push_back(position_);
        }
        return true;
    }

    [[nodiscard]] Judgement judgement() const {
        const auto above_floor = [](double error, double least) {
            return error >= least ? error : unknown;
        };
        const double phase = crossings_.phase();
        // The phase resolution at the middle, where the speed is largest.
        const double least_phase = 360 * floor_.position / reference_.extent;
        return {.complete = !ends_early(),
                .position_error = above_floor(std::max(drawn_.error(), position_), floor_.position),
                .step_error = above_floor(position_, floor_.position),
                .velocity_error = above_floor(velocity_, floor_.velocity),
                .phase_error = std::abs(phase) >= least_phase ? phase : unknown,
                .energy_drift = above_floor(reference_.share_of_energy(energy_), floor_.energy),
                .growth = growth_};
    }

private:
    [[nodiscard]] bool ends_early() const {
        const double error = options_.at_steps ? position_ : std::max(position_, drawn_.error());
        return error > options_.enough || options_.stopped();
    }
    [[nodiscard]] Real time() const {
        return static_cast<Real>(world_.tick()) /
               static_cast<Real>(world_.settings().stepping.rate.steps);
    }
    void read() {
        for (std::size_t row = 0; row < run_.size(); ++row) run_[row] = world_.bodies().state(row);
        true_at_(world_.tick(), true_);
    }
    bool step(double until) {
        const Real from = time();
        run_before_.swap(run_);
        true_before_.swap(true_);
        if (world_.try_step()) return false;
        read();
        for (std::size_t row = 0; row < run_.size(); ++row)
            drawn_.add(
                {row, from, time(), run_before_[row], run_[row], true_before_[row], true_[row]},
                until);
        // 3 steps of 10 ms end at 0.03 s, though that is a little less in double.
        constexpr double rounding = 1e-12;
        if (time() <= until * (1 + rounding)) take_state();
        return std::max(position_, drawn_.error()) <= lost_error_;
    }
    /// Takes the errors at the step.
    void take_state() {
        for (std::size_t row = 0; row < run_.size(); ++row) {
            position_ = larger(position_, distance(run_[row].x, true_[row].x));
            velocity_ = larger(velocity_, distance(run_[row].v, true_[row].v));
        }
        energy_ = larger(energy_, std::abs(world_.energy().total() - true_energy_.of(true_)));
        if (reference_.oscillation && world_.tick() > 0)
            crossings_.add(world_.time(), run_[reference_.oscillation->row]);
    }

    const Reference& reference_;
    const JudgeOptions& options_;
    World world_;
    TrueEnergy true_energy_;
    Motion::AtTicks true_at_;
    Uncertainty floor_;
    DrawnError drawn_;
    Crossings crossings_;
    std::vector<State3> run_;
    std::vector<State3> true_;
    std::vector<State3> run_before_{run_};
    std::vector<State3> true_before_{true_};
    double lost_error_ = 0;  ///< m
    double position_ = 0;
    double velocity_ = 0;
    double energy_ = 0;
    std::vector<double> growth_;
};

}  // namespace

Judgement judge(const Scene& scene, const Settings& settings, const Reference& reference,
                const JudgeOptions& options) try {
    RunErrors errors(scene, settings, reference, options);
    if (!errors.run()) return {.stable = false};
    Judgement judgement = errors.judgement();
    judgement.evaluations =
        evaluations_per_step(scene, settings) *
        std::ceil(reference.meaningful_until * static_cast<double>(settings.stepping.rate.steps));
    return judgement;
} catch (const Error& error) {
    // A method that cannot step the scene at any rate cannot at the highest.
    Settings short_steps = settings;
    short_steps.stepping.rate = {short_steps_rate};
    if (error.exit() != Exit::usage || !why_not(scene, short_steps).empty()) throw;
    return {.stable = false};
}

std::string why_not(const Scene& scene, const Settings& settings) try {
    make_world(scene, settings).require_applicable();
    return "";
} catch (const Error& error) {
    return error.what();
}

std::vector<const Method*> obvious_methods() {
    std::vector<const Method*> obvious;
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk4", "exact"})
        obvious.push_back(&find_method(name));
    return obvious;
}

std::vector<const Method*> usual_methods(const Scene& scene) {
    std::vector<const Method*> usual{scene.stepping.method};
    for (const Method* method : obvious_methods())
        if (method != scene.stepping.method &&
            why_not(scene, Settings{{method, scene.stepping.rate, scene.stepping.precision}})
                .empty())
            usual.push_back(method);
    return usual;
}

double evaluations_per_step(const Scene& scene, const Settings& settings) {
    // Implicit methods iterate, so their evaluations vary from step to step.
    const std::int64_t steps = settings.stepping.method->evaluations > 0 ? 1 : 16;
    const World start = make_world(scene, settings);
    const auto after = [&](std::int64_t count) {
        World world = start;
        if (world.try_step(count)) return unknown;
        return static_cast<double>(world.bodies().evaluations());
    };
    return (after(2 * steps) - after(steps)) / static_cast<double>(steps);
}

}  // namespace oiler::lab
