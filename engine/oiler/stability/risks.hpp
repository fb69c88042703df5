// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/core/step_clock.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/stability/preflight.hpp"

namespace oiler {

/// The highest rate of the programs, Hz.
inline constexpr double highest_rate = StepClock::largest_rate;

/// The larger of ω·dt and c·dt.
[[nodiscard]] inline double size(const Risk& risk) {
    return std::max(risk.omega_dt, risk.damping_dt);
}
[[nodiscard]] bool is_attraction(const Risk& risk);
[[nodiscard]] bool is_rounding(const Risk& risk);

/// Whether neither the state nor its squares and its energy overflow.
[[nodiscard]] bool is_finite(const Bodies& bodies);
/// Whether all forces are linear in position and velocity, apart from drives.
[[nodiscard]] bool is_linear(const Bodies& bodies);
/// Whether the air or a drive may give energy to the bodies.
[[nodiscard]] bool has_sources(const Bodies& bodies);
/// Whether any body meets the obstacles.
[[nodiscard]] bool meets_obstacles(const Bodies& bodies);
/// A copy of one body with its forces, without links and contact, of 1 kg.
[[nodiscard]] Bodies alone(const Bodies& bodies, std::size_t row, Precision precision);
/// A copy in double, with links and obstacles.
[[nodiscard]] Bodies in_double(const Bodies& bodies);
/// The accelerations of all bodies at rest, without drives and obstacles, m/s²; empty if they are
/// not finite.
[[nodiscard]] std::vector<Vec3> accelerations_at_rest(Bodies bodies);
/// The unit of the last place of a number, in its unit.
[[nodiscard]] double last_place(double number, Precision precision);

/// The risks without the methods that are a remedy. The state of a run that has diverged is not
/// tried.
[[nodiscard]] std::vector<Risk> find_risks(const Bodies& bodies, const Method& method,
                                           const Steps& steps);

/// Whether a method steps the bodies without a risk that makes a run unusable, apart from rounding.
[[nodiscard]] bool holds(const Bodies& bodies, const Method& method, const Steps& steps);

/// The factor on dt up to which steps are stable.
[[nodiscard]] double limit_of(const Risk& risk, const Method& method, const Steps& steps);
/// The remedy of a risk with that limit in words: a rate that its bodies hold, or a method.
[[nodiscard]] std::string remedy_for(double limit, const Risk& risk, const Method& method,
                                     const Steps& steps);

/// Gives the risks the implicit methods that step the scene without a risk. A run that has diverged
/// is not tried.
void add_remedies(const Bodies& bodies, const Method& method, const Steps& steps,
                  std::vector<Risk>& risks);

/// Adds the springs, dampers and linear drag that are outside the region: one risk per body without
/// links and one per component of linked bodies.
void add_spring_risks(const Bodies& bodies, Region& region, double dt, std::vector<Risk>& risks);

/// The factor on the step up to which the risk's bodies are stable; 0 if they never are.
[[nodiscard]] double spring_limit(const Risk& risk, const Method& method, Damping damping,
                                  double dt);

/// Adds overdamped springs, dampers and linear drag that move and that the steps turn back, of
/// components without a risk: one that only brakes, or creeps to its rest, would reverse every
/// step. Bodies that drag alone brakes are left to add_drag_risks. Of larger components than 100
/// freedoms the motion that is damped most is tested.
void add_overdamped_risks(const Bodies& bodies, const Method& method, const Steps& steps,
                          std::vector<Risk>& risks);

/// The factor on dt up to which steps turn no overdamped motion back, whatever its start.
[[nodiscard]] double overdamped_limit(const Risk& risk, const Method& method, const Steps& steps);

/// Adds the bodies whose drag is too strong for the method: bodies that diverge alone or are thrown
/// back in a trial of 512 steps, or of one step if the drag is linear, and falling bodies whose
/// terminal speed is not stable. The speed alone decides for linked and attracted bodies, and
/// beyond 10,000 trials.
void add_drag_risks(const Bodies& bodies, Region& region, const Steps& steps,
                    std::vector<Risk>& risks);

/// The factor on dt up to which the body of a risk of drag neither diverges nor is thrown back.
[[nodiscard]] double drag_limit(const Risk& risk, const Method& method, const Steps& steps);

/// The largest c·|v|·dt at which no step makes a body faster or throws it back; infinite if there
/// is none below 1000.
[[nodiscard]] double quadratic_drag_limit(const Method& method, Damping damping);

/// Adds the bodies that an attractor pulls faster than the method follows. If one attractor is the
/// only force on a body that returns, 100 revolutions are tried. Else the local frequency √(2gm/r³)
/// of radial motion decides, at the present distance or at the closest point of a known orbit.
/// Bodies on an attractor are added for every method.
void add_attractor_risks(const Bodies& bodies, Region& region, const Rate& rate,
                         std::vector<Risk>& risks);

/// The number of revolutions for which an orbit is followed.
inline constexpr double most_revolutions = 100;
/// The revolution in which the changes of energy in passages of the closest point add up to half
/// of the energy: their deviation as a random walk, and their mean m each time. n periods of the
/// start have ∫|E|^(3/2) dn passages, so that E' = m·E^(3/2) and E = (1 − m·n/2)⁻².
[[nodiscard]] std::optional<double> lost_by_passages(const Orbit& orbit, const Method& method,
                                                     Damping damping, const Rate& rate);

/// The least distance from its attractor, m, that a body on an orbit has in a trial of 20,000
/// steps, if it lands on an obstacle before its closest point and never gets farther than the
/// orbit. Empty if not, or if obstacles move. Adds the cost in steps to `cost`.
[[nodiscard]] std::optional<double> distance_of_landing(const Bodies& bodies, std::size_t row,
                                                        const Orbit& orbit, const Method& method,
                                                        const Steps& steps, double& cost);

/// Whether the method follows an orbit for 100 revolutions, or 200,000 steps if they are fewer.
[[nodiscard]] bool follows(const Orbit& orbit, const Method& method, Damping damping,
                           const Rate& rate);

/// The factor on dt below which an orbit is followed, by descent in steps of 15 % to the first of
/// four in a row; 0 if it is below 10⁻⁴.
[[nodiscard]] double orbit_limit(const Orbit& orbit, const Method& method, Damping damping,
                                 const Rate& rate);

/// Adds bodies whose position or velocity in float changes in a step by so few units of its last
/// place that rounding makes the change 2 % larger or smaller, step after step: a change is added
/// in the parts of the method's drifts or kicks, each of which is rounded. It adds up while no
/// acceleration turns a part into the next unit, over a second or 64 steps. Errors below 0.2 % of
/// the motion, or 2 % of the acceleration, are left out, and so are forces of links.
void add_rounding_risks(const Bodies& bodies, const Method& method, const Steps& steps,
                        std::vector<Risk>& risks);

/// Adds bodies whose coordinates have a last place that is longer than a tenth of the length of a
/// spring, or that hides gaps of the radius of contact. Of links the first is added.
void add_resolution_risks(const Bodies& bodies, std::vector<Risk>& risks);

/// The unit of the last place of a body's largest coordinate in float, m, if slow parts of its
/// motion of the next second are shorter; else 0.
[[nodiscard]] double coarse_unit(const Bodies& bodies, std::size_t row, double dt);

/// Adds springs with a rest length whose ends are in one point and stay there: they have no
/// direction, and no force.
void add_point_risks(const Bodies& bodies, const Method& method, const Steps& steps,
                     std::vector<Risk>& risks);

/// Adds bodies for whose contact the planes leave no room, that start in a plane, and whose bounces
/// the method spoils, because it gains or loses about the acceleration times dt in each.
void add_contact_risks(const Bodies& bodies, const Method& method, const Steps& steps,
                       std::vector<Risk>& risks);

/// Adds bodies that start inside a circle, a segment or a box that is met from all sides, and
/// points among segments. Of many bodies and obstacles only the first bodies are tried. Adds
/// obstacles that swing with two steps or less per period.
void add_obstacle_risks(const Bodies& bodies, const Rate& rate, std::vector<Risk>& risks);

/// Adds bodies that a drive of more than a 24th of the rate, or any drive with a method of order 1,
/// moves otherwise than with finer steps: by 10 % of its effect and 5 % of the motion, within 512
/// steps.
void add_drive_risks(const Bodies& bodies, const Method& method, const Steps& steps,
                     std::vector<Risk>& risks);

/// Adds the risk that a trial of all bodies explodes within 16,384 steps, or as many as take some
/// tens of milliseconds: it diverges, or gains energy that finer steps do not gain. It finds what
/// is not linear: springs that turn, nets that swing, close passages. If springs are the cause
/// then, their risks are added.
void add_trial_risks(const Bodies& bodies, Region& region, const Steps& steps,
                     std::vector<Risk>& risks);

/// The factor on dt up to which the trial does not explode in the same time and 1024 steps more; 0
/// if it is below 0.1.
[[nodiscard]] double trial_limit(const Risk& risk, const Method& method, const Steps& steps);

/// The most distortions of a kind.
inline constexpr std::size_t most_distortions = 5;

/// Adds the oscillations whose energy the method halves, by more than half of what damping takes.
/// The energy is that of the modes at the present positions, in components of up to 100 freedoms
/// whose bodies meet no obstacles.
void add_oscillation_losses(const Bodies& bodies, const Method& method, const Steps& steps,
                            std::vector<Risk>& risks);

/// Adds the orbits whose farthest point is wrong by a fifth in the first revolution.
void add_orbit_distortions(const Bodies& bodies, const Method& method, const Steps& steps,
                           std::vector<Risk>& risks);
[[nodiscard]] bool keeps_shape(const Orbit& orbit, const Method& method, const Steps& steps);

/// Adds the bodies in float that depart from a run in double by a tenth of their motion within 512
/// steps, where the last place is not much shorter than their steps.
void add_float_distortions(const Bodies& bodies, const Method& method, const Steps& steps,
                           std::vector<Risk>& risks);

/// The rate of steps of dt·`factor`, to seven digits or more.
[[nodiscard]] Rate scaled_rate(const Rate& rate, double factor);

/// Whether any body has a force of a type for which `test` holds.
template <class Test>
bool any_body_has(const Bodies& bodies, Test test) {
    std::vector<std::string_view> names;
    for_each_index<force_count>([&](auto kind) {
        using Force = std::tuple_element_t<kind, ForceList<double, 3>>;
        if (test.template operator()<Force>()) names.push_back(Force::name);
    });
    return std::ranges::any_of(bodies.stored(), [&](const Stored& stored) {
        return stored.rows > 0 && std::ranges::count(names, stored.of) > 0;
    });
}

/// Bisects between a stable and an unstable factor on dt. Returns a stable one, relative to
/// `tolerance`.
template <class IsStable>
double edge_between(double stable, double unstable, double tolerance, IsStable is_stable) {
    while (unstable - stable > tolerance * unstable) {
        const double middle = (stable + unstable) / 2;
        (is_stable(middle) ? stable : unstable) = middle;
    }
    return stable;
}

/// The largest factor on dt that three smaller ones confirm, and the next larger one.
struct Descent {
    double stable = 1;
    double unstable = 1;
    bool found = false;
};

/// Tries factors on dt from `first` to `least`, each 15 % smaller than the one before, up to four
/// stable ones in a row.
template <class IsStable>
Descent descend(double first, double least, IsStable is_stable) {
    constexpr double ratio = 0.85;
    Descent to{.unstable = first / ratio};
    int in_a_row = 0;
    for (double factor = first; in_a_row < 4; factor *= ratio) {
        if (factor < least) return to;
        if (!is_stable(factor)) {
            to.unstable = factor;
            in_a_row = 0;
        } else if (++in_a_row == 1) {
            to.stable = factor;
        }
    }
    to.found = true;
    return to;
}

}  // namespace oiler
