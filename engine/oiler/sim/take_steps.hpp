// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "oiler/physics/advance.hpp"
#include "oiler/sim/row_physics.hpp"
#include "oiler/sim/step_rows.hpp"

namespace oiler {

/// One step of a row or a batch from time `t` (s); whether there was one to be found.
template <class Rule, class V, int Axes, class Physics>
[[gnu::always_inline]] inline bool step_once(const Rule& rule, State<V, Axes>& state,
                                             Physics& physics, double t) {
    if constexpr (std::is_same_v<Rule, ImplicitPlan<Scalar<V>>>) {
        return advance(rule, state, physics, t);
    } else {
        advance(rule, state, physics, t);
        return true;
    }
}

/// Whether what is at rest is put there after tick `tick`: a matter of the tick alone, so that many
/// steps at once do as one at a time.
[[nodiscard]] constexpr bool settles(std::int64_t tick) { return tick % rest_interval == 0; }

/// All steps of a row or a batch; whether there were some to be found.
template <class Rule, class V, int Axes, class Physics>
[[gnu::always_inline]] inline bool take_steps(const Rule& rule, State<V, Axes>& state,
                                              Physics& physics, const Steps& steps) {
    const std::int64_t end = steps.first + steps.count;
    for (std::int64_t tick = steps.first; tick < end;) {
        const std::int64_t stop = std::min(end, (tick / rest_interval + 1) * rest_interval);
        for (; tick < stop; ++tick)
            if (!step_once(rule, state, physics, steps.rate.time(tick))) return false;
        if (settles(tick)) physics.settle(state, steps.rate.time(tick));
    }
    return true;
}

}  // namespace oiler
