// SPDX-License-Identifier: MIT
#include "oiler/lab/ledger/ledger.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <set>

#include "oiler/core/require.hpp"
#include "oiler/core/timing.hpp"
#include "oiler/lab/ledger/ablations.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::lab {
namespace {

/// "anchor.x", "anchor.y", "stiffness": the first field may be a vector.
std::vector<std::string> number_names(const Stored& stored) {
    static const std::vector<std::string_view> vector{""};
    static const std::vector<std::string_view> mass{"mass"};
    static const std::vector<std::string_view> contact{"radius"};
    const auto& forces = force_descriptions();
    const auto force = std::ranges::find(forces, stored.of, &ForceDescription::name);
    const auto& fields = force != forces.end()    ? force->numbers
                         : stored.of == "mass"    ? mass
                         : stored.of == "contact" ? contact
                                                  : vector;
    const std::size_t axes = stored.shared.size() - fields.size() + 1;
    std::vector<std::string> names;
    for (std::size_t axis = 0; axis < axes; ++axis) {
        const std::string name(fields[0]);
        const std::string dot = name.empty() || axes == 1 ? "" : ".";
        const bool with_axis = name.empty() || axes > 1;
        names.push_back(name + dot + (with_axis ? std::string(1, "xyz"[axis]) : ""));
    }
    names.insert(names.end(), fields.begin() + 1, fields.end());
    return names;
}

void add_columns(Ledger& ledger, const Stored& stored) {
    const auto own = std::ranges::count(stored.shared, false);
    const std::vector<std::string> names = number_names(stored);
    for (std::size_t i = 0; i < names.size(); ++i)
        ledger.columns.push_back(
            {.of = std::string(stored.of),
             .index = stored.index,
             .number = names[i],
             .shared = stored.shared[i],
             .bytes = stored.shared[i] ? 0 : stored.bytes / static_cast<std::size_t>(own),
             .bodies = static_cast<std::int64_t>(stored.rows)});
}

/// Adds the handle that World keeps for each body.
void add_handle(Ledger& ledger) {
    for (const auto& [number, bytes] : {std::pair{"generation", sizeof(Entity::generation)},
                                        std::pair{"row of entity", sizeof(Entity::index)},
                                        std::pair{"entity of row", sizeof(Entity::index)}})
        ledger.columns.push_back(
            {.of = "handle", .number = number, .bytes = bytes, .bodies = ledger.bodies});
}

/// Enters the stored columns and the absent forces. Returns the names of the bodies' forces.
std::vector<std::string_view> enter_columns(Ledger& ledger, const Bodies& bodies) {
    ledger.bodies = static_cast<std::int64_t>(bodies.size());
    ledger.links = static_cast<std::int64_t>(bodies.link_count());
    if (ledger.links > 0)
        ledger.bytes_per_link =
            static_cast<double>(bodies.bytes_of_links()) / static_cast<double>(ledger.links);
    std::vector<std::string_view> names;
    for (const Stored& stored : bodies.stored()) {
        add_columns(ledger, stored);
        names.push_back(stored.of);
    }
    add_handle(ledger);
    std::vector<std::string_view> forces;
    for (const ForceDescription& words : force_descriptions())
        if (std::ranges::find(names, words.name) != names.end())
            forces.push_back(words.name);
        else
            ledger.absent.emplace_back(words.plural);
    if (ledger.links == 0) ledger.absent.emplace_back("links");
    return forces;
}
/// Flags parts without effect. A part of a flagged part is not flagged again.
class Flags {
public:
    Flags(Ledger& ledger, const Comparison& comparison)
        : ledger_(ledger), comparison_(comparison) {}

    void raise(const std::vector<Ablation>& ablations) {
        for (std::size_t i = 0; i < ablations.size(); ++i)
            if (ablations[i].pass != "moving") raise(ablations[i], comparison_.without[i]);
    }
    void raise_for_axes(const Scene& scene, std::size_t bytes_per_number) {
        const Vec3& moved = comparison_.moved;
        if (std::ranges::all_of(moved.axis, [](double by) { return by == 0; }))
            return ledger_.flags.push_back(fmt::format(
                "no body moves in {} steps: give a body a `velocity` or a force that acts",
                comparison_.steps));
        for (int axis = 0; axis < scene.axes; ++axis)
            if (moved[axis] == 0)
                ledger_.flags.push_back(
                    fmt::format("no body moves along {} in {} steps, at {} bytes per body: fewer "
                                "`axes` suffice, except for the picture",
                                "xyz"[axis], comparison_.steps, 2 * bytes_per_number));
    }
    void raise_for_dampers(const Scene& scene) {
        for (std::size_t i = 0; i < scene.springs.size(); ++i) {
            const SceneSpring& spring = scene.springs[i];
            if (!spring.to && spring.rest_length == 0 && spring.stiffness == 0 &&
                spring.damping > 0)
                ledger_.flags.push_back(fmt::format(
                    "[[spring]] {} (of \"{}\") has `stiffness` 0 and only damps: write {} as "
                    "`linear_drag` of the body",
                    i + 1, scene.bodies[spring.body].name, spring.damping));
        }
    }

private:
    void raise(const Ablation& ablation, const AblationResult& result) {
        const bool said = said_.count(ablation.part_of) == 1;
        if (!said && (result.diverged || result.change > 0)) return;
        said_.insert(ablation.words);
        if (!said)
            ledger_.flags.push_back(fmt::format("{} has no effect in {} steps: leave it out",
                                                ablation.words, comparison_.steps));
    }

    Ledger& ledger_;
    const Comparison& comparison_;
    std::set<std::string> said_;
};

/// The untimed entries of an ablation's pass.
LedgerPass pass_of(const Ablation& ablation, const AblationResult& result) {
    LedgerPass pass{.name = ablation.pass};
    if (result.diverged)
        pass.diverged = result.diverged;
    else if (ablation.pass != "moving")
        pass.changes_position = result.change;
    return pass;
}

void enter_time(LedgerPass& pass, const Median& ratio, double whole_ns) {
    pass.spread_percent = 100 * ratio.spread;
    if (pass.name == "moving") {
        pass.ns = ratio.value * whole_ns;
        return;
    }
    pass.saves_percent = 100 * (1 - ratio.value);
    pass.saves_ns = (1 - ratio.value) * whole_ns;
    pass.ns = std::max(0.0, pass.saves_ns);
}

/// Times the whole scene, and the scene without each pass.
void time_passes(Ledger& ledger, const Scene& scene, const std::vector<const Scene*>& without,
                 const StepTimer& timer, const LedgerProgress& progress) {
    std::vector<const Scene*> scenes{&scene};
    std::vector<LedgerPass*> timed;
    for (std::size_t i = 0; i < without.size(); ++i)
        if (!ledger.passes[i].diverged) {
            scenes.push_back(without[i]);
            timed.push_back(&ledger.passes[i]);
        }
    const Timing timing = race(scenes, ledger.steps, timer, progress);
    ledger.timed_steps = timing.steps_per_turn;
    ledger.rounds = timing.rounds;
    const double body_steps = static_cast<double>(ledger.bodies * ledger.timed_steps);
    ledger.ns = 1e9 * timing.seconds.value / body_steps;
    ledger.spread_ns = 1e9 * timing.seconds.spread / body_steps;
    for (std::size_t i = 0; i < timed.size(); ++i)
        enter_time(*timed[i], timing.ratios[i], ledger.ns);
}

using Clock = std::chrono::steady_clock;

constexpr double timing_seconds = 2.5;
constexpr int most_rounds = 1000;
/// Quartiles of fewer rounds say little.
constexpr int fewest_rounds = 9;

/// Steps of unlinked bodies share a load of the columns, so their time depends on the steps per
/// call. This limit does not depend on the load of the machine.
constexpr double most_body_steps_per_turn = 1e6;
/// Limits turns of links and of implicit methods.
constexpr double most_seconds_per_turn = 5e-3;

double thread_cpu_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A copy of all bodies would share a solver's memory, which then is not free for the next solver.
void copy_state(const Bodies& from, Bodies& to) {
    for (std::size_t row = 0; row < from.size(); ++row) to.set_state(row, from.state(row));
}

/// Calls f with another offset of the stack in each of 256 rounds. The offset from the columns
/// changes the time of a few bodies by a tenth, which would otherwise vary from run to run.
template <class F>
[[gnu::noinline]] double call_with_shifted_stack(std::size_t round, F f) {
    constexpr std::size_t alignment = 16;
    const std::size_t shift = alignment * (1 + 157 * round % 256);
    volatile char* const end = static_cast<char*>(__builtin_alloca(shift));
    *end = 0;
    return f();
}

class Rounds {
public:
    Rounds(const std::vector<const Scene*>& scenes, std::int64_t steps, const StepTimer& timer)
        : stepping_(scenes.front()->stepping),
          timer_(timer),
          steps_(steps),
          start_(make_world(*scenes.front(), Settings{stepping_}).bodies()),
          per_turn_(steps_per_turn()),
          seconds_(scenes.size()) {
        for (const Scene* scene : scenes)
            scenes_.push_back(make_world(*scene, Settings{stepping_}).bodies());
        // An ablation of a scene at rest may stay at rest.
        static_cast<void>(start_.try_step(*stepping_.method, steps_from(0, per_turn_)));
        restart();
    }

    void run_round() {
        const std::size_t first = seconds_.front().size();
        for (std::size_t i = 0; i < scenes_.size(); ++i) take_turn((first + i) % scenes_.size());
        tick_ += 1 + per_turn_;
        copy_state(scenes_.front(), from_);
        if (tick_ + 1 + per_turn_ > steps_) restart();
    }

    [[nodiscard]] Timing timing() const {
        Timing timing{.rounds = static_cast<std::int64_t>(seconds_.front().size()),
                      .steps_per_turn = per_turn_,
                      .seconds = median_of(seconds_.front())};
        for (std::size_t i = 1; i < seconds_.size(); ++i)
            timing.ratios.push_back(median_of(ratios_to_whole(seconds_[i])));
        return timing;
    }

private:
    [[nodiscard]] Steps steps_from(std::int64_t tick, std::int64_t count) const {
        return {stepping_.rate, tick, count, stepping_.damping};
    }
    /// Half the run at most: a turn begins after as many steps, and one of its steps is not timed.
    [[nodiscard]] std::int64_t steps_per_turn() const {
        const double bodies = static_cast<double>(start_.size());
        const double most =
            std::min({most_body_steps_per_turn / bodies, most_seconds_per_turn / seconds_per_step(),
                      static_cast<double>(steps_ - 1) / 2});
        return static_cast<std::int64_t>(std::max(1.0, most));
    }
    [[nodiscard]] double seconds_per_step() const {
        Bodies bodies = start_;
        double least = INFINITY;
        for (std::int64_t tick = 0; tick < 3; ++tick)
            least = std::min(least, timer_(bodies, *stepping_.method, steps_from(tick, 1)));
        return least;
    }
    void restart() {
        copy_state(start_, from_);
        tick_ = per_turn_;
    }
    void take_turn(std::size_t i) {
        copy_state(from_, scenes_[i]);
        const Method& method = *stepping_.method;
        const bool failed = scenes_[i].try_step(method, steps_from(tick_, 1)).has_value();
        const auto take_steps = [&] {
            return timer_(scenes_[i], method, steps_from(tick_ + 1, per_turn_));
        };
        seconds_[i].push_back(failed ? LedgerPass::unknown
                                     : call_with_shifted_stack(seconds_[i].size(), take_steps));
    }
    [[nodiscard]] std::vector<double> ratios_to_whole(const std::vector<double>& seconds) const {
        std::vector<double> ratios;
        for (std::size_t round = 0; round < seconds.size(); ++round)
            ratios.push_back(seconds[round] / seconds_.front()[round]);
        return ratios;
    }

    Stepping stepping_;
    const StepTimer& timer_;
    std::int64_t steps_;
    Bodies start_;
    std::int64_t per_turn_;
    Bodies from_ = start_;
    std::int64_t tick_ = 0;
    std::vector<Bodies> scenes_;
    std::vector<std::vector<double>> seconds_;
};

}  // namespace

double Ledger::bytes_per_body() const {
    double bytes = 0;
    for (const LedgerColumn& column : columns) bytes += static_cast<double>(column.bytes);
    if (links == 0) return bytes;
    return bytes + static_cast<double>(links) * bytes_per_link / static_cast<double>(bodies);
}

Ledger ledger(const Scene& scene, std::int64_t steps, const LedgerProgress& progress,
              const StepTimer& timer) {
    require(steps >= 2, "a ledger takes at least two steps");
    Ledger ledger;
    const World world = make_world(scene, Settings{scene.stepping});
    const auto forces = enter_columns(ledger, world.bodies());
    if (ledger.bodies == 0) return ledger;
    const std::vector<Ablation> all = ablations(scene, forces, ledger.links > 0);
    const Comparison comparison = compare(scene, all, steps, progress);
    ledger.steps = comparison.steps;
    ledger.samples = comparison.samples;
    ledger.diverged = comparison.diverged;
    std::vector<const Scene*> without;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].pass.empty()) continue;
        ledger.passes.push_back(comparison.diverged ? LedgerPass{.name = all[i].pass}
                                                    : pass_of(all[i], comparison.without[i]));
        without.push_back(&all[i].scene);
    }
    if (ledger.diverged) return ledger;
    Flags flags(ledger, comparison);
    flags.raise(all);
    flags.raise_for_dampers(scene);
    flags.raise_for_axes(scene, ledger.columns.front().bytes);
    time_passes(ledger, scene, without, timer, progress);
    return ledger;
}

// Both clocks read too much: the steady clock while other programs run, the CPU clock about 1 µs,
// its own call. A CPU clock of low resolution may read 0.
double cpu_seconds(Bodies& bodies, const Method& method, const Steps& steps) {
    const double cpu_start = thread_cpu_seconds();
    const Clock::time_point start = Clock::now();
    if (bodies.try_step(method, steps)) return LedgerPass::unknown;
    const double seconds = seconds_since(start);
    const double cpu = thread_cpu_seconds() - cpu_start;
    return cpu > 0 ? std::min(cpu, seconds) : seconds;
}

Timing race(const std::vector<const Scene*>& scenes, std::int64_t steps, const StepTimer& timer,
            const LedgerProgress& progress) {
    Rounds rounds(scenes, steps, timer);
    const Clock::time_point start = Clock::now();
    for (int round = 0; round < most_rounds; ++round) {
        const double share = seconds_since(start) / timing_seconds;
        if (round >= fewest_rounds && share >= 1) break;
        progress(comparing_share + (1 - comparing_share) * std::min(1.0, share));
        rounds.run_round();
    }
    return rounds.timing();
}

}  // namespace oiler::lab
