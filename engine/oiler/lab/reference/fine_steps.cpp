// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/fine_steps.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "oiler/core/length_text.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::lab {
namespace {

constexpr std::size_t fewest_runs = 3;
/// Extrapolations per run. Each removes another power of dt from the error.
constexpr std::size_t most_columns = 4;
/// Halvings in a row without improvement, after which only round-off or chaos remains.
constexpr int most_vain_runs = 2;
/// The error of linked bodies that land only halves with the step: less work is spent on it.
constexpr double landing_share = 32;
/// Of a method with many stages, also where few bodies make its work small.
constexpr double most_steps = 4e6;
constexpr double least_wanted = 1e-12;  ///< of the extent

bool is_damped_along_lines(const Scene& scene) {
    const auto drags = [](const SceneMatter& matter) { return matter.quadratic_drag > 0; };
    for (const SceneBody& body : scene.bodies)
        if (drags(body.matter)) return true;
    for (const SceneScatter& scatter : scene.scatters)
        if (drags(scatter.matter)) return true;
    for (const SceneGrid& grid : scene.grids)
        if (drags(grid.matter) || grid.damping > 0) return true;
    for (const SceneSpring& spring : scene.springs)
        if (spring.damping > 0 && (spring.to || spring.rest_length > 0)) return true;
    return false;
}

/// Whether friction may turn with a body's velocity.
bool slides_in_two_directions(const Scene& scene) {
    const auto any_brakes = [](const auto& list, auto friction_of) {
        return std::ranges::any_of(list, [&](const auto& one) { return friction_of(one) > 0; });
    };
    return scene.axes == 3 &&
           (any_brakes(scene.planes, [](const ScenePlane& one) { return one.plane.friction; }) ||
            any_brakes(scene.obstacles,
                       [](const SceneObstacle& one) { return one.obstacle.friction; }) ||
            any_brakes(scene.chains, [](const SceneChain& one) { return one.like.friction; }) ||
            any_brakes(scene.tiles, [](const SceneTiles& one) { return one.friction; }));
}

/// A method of the highest order that holds on the scene, with a small error constant.
const Method& finest_method(const Scene& scene) {
    const bool by_stages = is_damped_along_lines(scene) || slides_in_two_directions(scene);
    return find_method(by_stages ? "rk4" : "kahan_li8_kdk");
}

/// fine + (fine − coarse)/divisor, in the memory of `coarse`.
Trajectory extrapolated(const Trajectory& fine, Trajectory coarse, Real divisor) {
    const Real share = 1 / divisor;
    for (std::size_t i = 0; i < fine.states.size(); ++i) {
        const State3& a = fine.states[i];
        State3& b = coarse.states[i];
        b = {a.x + (a.x - b.x) * share, a.v + (a.v - b.v) * share};
    }
    return coarse;
}

double extent_of(const Trajectory& trajectory) {
    double extent = 0;
    for (std::size_t i = 0; i < trajectory.states.size(); ++i)
        extent = std::max(
            extent, distance(trajectory.states[i].x, trajectory.states[i % trajectory.bodies].x));
    return extent;
}

/// The largest differences of two trajectories up to each sample; energies in J, from those of
/// `bodies` in both states.
std::vector<Uncertainty> differences(const Trajectory& a, const Trajectory& b, Bodies bodies) {
    std::vector<Uncertainty> uncertainties;
    Uncertainty most;
    const auto energy_of = [&](const Trajectory& trajectory, std::int64_t sample) {
        for (std::size_t row = 0; row < trajectory.bodies; ++row)
            bodies.set_state(row, trajectory.at(sample, row));
        return bodies.energy().total();
    };
    for (std::int64_t sample = 0; sample < a.samples(); ++sample) {
        for (std::size_t row = 0; row < a.bodies; ++row) {
            const State3& one = a.at(sample, row);
            const State3& other = b.at(sample, row);
            most.position = larger(most.position, distance(one.x, other.x));
            most.velocity = larger(most.velocity, distance(one.v, other.v));
        }
        most.energy = larger(most.energy, std::abs(energy_of(a, sample) - energy_of(b, sample)));
        uncertainties.push_back(most);
    }
    return uncertainties;
}

/// Adds the round-off of positions, and of the elapsed time, because dt and the method's
/// coefficients are rounded alike in all runs. Kinks are in double.
void add_rounding(std::vector<Uncertainty>& uncertainties, const Trajectory& trajectory,
                  const SampleTimes& samples, Precision precision) {
    const auto epsilon = precision == Precision::extended && trajectory.kinks.empty()
                             ? static_cast<double>(std::numeric_limits<Real>::epsilon())
                             : std::numeric_limits<double>::epsilon();
    double x = 0;
    double v = 0;
    for (const State3& state : trajectory.states) {
        x = std::max(x, static_cast<double>(largest(state.x)));
        v = std::max(v, static_cast<double>(largest(state.v)));
    }
    for (std::size_t sample = 0; sample < uncertainties.size(); ++sample) {
        const double way = v * samples.time(static_cast<std::int64_t>(sample));
        uncertainties[sample].position += 4 * epsilon * (2 * x + way);
        uncertainties[sample].velocity += 4 * epsilon * v * (2 + (x > 0 ? way / x : 0));
    }
}

/// Adds the impacts of the last steps.
void add_kinks(Trajectory& trajectory, const Bodies& bodies, const Rate& rate) {
    for (std::size_t i = 0; i < bodies.impact_count(); ++i) {
        const BodyImpact impact = bodies.impact_at(i, rate);
        const double radius = bodies.contact(impact.row)->radius;
        const Real3 x = to_real(impact.point + impact.normal * radius);
        trajectory.kinks.resize(trajectory.bodies);
        trajectory.kinks[impact.row].push_back(
            {impact.time, {x, to_real(impact.before)}, {x, to_real(impact.after)}});
    }
}

/// Whether linked bodies that slide on the obstacle keep the order of the method.
bool keeps_order(const Obstacle& one) {
    return one.friction == 0 && !one.swing && std::holds_alternative<HalfSpaceShape>(one.shape);
}

/// Whether a body with links has met an obstacle, or slides on one with order 1.
bool any_linked_lands(const Trajectory& trajectory, const Bodies& bodies) {
    if (!bodies.has_obstacles()) return false;
    const auto slides = [&](const Touch& touch) {
        return !keeps_order(bodies.obstacle(touch.obstacle));
    };
    const std::vector<bool> linked = bodies.linked_rows();
    for (std::size_t row = 0; row < linked.size(); ++row)
        if (linked[row] && ((!trajectory.kinks.empty() && !trajectory.kinks[row].empty()) ||
                            std::ranges::any_of(bodies.touches(row), slides)))
            return true;
    return false;
}

/// Romberg's table of runs, each of half the step of the one before.
class Table {
public:
    Table(const Scene& scene, const Perturbation& start, const SampleTimes& samples,
          const ReferenceEffort& effort, Precision precision, const Method& method,
          bool first_order)
        : scene_(scene),
          start_(start),
          samples_(samples),
          effort_(effort),
          precision_(precision),
          method_(method),
          first_order_(first_order) {}

    /// Returns false and empties the table if the run diverged or was stopped.
    bool add_run(std::int64_t rate) {
        std::optional<Trajectory> run = this->run(rate);
        if (!run) {
            row_.clear();
            return false;
        }
        comparable_ = !row_.empty();
        if (comparable_) before_ = row_.back();
        std::vector<Trajectory> row{std::move(*run)};
        const std::size_t columns = extrapolates(row.front()) ? most_columns : 1;
        for (std::size_t k = 0; k < std::min(row_.size(), columns - 1); ++k)
            row.push_back(extrapolated(row[k], std::move(row_[k]), std::exp2(Real(power(k))) - 1));
        row_ = std::move(row);
        ++runs_;
        return true;
    }
    /// The phase of an impact within its step, or of a rope that becomes taut, makes errors uneven,
    /// so that extrapolation does not gain.
    [[nodiscard]] bool extrapolates(const Trajectory& run) const {
        return !first_order_ && run.kinks.empty();
    }
    [[nodiscard]] bool has_uncertainties() const { return comparable_ && runs_ >= fewest_runs; }
    [[nodiscard]] const Trajectory& best() const { return row_.back(); }
    [[nodiscard]] const Trajectory& finest_run() const { return row_.front(); }
    [[nodiscard]] std::vector<Uncertainty> uncertainties() const {
        const Settings settings{{&method_, scene_.stepping.rate, precision_}};
        std::vector<Uncertainty> uncertainties =
            differences(best(), before_, make_world(scene_, settings, start_).bodies());
        // Round-off grows with the number of steps, and both runs have some: the error of the finer
        // one is up to twice the difference.
        if (precision_ == Precision::double_)
            for (Uncertainty& one : uncertainties)
                one = {2 * one.position, 2 * one.velocity, 2 * one.energy};
        add_rounding(uncertainties, best(), samples_, precision_);
        return uncertainties;
    }
    [[nodiscard]] const Method& method() const { return method_; }
    [[nodiscard]] bool has_too_many_impacts() const { return has_too_many_impacts_; }
    /// Whether any run had order 1.
    [[nodiscard]] bool first_order() const { return first_order_; }

private:
    /// The power of dt in the error of column k.
    [[nodiscard]] int power(std::size_t k) const {
        return method_.order + static_cast<int>(k) * (method_.symmetric ? 2 : 1);
    }
    [[nodiscard]] std::optional<Trajectory> run(std::int64_t rate) {
        Follower follower(scene_, Settings{{&method_, {rate}, precision_}}, start_,
                          samples_.per_second);
        Trajectory trajectory{.bodies = follower.bodies().size()};
        trajectory.states.reserve(trajectory.bodies * static_cast<std::size_t>(samples_.count));
        for (std::int64_t sample = 0; sample < samples_.count; ++sample) {
            const bool goes_on = !effort_.stopped() && follower.go_to(sample);
            if (goes_on) {
                add_kinks(trajectory, follower.bodies(), {rate});
                first_order_ = first_order_ || any_linked_lands(trajectory, follower.bodies());
            }
            has_too_many_impacts_ = follower.has_too_many_impacts() ||
                                    std::ranges::any_of(trajectory.kinks, [](const auto& kinks) {
                                        return kinks.size() > most_impacts;
                                    });
            if (!goes_on || has_too_many_impacts_) return std::nullopt;
            for (std::size_t row = 0; row < trajectory.bodies; ++row)
                trajectory.states.push_back(follower.bodies().state(row));
            if (!std::isfinite(follower.bodies().energy().total())) return std::nullopt;
        }
        return trajectory;
    }

    const Scene& scene_;
    const Perturbation& start_;
    const SampleTimes& samples_;
    const ReferenceEffort& effort_;
    Precision precision_;
    const Method& method_;
    std::vector<Trajectory> row_;
    Trajectory before_{};  ///< the best at twice the step
    std::size_t runs_ = 0;
    bool comparable_ = false;
    bool first_order_;
    bool has_too_many_impacts_ = false;
};

std::int64_t count_within(const std::vector<Uncertainty>& uncertainties, double most) {
    return std::ranges::count_if(
        uncertainties, [&](double position) { return position <= most; }, &Uncertainty::position);
}

/// The error that is enough. A loose tolerance must not make a scene look chaotic, and the samples
/// need a part of the usable error. Order 1 reaches no more than that.
double sufficient_error(const ReferenceEffort& effort, double extent, bool first_order) {
    const double usable = resolution * extent / margin;
    if (effort.wanted > 0) return std::min(effort.wanted, usable / 2);
    return first_order ? usable / 2 : least_wanted * extent;
}

/// The difference of two runs of linked bodies that land depends on where in a step they land, and
/// may be small by chance. An error is at least half of that at twice the step.
void raise_to_half(std::vector<Uncertainty>& uncertainties,
                   const std::vector<Uncertainty>& before) {
    for (std::size_t i = 0; i < before.size(); ++i) {
        Uncertainty& one = uncertainties[i];
        one = {std::max(one.position, before[i].position / 2),
               std::max(one.velocity, before[i].velocity / 2),
               std::max(one.energy, before[i].energy / 2)};
    }
}

FineSteps first_order_steps(const Scene& scene, const Perturbation& start,
                            const SampleTimes& samples, const ReferenceEffort& effort);

FineSteps fine_steps_in(Precision precision, const Scene& scene, const Perturbation& start,
                        const SampleTimes& samples, const ReferenceEffort& effort,
                        const Method& method, bool first_order = false) {
    Table table(scene, start, samples, effort, precision, method, first_order);
    const double work_per_step = RunWork(scene).per_step(method);
    const double most_work = first_order ? effort.most_work / landing_share : effort.most_work;
    FineSteps finest{.first_order = first_order};
    bool affordable = false;
    std::int64_t most_usable = -1;
    int vain = 0;
    for (std::int64_t rate = samples.per_second; vain < most_vain_runs; rate *= 2) {
        const double steps = static_cast<double>(rate) * samples.time(samples.count - 1);
        const double work = work_per_step * steps;
        finest.is_long = !first_order && steps > most_steps;
        if (finest.is_long || work > most_work || effort.stopped()) break;
        affordable = true;
        const bool has_run = table.add_run(rate);
        if (table.has_too_many_impacts()) break;
        // No method has more than order 1 then, and round-off is less than the error.
        if (table.first_order() && !first_order)
            return first_order_steps(scene, start, samples, effort);
        if (!has_run || !table.has_uncertainties()) continue;
        effort.progress(work / most_work);
        std::vector<Uncertainty> uncertainties = table.uncertainties();
        if (first_order) raise_to_half(uncertainties, finest.uncertainties);
        const double uncertainty = uncertainties.back().position;
        const double extent = extent_of(table.best());
        const double enough = sufficient_error(effort, extent, first_order);
        const std::int64_t usable = count_within(uncertainties, resolution * extent / margin);
        const bool better =
            finest.uncertainties.empty() || usable > most_usable || first_order ||
            (usable == most_usable && uncertainty < finest.uncertainties.back().position / 2);
        vain = better ? 0 : vain + 1;
        if (!better) continue;
        most_usable = usable;
        finest = {.trajectory = table.best(),
                  .uncertainties = std::move(uncertainties),
                  .words = fmt::format(
                      "fine steps in {} by {} at {} Hz{}; the last halving changes the end by {}",
                      precision == Precision::extended ? "long double" : "double",
                      table.method().name, rate,
                      table.extrapolates(table.finest_run())
                          ? ", extrapolated from runs at that rate, its half and so on"
                          : "",
                      length_text(uncertainty)),
                  .finest_run = table.finest_run(),
                  .stepping = {&table.method(), {rate}, precision},
                  .sufficient_error = enough,
                  .sufficient = uncertainty <= enough,
                  .first_order = first_order};
        if (finest.sufficient) break;
    }
    finest.affordable = affordable;
    finest.has_too_many_impacts = table.has_too_many_impacts();
    return finest;
}

FineSteps first_order_steps(const Scene& scene, const Perturbation& start,
                            const SampleTimes& samples, const ReferenceEffort& effort) {
    return fine_steps_in(Precision::double_, scene, start, samples, effort,
                         find_method("velocity_verlet"), true);
}

}  // namespace

double most_samples(const Scene& scene, const ReferenceEffort& effort) {
    const double finest = std::exp2(static_cast<double>(fewest_runs - 1));
    return effort.most_work / RunWork(scene).per_step(finest_method(scene)) / finest;
}

FineSteps fine_steps(const Scene& scene, const Perturbation& start, const SampleTimes& samples,
                     const ReferenceEffort& effort) {
    if (scene.has_ropes()) return first_order_steps(scene, start, samples, effort);
    const Method& method = finest_method(scene);
    if (effort.wanted > 0) {
        FineSteps quick = fine_steps_in(Precision::double_, scene, start, samples, effort, method);
        if (quick.sufficient || quick.first_order || quick.is_long || quick.has_too_many_impacts ||
            effort.stopped())
            return quick;
    }
    return fine_steps_in(Precision::extended, scene, start, samples, effort, method);
}

}  // namespace oiler::lab
