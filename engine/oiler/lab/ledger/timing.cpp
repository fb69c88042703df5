// SPDX-License-Identifier: MIT
#include "oiler/lab/ledger/timing.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "oiler/core/seconds_since.hpp"
#include "oiler/lab/ledger/ablations.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::lab {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double timing_seconds = 2.5;
constexpr int most_rounds = 1000;
/// Quartiles of fewer rounds say little.
constexpr int fewest_rounds = 9;

/// Steps of unlinked bodies share a load of the columns, so that their number in a call changes
/// their time. This limit does not depend on the load of the machine.
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
/// changes the time of a few bodies by a tenth, and without this from run to run.
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
