// SPDX-License-Identifier: MIT
#include "oiler/overlay/game_inspector.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "oiler/core/beside.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/length_text.hpp"
#include "oiler/core/timing.hpp"
#include "oiler/overlay/ghosts.hpp"
#include "oiler/overlay/overlays.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/sim/steps/step_rows.hpp"
#include "oiler/whatif/rate_advice.hpp"

namespace oiler {
namespace {

/// The methods that can step the bodies of a world.
std::vector<const Method*> applicable_methods(const World& world) {
    std::vector<const Method*> all;
    const Steps steps{world.settings().stepping.rate, world.tick(), 1, {}};
    for (const Method& method : methods()) try {
            world.bodies().require_applicable(method, steps);
            all.push_back(&method);
        } catch (const Error& error) {
            if (error.exit() != Exit::usage) throw;
        }
    return all;
}

/// The largest number of threads that can be chosen; 1 where more change nothing.
int most_threads(const World& world) {
    const auto here = static_cast<int>(std::thread::hardware_concurrency());
    const int most = std::max(here, world.settings().threads);
    return pays_for_team(world.body_count(), 1) ? most : 1;
}

/// The mouse and Escape; the mouse in pixels; the canvas is centred in `view`.
Inspector::Mouse mouse_in_pixels(const Input& input, Size view) {
    Inspector::Mouse mouse{.is_down = input.held(Mouse::left),
                           .wheel = input.wheel(),
                           .escapes = input.pressed(Key::escape)};
    const auto at = input.pointer_canvas();
    if (!at) return mouse;
    const auto width = static_cast<float>(view.width);
    const auto height = static_cast<float>(view.height);
    const float scale = std::min(width / canvas_width, height / canvas_height);
    mouse.at = Point{width / 2 + (at->x - canvas_width / 2) * scale,
                     height / 2 - (at->y - canvas_height / 2) * scale};
    return mouse;
}

/// Whether the played run has an error, a reading or a failure to show.
bool has_figures(const WhatIf& measured) {
    const WhatIfRun& played = measured.runs.front();
    return !std::isnan(played.distance) || !played.readings.empty() || !played.failure.empty() ||
           played.other_play_from;
}

Inspected::Setting inspected(const WhatIfRun& run, const WhatIf& measured) {
    const KnownError error = measured.error_of(run);
    const double cost = run.costs.of_steps();
    const double times = run.evaluations / measured.runs.front().evaluations;
    return {.stepping = run.stepping,
            .error = !run.failure.empty()  ? "failed"
                     : run.other_play_from ? "other events"
                                           : error.text(measured.pixel),
            .grade = colour_of(run.is_sound() ? measured.grade_of(run) : Grade::bad),
            .cost = !shows_costs()      ? ""
                    : cost < least_cost ? "< 10 µs"
                                        : time_text(cost),
            .forces = std::isfinite(times) && times > 0 ? fmt::format("×{:.2g}", times) : ""};
}

/// The errors and costs of this setting and of others.
void add_measured(Inspected& run, const LiveFigures& figures) {
    run.errors = figures.errors;
    if (!run.errors.empty()) run.last_error = length_text(run.errors.back());
    if (!figures.measured || !has_figures(*figures.measured)) return;
    const WhatIf& measured = *figures.measured;
    WhatIfRun played = measured.runs.front();
    if (played.other_play_from) run.last_error = "other events";
    // The errors are newer than the result.
    if (!run.errors.empty()) played.distance = std::max(played.distance, double{run.errors.back()});
    run.settings.push_back(inspected(played, measured));
    for (const WhatIfRun& other : std::span(measured.runs).subspan(1))
        run.settings.push_back(inspected(other, measured));
    run.is_of_round = figures.repeats;
    run.pixel = measured.pixel;
    run.rate_advice = rate_advice_text(measured);
}

}  // namespace

GameInspector::GameInspector(AnyGame& game, Fixed fixed, std::span<const char> font)
    : game_(game), fixed_(std::move(fixed)), inspector_(font) {}

void GameInspector::begin_game() {
    methods_.clear();
    follower_.end();
}

/// Finding the limits takes longer than a frame, so another thread does it, if the machine gives
/// one.
void GameInspector::find_stiffest(bool waits) {
    constexpr std::size_t most_bodies = 2000;
    constexpr std::chrono::milliseconds period{250};
    const World& world = game_.world();
    const Stepping& stepping = world.settings().stepping;
    const auto now = std::chrono::steady_clock::now();
    if (!finding_.valid() && (waits || now >= next_stiffest_) &&
        world.body_count() <= most_bodies) {
        next_stiffest_ = now + period;
        found_for_ = stepping;
        finding_ = call_beside(
            thread_,
            [this, stepping, suspects = StiffestFinder::suspects_of(world.bodies(), stepping)] {
                return finder_.find(suspects, stepping);
            });
    }
    if (found_for_ != stepping) stiffest_.reset();
    if (!finding_.valid()) return;
    if (!waits && finding_.wait_for(std::chrono::seconds(0)) == std::future_status::timeout) return;
    const std::optional<Stiffest> found = finding_.get();
    stiffest_.reset();
    const auto is_here = [&](std::size_t row) { return row < world.body_count(); };
    if (found_for_ != stepping || !found || !is_here(found->row) ||
        (found->linked && !is_here(*found->linked)))
        return;
    std::string name = game_.name_of(world.entity_of_row(found->row));
    if (found->linked) name += " to " + game_.name_of(world.entity_of_row(*found->linked));
    stiffest_ = Inspected::Gauge{std::move(name), found->is_damper, found->measure, found->limit};
}

void GameInspector::add_times(const StepTimes& steps, std::chrono::nanoseconds show,
                              std::chrono::nanoseconds draw) {
    constexpr double weight = 1.0 / 32;
    const auto mix = [](double& mean, std::int64_t nanoseconds) {
        mean += weight * (static_cast<double>(nanoseconds) - mean);
    };
    mix(costs_.update, steps.update);
    mix(costs_.step, steps.step);
    mix(costs_.picture, show.count() - steps.update - steps.step);
    mix(costs_.draw, draw.count());
}

void GameInspector::follow(Picture& picture, const Input& mouse, const Camera& shown, double time) {
    if (!inspector_.has_mouse()) follower_.look(mouse, shown, picture, game_.world(), time);
    follower_.move(picture);
}

void GameInspector::add_overlays(Picture& picture, const std::vector<Ghost>& ghosts, double alpha,
                                 double factor) {
    const World& world = game_.world();
    motion_.add(picture, world, shown_,
                {.time = world.time() - (1 - alpha) * world.dt(),
                 .ghosts = ghosts,
                 .factor = factor,
                 .followed = follower_.followed()});
    add_ghosts(picture, ghosts, factor);
}

/// "planet: 1.23 m/s at (0.5, 2) m".
std::string GameInspector::figures_of(Entity body) const {
    const World& world = game_.world();
    if (!world.has_body(body)) return "the body that was followed is gone";
    const Vec3 v = world.velocity(body);
    const Vec3 x = world.position(body);
    std::string place;
    for (int axis = 0; axis < world.axes(); ++axis)
        place += fmt::format("{}{:.4g}", axis == 0 ? "" : ", ", x[axis]);
    return fmt::format("{}: {:.4g} m/s at ({}) m", game_.name_of(body),
                       std::hypot(v[0], v[1], v[2]), place);
}

Requests GameInspector::show(const LiveFigures* figures, const Input& mouse, Size size, Size view,
                             const Frame& frame) {
    const World& world = game_.world();
    if (methods_.empty()) methods_ = applicable_methods(world);
    find_stiffest(frame.waits);
    const Energy energy = world.energy();
    Inspected run{.stepping = world.settings().stepping,
                  .methods = methods_,
                  .fixed = fixed_.reason,
                  .hides_setting = fixed_.hides_setting,
                  .stiffest = stiffest_,
                  .costs = costs_,
                  .energy = energy.total(),
                  .time = world.time(),
                  .dropped = frame.dropped,
                  .bodies = world.body_count(),
                  .threads = world.settings().threads,
                  .most_threads = most_threads(world),
                  .is_paused = frame.is_paused,
                  .past = frame.past,
                  .status = frame.status,
                  .scales = motion_.scales(),
                  .theme = theme_of(frame.background)};
    const bool is_measured = figures && frame.no_verdict.empty();
    if (figures && figures->begin) {
        run.begin = figures->begin->time;
        run.first_energy = figures->begin->energy;
        // What plays along may lag behind the shown energy, which belongs to the scale.
        EnergyScale scale = figures->energy_scale;
        scale.add(energy);
        run.energy_scale = joules_of(scale, world);
        run.is_scale_kinetic = scale.is_kinetic();
    }
    if (follower_.followed()) run.followed = figures_of(*follower_.followed());
    const Verdict verdict = is_measured ? figures->verdict : Verdict{.text = frame.no_verdict};
    run.verdict = verdict.text;
    if (run.verdict.empty() && run.bodies == 0)
        run.verdict = "The world of this game has no bodies whose error could be measured.";
    run.grade = colour_of(verdict.grade);
    if (is_measured) add_measured(run, *figures);
    const Requests requests =
        inspector_.show(run, mouse_in_pixels(mouse, view), size, frame.seconds);
    shown_ = requests.shown;
    return requests;
}

}  // namespace oiler
