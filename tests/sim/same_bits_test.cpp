// SPDX-License-Identifier: MIT
// Results do not depend on the number of threads or on the steps per call. A run may change its
// method, its rate and the place of its damping between two steps: results of the former plan must
// not reach the next step.

#include <atomic>

#include "oiler/core/team.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// Enough bodies for every team to be used.
constexpr int many = 9000;

Bodies assorted(int count, bool linear) {
    Bodies bodies(2, Precision::single);
    bodies.set_gravity({0, -9.81, 0});
    for (int i = 0; i < count; ++i) {
        const std::size_t row = bodies.add(
            {.mass = 1.0 + i % 3, .position = {i / 8.0, 1}, .velocity = {i % 7 / 4.0, 3}});
        if (i % 2 == 0) bodies.attach(row, Spring{.stiffness = 4.0 + i % 5, .damping = 0.25});
        if (!linear && i % 5 == 0) bodies.attach(row, QuadraticDrag{0.125});
    }
    return bodies;
}

std::uint64_t hash_after(Bodies bodies, const Method& method, int threads, std::int64_t per_call,
                         std::optional<Damping> damping = {}) {
    constexpr std::int64_t steps = 12;
    bodies.set_threads(threads);
    for (std::int64_t tick = 0; tick < steps; tick += per_call)
        bodies.step(method, {Rate{64}, tick, per_call, damping});
    return hash_of(bodies);
}

TEST(Threads, GiveTheSameBits) {
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "pefrl", "rk4", "rk3_kutta",
                             "implicit_midpoint", "exact"}) {
        const Method& method = find_method(name);
        const Bodies bodies = assorted(many + 1, method.order == exact_order);
        const std::uint64_t alone = hash_after(bodies, method, 1, 1);
        EXPECT_NE(alone, hash_of(bodies)) << name;
        for (const int threads : {1, 2, 3, 8})
            for (const std::int64_t per_call : {1, 3, 12})
                EXPECT_EQ(hash_after(bodies, method, threads, per_call), alone)
                    << name << ", " << threads << " threads, " << per_call << " steps per call";
    }
}

/// A net with links along and across its rows, one of eight bodies linked to any other, and some to
/// a point.
Bodies net() {
    constexpr std::size_t width = 150;
    constexpr std::size_t size = width * 120;
    Bodies bodies = assorted(size, true);
    for (std::size_t row = 0; row < size; ++row) {
        if ((row + 1) % width != 0)
            bodies.link(row, row + 1, {.stiffness = 8, .damping = 0.5, .rest_length = 0.125});
        if (row + width < size) bodies.link(row + width, row, {.stiffness = 4});
        const std::size_t other = (row * 7919 + 13) % size;
        if (row % 8 == 0 && other != row) bodies.link(row, other, {.stiffness = 0.5});
        if (row % 5000 == 7) bodies.link_to_point(row, {}, {.stiffness = 3, .damping = 0.25});
    }
    return bodies;
}

// A link whose bodies are rows of two threads is computed by both.
TEST(Threads, GiveNetsTheSameBits) {
    const Bodies bodies = net();
    for (const char* name : {"velocity_verlet", "rk4"}) {
        const auto hash_with = [&](int threads, std::int64_t per_call) {
            return hash_after(bodies, find_method(name), threads, per_call, Damping::in_kick);
        };
        const std::uint64_t alone = hash_with(1, 3);
        EXPECT_NE(alone, hash_of(bodies)) << name;
        for (const int threads : {2, 3, 8})
            for (const std::int64_t per_call : {1, 12})
                EXPECT_EQ(hash_with(threads, per_call), alone)
                    << name << ", " << threads << " threads, " << per_call << " steps per call";
    }
}

/// The divergence of many bodies, of which those in `springs` are on springs of ω² in s⁻².
std::optional<Divergence> divergence(const std::vector<std::pair<std::size_t, double>>& springs,
                                     int threads) {
    Bodies bodies = assorted(many, true);
    for (const auto& [row, omega_squared] : springs)
        bodies.attach(row, Spring{.stiffness = omega_squared * bodies.mass(row)});
    bodies.set_threads(threads);
    return bodies.try_step(find_method("semi_implicit_euler"), {Rate{64}, 0, 100});
}

// A step at 64 Hz multiplies |x| by 1e8/64² − 2 = 2.44e4 (1e12/64² − 2 = 2.44e8). A row starts at
// row/8 m. The force of step n + 1 is infinite if ω²·|x| exceeds 3.4e38 after n steps. From 500 m,
// 750 m and 1000 m, n is 7, because ω²·|x| is at most 2.1e37 after 6 steps and at least 2.6e41
// after 7. For 1e12, n is 3, because ω²·|x| is 6e31 after 2 steps and 1.5e40 after 3.
TEST(Threads, NameTheFirstOfTheRowsThatDivergeInOneStep) {
    for (const int threads : {1, 2, 3, 8}) {
        const auto at = divergence({{8000, 1e8}, {4000, 1e8}, {6000, 1e8}}, threads);
        ASSERT_TRUE(at);
        EXPECT_EQ(at->tick, 8) << threads;
        EXPECT_EQ(at->row, 4000U) << threads;
    }
}

TEST(Threads, NameTheRowThatDivergesFirstOnAnyThread) {
    for (const int threads : {1, 2, 3, 8})
        for (const std::size_t first : {4000, 6000, 8000}) {
            const auto at =
                divergence({{8000, 1e8}, {4000, 1e8}, {6000, 1e8}, {first, 1e12}}, threads);
            ASSERT_TRUE(at);
            EXPECT_EQ(at->tick, 4) << threads;
            EXPECT_EQ(at->row, first) << threads;
        }
}

TEST(Threads, AreSharedWithCopies) {
    Bodies bodies = assorted(many, true);
    bodies.set_threads(2);
    Bodies copy = bodies;
    const Steps steps{Rate{64}, 0, 3};
    bodies.step(find_method("rk4"), steps);
    copy.step(find_method("rk4"), steps);
    EXPECT_EQ(hash_of(bodies), hash_of(copy));
}

TEST(Team, DoesEveryPartOnce) {
    for (const std::size_t size : {1, 2, 5}) {
        Team team(size);
        ASSERT_EQ(team.size(), size);
        std::vector<std::atomic<int>> done(size);
        for (int i = 0; i < 1000; ++i) team.run([&](std::size_t part) { ++done[part]; });
        for (const auto& times : done) EXPECT_EQ(times, 1000);
    }
}

// A sleeping team wakes up for the next piece of work.
TEST(Team, WakesUp) {
    Team team(2);
    std::atomic<int> done = 0;
    for (int i = 0; i < 3; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        team.run([&](std::size_t) { ++done; });
    }
    EXPECT_EQ(done, 6);
}

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
