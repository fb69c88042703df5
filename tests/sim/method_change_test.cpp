// SPDX-License-Identifier: MIT
// A run may change its method, its rate and the place of its damping between two steps. Results of
// the former plan must not reach the next step.
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// Four different damped bodies without links.
Bodies damped(Precision precision, bool linear) {
    Bodies bodies(2, precision);
    for (std::size_t row = 0; row < 4; ++row) {
        const auto i = static_cast<double>(row);
        bodies.add({.mass = 1 + i, .position = {2 + i, 1 - i}, .velocity = {0.5, i - 2}},
                   Spring{.stiffness = 4 + i, .damping = 0.5 + i}, LinearDrag{0.25 * (1 + i)});
        if (linear) continue;
        bodies.attach(row, CoilSpring{{30, i}, 3, 0.75 + i, 20}, QuadraticDrag{0.125});
    }
    return bodies;
}

/// `made` in the state of `run`. It has taken no step and therefore keeps no plan and no flows.
Bodies unstepped(Bodies made, const Bodies& run) {
    for (std::size_t row = 0; row < run.size(); ++row) made.set_state(row, run.state(row));
    return made;
}

/// Compares the steps after a step with `before` with those of bodies that never took it.
void expect_no_trace_of(const Method& method, const Steps& before, const Method& next,
                        const Steps& after) {
    const bool linear = is_exact(method) || is_exact(next);
    for (const Precision precision : precisions) {
        Bodies run = damped(precision, linear);
        run.step(method, before);
        Bodies fresh = unstepped(damped(precision, linear), run);
        run.step(next, after);
        fresh.step(next, after);
        EXPECT_EQ(hash_of(run), hash_of(fresh))
            << method.name << " before " << next.name << ", " << name_of(precision);
    }
}

TEST(MethodChange, LeavesNoTraceOfTheFormerMethod) {
    for (const Method& method : methods())
        for (const Method& next : methods())
            expect_no_trace_of(method, {Rate{64}, 4, 1, Damping::in_drift}, next,
                               {Rate{64}, 5, 2, Damping::in_drift});
}

TEST(MethodChange, LeavesNoTraceOfTheFormerRate) {
    for (const Method& method : methods())
        for (const Rate& rate : {Rate{32}, Rate{65}, Rate{64, 2}})
            expect_no_trace_of(method, {Rate{64}, 4, 1, Damping::in_drift}, method,
                               {rate, 5, 2, Damping::in_drift});
}

TEST(MethodChange, LeavesNoTraceOfTheFormerDamping) {
    for (const Method& method : methods())
        for (const Damping former : {Damping::in_kick, Damping::in_drift})
            for (const Damping now : {Damping::in_kick, Damping::in_drift})
                expect_no_trace_of(method, {Rate{64}, 4, 1, former}, method, {Rate{64}, 5, 2, now});
}

// Both methods have the same address, so an address must not identify a plan.
TEST(MethodChange, IsDetectedForMethodsOutsideTheList) {
    Method own = find_method("velocity_verlet");
    Bodies run = damped(Precision::double_, false);
    run.step(own, {Rate{64}, 0, 1});
    Bodies fresh = unstepped(damped(Precision::double_, false), run);
    own = find_method("rk4");
    run.step(own, {Rate{64}, 1, 1});
    fresh.step(find_method("rk4"), {Rate{64}, 1, 1});
    EXPECT_EQ(hash_of(run), hash_of(fresh));
}

// The hashes above detect a stale plan only where the steps of the two plans differ.
TEST(MethodChange, ChangesTheStep) {
    const auto hash_after = [](const char* method, const Rate& rate, Damping damping) {
        Bodies bodies = damped(Precision::double_, false);
        bodies.step(find_method(method), {rate, 5, 2, damping});
        return hash_of(bodies);
    };
    const std::uint64_t one = hash_after("velocity_verlet", Rate{64}, Damping::in_drift);
    EXPECT_NE(hash_after("forest_ruth4", Rate{64}, Damping::in_drift), one);
    EXPECT_NE(hash_after("velocity_verlet", Rate{65}, Damping::in_drift), one);
    EXPECT_NE(hash_after("velocity_verlet", Rate{64}, Damping::in_kick), one);
}

}  // namespace
}  // namespace oiler::test
