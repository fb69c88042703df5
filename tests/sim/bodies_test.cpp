// SPDX-License-Identifier: MIT
#include "oiler/sim/bodies.hpp"

#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Rate rate{64};

/// Assorted bodies: the forces of body `i` and their numbers depend on `i` alone.
Vec3 assorted(std::size_t i, int axes, double scale) {
    Vec3 numbers{};
    for (int axis = 0; axis < axes; ++axis)
        numbers[axis] =
            scale * (static_cast<double>((i * 7 + static_cast<std::size_t>(axis) * 5) % 23) - 10.7);
    return numbers;
}

Body assorted_body(std::size_t i, int axes) {
    return {.mass = 0.7 + static_cast<double>(i % 5),
            .position = assorted(i, axes, 1.3),
            .velocity = assorted(i + 3, axes, 0.9)};
}

Spring assorted_spring(std::size_t i, int axes) {
    return {.anchor = assorted(i + 11, axes, 0.1),
            .stiffness = 3.1 + static_cast<double>(i % 4),
            .damping = 0.1 * static_cast<double>(i % 3)};
}

/// Longer than the amplitude of the body, so that it does not reach its anchor. There the force has
/// no direction, and an implicit step may have no solution.
CoilSpring assorted_coil(std::size_t i, int axes) {
    return {.anchor = assorted(i + 2, axes, 0.3),
            .stiffness = 2.3 + static_cast<double>(i % 4),
            .damping = 0.2 * static_cast<double>(i % 3),
            .rest_length = 50.0 + static_cast<double>(i % 5)};
}

/// The forces that a method can step: only linear ones for the exact method.
enum class Mix { any, linear };

Mix mix_for(const Method& method) { return method.order == exact_order ? Mix::linear : Mix::any; }

void add_assorted(Bodies& bodies, std::size_t i, Mix mix) {
    const int axes = bodies.axes();
    const std::size_t row = bodies.add(assorted_body(i, axes));
    if (i % 2 == 1) bodies.attach(row, assorted_spring(i, axes));
    if (i % 3 == 1) bodies.attach(row, LinearDrag{0.05 * static_cast<double>(1 + i % 7)});
    if (mix == Mix::linear) return;
    if (i % 5 == 1) bodies.attach(row, QuadraticDrag{0.01 * static_cast<double>(1 + i % 3)});
    if (i % 5 == 2) bodies.attach(row, assorted_coil(i, axes));
    if (i % 7 == 3) bodies.attach(row, Attractor{.centre = {99, 0, 0}, .gm = 250});
}

Bodies assorted_bodies(int axes, Precision precision, std::size_t count, Mix mix = Mix::any) {
    Bodies bodies(axes, precision);
    bodies.set_gravity(assorted(4, axes, 0.3));
    for (std::size_t i = 0; i < count; ++i) add_assorted(bodies, i, mix);
    return bodies;
}

bool same_state(const Bodies& a, std::size_t row, const Bodies& b, std::size_t other) {
    return a.position(row) == b.position(other) && a.velocity(row) == b.velocity(other);
}

template <class F>
void for_each_kind_and_axes(F f) {
    for (const Method& method : methods())
        for (const Precision precision : precisions)
            for (const int axes : {1, 2, 3}) {
                SCOPED_TRACE(std::string(method.name) + ", " + std::string(name_of(precision)) +
                             ", " + std::to_string(axes) + " axes");
                f(method, precision, axes);
            }
}

TEST(Bodies, MoveAsIfAlone) {
    for_each_kind_and_axes([](const Method& method, Precision precision, int axes) {
        Bodies all = assorted_bodies(axes, precision, 200, mix_for(method));
        all.step(method, {rate, 0, 100});
        for (std::size_t i = 0; i < 200; ++i) {
            Bodies alone(axes, precision);
            alone.set_gravity(assorted(4, axes, 0.3));
            add_assorted(alone, i, mix_for(method));
            alone.step(method, {rate, 0, 100});
            ASSERT_TRUE(same_state(all, i, alone, 0)) << i;
        }
    });
}

TEST(Bodies, MoveTheSameWithSharedAndWithDifferingNumbers) {
    for_each_kind_and_axes([](const Method& method, Precision precision, int axes) {
        Bodies shared(axes, precision);
        Bodies differing(axes, precision);
        for (std::size_t i = 0; i < 130; ++i) {
            const Body body{.position = assorted(i, axes, 1), .velocity = assorted(i + 1, axes, 1)};
            shared.add(body, assorted_spring(5, axes), LinearDrag{0.3});
            differing.add(body, assorted_spring(5, axes), LinearDrag{0.3});
        }
        differing.add(assorted_body(3, axes), assorted_spring(8, axes), LinearDrag{0.4});
        differing.remove(130);
        shared.step(method, {rate, 0, 50});
        differing.step(method, {rate, 0, 50});
        EXPECT_EQ(hash_of(shared), hash_of(differing));
    });
}

TEST(Bodies, ManyStepsPerCallEqualSingleSteps) {
    for_each_kind_and_axes([](const Method& method, Precision precision, int axes) {
        Bodies one_call = assorted_bodies(axes, precision, 100, mix_for(method));
        Bodies one_by_one = one_call;
        const std::uint64_t start = hash_of(one_call);
        one_call.step(method, {rate, 5, 37});
        for (int i = 0; i < 37; ++i) one_by_one.step(method, {rate, 5 + i, 1});
        EXPECT_EQ(hash_of(one_call), hash_of(one_by_one));
        EXPECT_NE(hash_of(one_call), start);
    });
}

TEST(Bodies, AroundThePaddingMoveIndependentlyOfOthers) {
    for_each_kind_and_axes([](const Method& method, Precision precision, int axes) {
        Bodies many = assorted_bodies(axes, precision, 300, mix_for(method));
        many.step(method, {rate, 0, 20});
        for (const std::size_t count : {1U, 63U, 64U, 65U, 127U, 128U, 129U}) {
            Bodies few = assorted_bodies(axes, precision, count, mix_for(method));
            ASSERT_EQ(few.size(), count);
            few.step(method, {rate, 0, 20});
            for (std::size_t i = 0; i < count; ++i) ASSERT_TRUE(same_state(few, i, many, i)) << i;
        }
    });
}

TEST(Bodies, AnEmptySetSteps) {
    for_each_kind_and_axes([](const Method& method, Precision precision, int axes) {
        Bodies none(axes, precision);
        none.step(method, {rate, 0, 10});
        none.set_gravity(assorted(1, axes, 1));
        none.step(method, {rate, 0, 10});
        EXPECT_EQ(none.size(), 0U);
        EXPECT_EQ(none.energy().total(), 0);
    });
}

TEST(Bodies, RemovingMovesTheLastRow) {
    for (const std::size_t removed : {0U, 64U, 99U}) {
        Bodies bodies = assorted_bodies(2, Precision::double_, 100);
        const Bodies before = bodies;
        bodies.remove(removed);
        ASSERT_EQ(bodies.size(), 99U);
        for (std::size_t i = 0; i < 99; ++i) {
            const std::size_t from = i == removed ? 99 : i;
            EXPECT_TRUE(same_state(bodies, i, before, from)) << i;
            EXPECT_EQ(bodies.mass(i), before.mass(from)) << i;
        }
    }
}

// Each removal moves the last row to row 0: 99, 98, … 29. Row 29 has a spring, row 0 has none.
TEST(Bodies, KeepTheirForcesWhenRowsMove) {
    for (const Method& method : methods()) {
        Bodies bodies = assorted_bodies(3, Precision::single, 100, mix_for(method));
        Bodies whole = bodies;
        for (int i = 0; i < 71; ++i) bodies.remove(0);
        whole.step(method, {rate, 0, 30});
        bodies.step(method, {rate, 0, 30});
        EXPECT_TRUE(same_state(bodies, 0, whole, 29));
        for (std::size_t i = 1; i < 29; ++i) EXPECT_TRUE(same_state(bodies, i, whole, i)) << i;
    }
}

TEST(Bodies, AddedAfterAllWereRemovedAreLikeNewOnes) {
    for (const Method& method : methods()) {
        const Mix mix = mix_for(method);
        Bodies used = assorted_bodies(2, Precision::double_, 70, mix);
        used.step(method, {rate, 0, 10});
        while (used.size() > 0) used.remove(used.size() - 1);
        for (std::size_t i = 0; i < 5; ++i) add_assorted(used, i, mix);
        Bodies fresh = assorted_bodies(2, Precision::double_, 5, mix);
        used.step(method, {rate, 0, 10});
        fresh.step(method, {rate, 0, 10});
        EXPECT_EQ(hash_of(used), hash_of(fresh));
    }
}

TEST(Bodies, GravityMayComeBeforeOrAfterThem) {
    Bodies before(2, Precision::double_);
    before.set_gravity({1, -9.81, 0});
    Bodies after(2, Precision::double_);
    for (std::size_t i = 0; i < 70; ++i) before.add(assorted_body(i, 2));
    for (std::size_t i = 0; i < 70; ++i) after.add(assorted_body(i, 2));
    after.set_gravity({5, 5, 0});
    after.set_gravity({1, -9.81, 0});
    before.step(find_method("explicit_euler"), {rate, 0, 9});
    after.step(find_method("explicit_euler"), {rate, 0, 9});
    EXPECT_EQ(hash_of(before), hash_of(after));
}

TEST(Bodies, ForcesMayBeAttachedLater) {
    Bodies together(2, Precision::single);
    Bodies later(2, Precision::single);
    for (std::size_t i = 0; i < 70; ++i) {
        together.add(assorted_body(i, 2), assorted_spring(i, 2), LinearDrag{0.2});
        later.add(assorted_body(i, 2), assorted_spring(i + 1, 2));
    }
    for (std::size_t i = 0; i < 70; ++i) later.attach(i, assorted_spring(i, 2), LinearDrag{0.2});
    together.step(find_method("semi_implicit_euler"), {rate, 0, 9});
    later.step(find_method("semi_implicit_euler"), {rate, 0, 9});
    EXPECT_EQ(hash_of(together), hash_of(later));
}

// Springs, linear drag and gravity do not couple axes; quadratic drag does, through |v|.
TEST(Bodies, AxesAreIndependent) {
    for (const Method& method : methods())
        for (const Precision precision : precisions) {
            Bodies space(3, precision);
            space.set_gravity({1, 2, 3});
            space.add({.mass = 2, .position = {4, 5, 6}, .velocity = {7, 8, 9}},
                      Spring{.anchor = {1, 0, 2}, .stiffness = 3, .damping = 0.3}, LinearDrag{0.1});
            space.step(method, {rate, 0, 100});
            for (int axis = 0; axis < 3; ++axis) {
                const double a = axis;
                Bodies line(1, precision);
                line.set_gravity({1 + a, 0, 0});
                line.add({.mass = 2, .position = {4 + a, 0, 0}, .velocity = {7 + a, 0, 0}},
                         Spring{.anchor = {axis == 0   ? 1.0
                                           : axis == 1 ? 0.0
                                                       : 2.0,
                                           0, 0},
                                .stiffness = 3,
                                .damping = 0.3},
                         LinearDrag{0.1});
                line.step(method, {rate, 0, 100});
                EXPECT_EQ(space.position(0)[axis], line.position(0)[0]) << axis;
                EXPECT_EQ(space.velocity(0)[axis], line.velocity(0)[0]) << axis;
            }
        }
}

/// A body of 2 kg at (8, 16) with velocity (3, 4) after a step of ¼ s. All numbers below are
/// dyadic, hence exact in float and double.
template <class... Force>
void expect_first_step(const Vec3& acceleration, const Force&... force) {
    for (const Precision precision : precisions) {
        Bodies bodies(2, precision);
        bodies.add({.mass = 2, .position = {8, 16, 0}, .velocity = {3, 4, 0}}, force...);
        Bodies semi_implicit = bodies;
        const Vec3 velocity{3 + acceleration[0] / 4, 4 + acceleration[1] / 4, 0};
        bodies.step(find_method("explicit_euler"), {{4}});
        EXPECT_EQ(bodies.velocity(0), velocity);
        EXPECT_EQ(bodies.position(0), (Vec3{8.75, 17, 0}));
        semi_implicit.step(find_method("semi_implicit_euler"), {{4}});
        EXPECT_EQ(semi_implicit.velocity(0), velocity);
        EXPECT_EQ(semi_implicit.position(0), (Vec3{8 + velocity[0] / 4, 16 + velocity[1] / 4, 0}));
    }
}

// −(1/2)·5·(3, 4).
TEST(FirstStep, QuadraticDragFromHandCalculation) {
    expect_first_step({-7.5, -10, 0}, QuadraticDrag{1});
}

// −(1/2)·(3, 4).
TEST(FirstStep, LinearDragFromHandCalculation) { expect_first_step({-1.5, -2, 0}, LinearDrag{1}); }

// −(8/2)·(8 − 2, 16 − 20) − (1/2)·(3, 4).
TEST(FirstStep, SpringFromHandCalculation) {
    expect_first_step({-25.5, 14, 0}, Spring{.anchor = {2, 20, 0}, .stiffness = 8, .damping = 1});
}

TEST(FirstStep, ForcesAddUp) {
    expect_first_step({-7.5 - 1.5 - 25.5, -10 - 2 + 14, 0}, QuadraticDrag{1}, LinearDrag{1},
                      Spring{.anchor = {2, 20, 0}, .stiffness = 8, .damping = 1});
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// A drag of 3 N·s/m on 1 kg at dt = 1 s makes v' = v − 3v = −2v, so |v| = 2^n exactly. 3·2^127
// overflows in float and 3·2^1023 in double, so v is not finite after step 128 or 1024. Explicit
// Euler's x diverges one step later.
Bodies doubling(Precision precision, std::size_t count) {
    Bodies bodies(1, precision);
    for (std::size_t i = 0; i < count; ++i) bodies.add({}, LinearDrag{3});
    return bodies;
}

std::string divergence(Bodies bodies, const char* method, std::int64_t count,
                       std::int64_t per_call) {
    return line_of_error(Exit::diverged, [&] {
        for (std::int64_t first = 0; first < count; first += per_call)
            bodies.step(find_method(method), {{1}, first, per_call});
    });
}

void expect_start(const std::string& line, const std::string& start) {
    EXPECT_EQ(line.substr(0, start.size()), start);
}

TEST(Divergence, NamesStepBodyAndField) {
    for (const auto& [precision, step] :
         {std::pair(Precision::single, "128"), {Precision::double_, "1024"}}) {
        Bodies bodies = doubling(precision, 70);
        bodies.set_velocity(66, {1, 0, 0});
        const std::string start =
            std::string("diverged at step ") + step + " (t = " + step + " s): ";
        for (const int per_call : {1, 7, 2000}) {
            expect_start(divergence(bodies, "explicit_euler", 2000, per_call),
                         start + "velocity x of body 66 ");
            expect_start(divergence(bodies, "semi_implicit_euler", 2000, per_call),
                         start + "position x of body 66 ");
        }
    }
}

TEST(Divergence, NamesTheAxis) {
    Bodies bodies(3, Precision::single);
    bodies.add({.velocity = {0, 0, 1}}, LinearDrag{3});
    expect_start(divergence(bodies, "explicit_euler", 200, 1),
                 "diverged at step 128 (t = 128 s): velocity z of body 0 ");
}

// Bodies 130 and 140 start 2^20 times as fast and diverge 20 steps before body 3.
TEST(Divergence, NamesTheEarliestStepAndItsFirstBody) {
    Bodies bodies = doubling(Precision::single, 200);
    bodies.set_velocity(3, {1, 0, 0});
    bodies.set_velocity(130, {1 << 20, 0, 0});
    bodies.set_velocity(140, {1 << 20, 0, 0});
    for (const int per_call : {1, 1000})
        expect_start(divergence(bodies, "explicit_euler", 1000, per_call),
                     "diverged at step 108 (t = 108 s): velocity x of body 130 ");
}

// Gravity of 3e38 m/s² takes a body from −3e38 m/s to 3e38 m/s in two steps, which is finite. From
// rest, as in the rows after the last body, it exceeds the largest float, 3.4e38.
TEST(Divergence, RowsAfterTheLastBodyDoNotCount) {
    Bodies bodies(1, Precision::single);
    bodies.set_gravity({3e38, 0, 0});
    bodies.add({.velocity = {-3e38, 0, 0}});
    bodies.step(find_method("explicit_euler"), {{1}, 0, 1});
    bodies.step(find_method("explicit_euler"), {{1}, 1, 1});
    EXPECT_EQ(bodies.velocity(0)[0], static_cast<double>(3e38F));
    expect_start(divergence(bodies, "explicit_euler", 1, 1), "diverged at step 1 ");
    Bodies two_steps(1, Precision::single);
    two_steps.set_gravity({3e38, 0, 0});
    two_steps.add({.velocity = {-3e38, 0, 0}});
    two_steps.step(find_method("explicit_euler"), {{1}, 0, 2});
    EXPECT_TRUE(same_state(bodies, 0, two_steps, 0));
}

// The sum of 2e38 and 1.8e38 is no float, so that its batch is stepped row by row, from any row of
// a stretch of rows and along any axis. Each other body flies on with its speed: a row that is
// stepped twice, or not at all, is at least 1/64 m away.
TEST(Divergence, LargeNumbersDoNotAffectTheBodiesNearby) {
    for (const std::size_t large : {0, 70, 130, 970, 1023, 1024, 2100, 2199})
        for (const int axis : {0, 1, 2})
            for (const int per_call : {1, 6}) {
                Bodies bodies(3, Precision::single);
                for (std::size_t row = 0; row < 2200; ++row) bodies.add({.velocity = {1, 2, 3}});
                Vec3 far{};
                far[axis] = 2e38;
                bodies.set_position(large, far);
                bodies.set_velocity(large, far * 0.9);
                for (int tick = 0; tick < 6; tick += per_call)
                    bodies.step(find_method("semi_implicit_euler"), {Rate{64}, tick, per_call});
                for (std::size_t row = 0; row < 2200; ++row) {
                    if (row == large) continue;
                    ASSERT_EQ(bodies.position(row), (Vec3{6.0 / 64, 12.0 / 64, 18.0 / 64}))
                        << row << ", large " << large << ", " << per_call << " per call";
                }
            }
}

TEST(Hash, DependsOnTheStateAlone) {
    Bodies bodies = assorted_bodies(2, Precision::double_, 70);
    const std::uint64_t hash = hash_of(bodies);
    bodies.attach(5, Spring{.stiffness = 1});
    bodies.set_gravity({1, 1, 0});
    EXPECT_EQ(hash_of(bodies), hash);
    const Vec3 velocity = bodies.velocity(69);
    bodies.set_velocity(69, {velocity[0], std::nextafter(velocity[1], 1e9), 0});
    EXPECT_NE(hash_of(bodies), hash);
    bodies.set_velocity(69, velocity);
    EXPECT_EQ(hash_of(bodies), hash);
    EXPECT_NE(hash_of(Bodies(1, Precision::single)), hash_of(Bodies(2, Precision::single)));
    EXPECT_NE(hash_of(Bodies(1, Precision::single)), hash_of(Bodies(1, Precision::double_)));
}

TEST(Bodies, DescribeThemselves) {
    for (const Precision precision : precisions)
        for (const int axes : {1, 2, 3}) {
            const Bodies bodies(axes, precision);
            EXPECT_EQ(bodies.axes(), axes);
            EXPECT_EQ(bodies.precision(), precision);
        }
    EXPECT_EQ(name_of(Precision::single), "float");
    EXPECT_EQ(name_of(Precision::double_), "double");
}

// A refused body must leave the others unchanged.
TEST(Bodies, ARefusedBodyChangesNothing) {
    Bodies bodies(1, Precision::double_);
    bodies.add({.position = {1, 0, 0}}, Spring{.stiffness = 1}, LinearDrag{1});
    line_of_error(Exit::usage,
                  [&] { bodies.add({}, Spring{.stiffness = 2}, LinearDrag{not_a_number}); });
    ASSERT_EQ(bodies.size(), 1U);
    bodies.add({.position = {1, 0, 0}}, Spring{.stiffness = 4}, LinearDrag{1});
    EXPECT_EQ(bodies.energy().potential, 0.5 * 1 + 0.5 * 4);
}

TEST(Bodies, ANumberForAMissingAxisIsRefused) {
    Bodies bodies(2, Precision::double_);
    EXPECT_THROW(bodies.add({.position = {0, 0, 1}}), Error);
    EXPECT_THROW(bodies.add({.velocity = {0, 0, 1}}), Error);
    EXPECT_THROW(bodies.set_gravity({0, 0, -9.81}), Error);
    EXPECT_EQ(bodies.size(), 0U);
    bodies.add({});
    EXPECT_THROW(bodies.set_velocity(0, {0, 0, 1}), Error);
}

TEST(Bodies, ANumberThatFloatCannotHoldIsRefused) {
    Bodies bodies(1, Precision::single);
    EXPECT_THROW(bodies.add({.position = {1e39}}), Error);
    EXPECT_THROW(bodies.add({.mass = 1e-30}, Spring{.stiffness = 1e20}), Error);
    EXPECT_EQ(bodies.add({.mass = 1e30}, Spring{.stiffness = 1e20}), 0U);
}

}  // namespace
}  // namespace oiler::test
