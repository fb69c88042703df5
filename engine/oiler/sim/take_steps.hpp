// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "oiler/physics/advance.hpp"
#include "oiler/sim/row_physics.hpp"
#include "oiler/sim/steps.hpp"

namespace oiler {

/// One step of a row or a batch from time `t` (s). Returns false if an implicit method found no
/// solution.
template <class Rule, class V, int Axes, class Physics>
[[gnu::always_inline]] inline bool step_once(const Rule& rule, State<V, Axes>& state,
                                             Physics& physics, double t) {
    if constexpr (std::is_same_v<decltype(advance(rule, state, physics, t)), bool>) {
        return advance(rule, state, physics, t);
    } else {
        advance(rule, state, physics, t);
        return true;
    }
}

/// Whether bodies are put to sleep after tick `tick`. It depends on the tick alone, so that results
/// do not depend on the number of steps per call.
[[nodiscard]] constexpr bool is_sleep_tick(std::int64_t tick) { return tick % sleep_interval == 0; }

/// One step and the sleep after it. Returns false if an implicit method found no solution.
template <class Rule, class V, int Axes, class Physics>
[[gnu::always_inline]] inline bool take_one_step(const Rule& rule, State<V, Axes>& state,
                                                 Physics& physics, const Steps& steps) {
    if (!step_once(rule, state, physics, steps.rate.time(steps.first))) return false;
    if (is_sleep_tick(steps.first + 1))
        physics.put_to_sleep(state, steps.rate.time(steps.first + 1));
    return true;
}

/// All steps of a row or a batch. Returns false if an implicit method found no solution.
template <class Rule, class V, int Axes, class Physics>
[[gnu::always_inline]] inline bool take_steps(const Rule& rule, State<V, Axes>& state,
                                              Physics& physics, const Steps& steps) {
    const std::int64_t end = steps.first + steps.count;
    for (std::int64_t tick = steps.first; tick < end;) {
        const std::int64_t stop = std::min(end, (tick / sleep_interval + 1) * sleep_interval);
        for (; tick < stop; ++tick)
            if (!step_once(rule, state, physics, steps.rate.time(tick))) return false;
        if (is_sleep_tick(tick)) physics.put_to_sleep(state, steps.rate.time(tick));
    }
    return true;
}

}  // namespace oiler
