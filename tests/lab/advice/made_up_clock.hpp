// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <utility>

#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::test {

/// A clock by which a step takes the given time, ns, however many steps a frame or a call has.
inline lab::SweepWatch made_up_clock(std::function<double(const Stepping&)> ns_per_step) {
    lab::SweepWatch watch;
    watch.ns_per_step = [ns_per_step](const Scene&, const Settings& settings, std::int64_t) {
        return ns_per_step(settings.stepping);
    };
    watch.ns_per_step_together = [ns = std::move(ns_per_step)](
                                     const Scene&, const Stepping& choice) { return ns(choice); };
    return watch;
}

/// A clock by which a step takes 1 ns for each of its force evaluations, and 10 ns for a step that
/// has no fixed number of them.
inline lab::SweepWatch clock_by_evaluations() {
    return made_up_clock([](const Stepping& choice) {
        return choice.method->evaluations > 0 ? 1.0 * choice.method->evaluations : 10.0;
    });
}

}  // namespace oiler::test
