// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <functional>

#include "oiler/sim/bodies.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Rate rate{64};

/// The mass of row `row`: a power of two, so that dividing by it does not round.
double mass_of(std::size_t row) { return std::ldexp(1, static_cast<int>(row % 4) - 1); }

/// Eight separate bodies with forces of all kinds.
Bodies assorted(Precision precision) {
    Bodies bodies(2, precision);
    bodies.set_gravity({0.25, -4});
    for (std::size_t row = 0; row < 8; ++row) {
        const auto i = static_cast<double>(row);
        bodies.add({.mass = mass_of(row),
                    .position = {3 * std::cos(2 * i), i},
                    .velocity = {std::sin(i), std::cos(3 * i)}});
        if (row % 2 == 1) bodies.attach(row, Spring{{1, i, 0}, 7 + i, 0.3});
        if (row % 3 == 1) bodies.attach(row, LinearDrag{0.2});
        if (row % 4 == 2) bodies.attach(row, QuadraticDrag{0.1}, CoilSpring{{9, 9, 0}, 5, 0.4, 12});
        if (row % 5 == 3) bodies.attach(row, Attractor{{-50, 0, 0}, 90});
    }
    return bodies;
}

/// Bodies of which rows 0 to 4 are linked, rows 1 and 3 also to points.
Bodies linked(Precision precision) {
    Bodies bodies = assorted(precision);
    bodies.link(0, 1, {.stiffness = 12, .damping = 0.3});
    bodies.link(1, 2, {.stiffness = 20, .damping = 0.6, .rest_length = 1.5});
    bodies.link(2, 4, {.stiffness = 9, .rest_length = 2});
    bodies.link(4, 3, {.stiffness = 4, .damping = 2});
    bodies.link_to_point(3, {0, 9}, {.stiffness = 3, .damping = 0.4});
    bodies.link_to_point(1, {4, 3}, {.stiffness = 6, .damping = 0.7, .rest_length = 0.5});
    return bodies;
}

/// New bodies with equal state, forces and links.
Bodies rebuilt(const Bodies& from) {
    Bodies to(from.axes(), from.precision());
    for (std::size_t row = 0; row < from.size(); ++row) {
        to.add({from.mass(row), from.position(row), from.velocity(row)});
        const auto attach = [&]<class Force>(const std::optional<Force>& force) {
            if (!force) return;
            if constexpr (Force::everywhere)
                to.set_gravity(force->acceleration);
            else
                to.attach(row, force->per_unit_mass(1 / from.mass(row)));
        };
        std::apply([&](const auto&... force) { (attach(force), ...); }, from.forces_per_mass(row));
    }
    for (std::size_t i = 0; i < from.link_count(); ++i) {
        const LinkEnds ends = from.link_ends(i);
        if (ends.other)
            to.link(ends.row, *ends.other, from.link_at(i));
        else
            to.link_to_point(ends.row, ends.point, from.link_at(i));
    }
    return to;
}

TEST(LinkedBodies, TakeManyStepsPerCallAsOneByOne) {
    for_each_kind([](const Method& method, Precision precision) {
        Bodies one_call = linked(precision);
        Bodies one_by_one = one_call;
        const std::uint64_t start = hash_of(one_call);
        one_call.step(method, {rate, 5, 33});
        for (int i = 0; i < 33; ++i) one_by_one.step(method, {rate, 5 + i});
        EXPECT_EQ(hash_of(one_call), hash_of(one_by_one));
        EXPECT_NE(hash_of(one_call), start);
    });
}

// A landing moves a row and must discard the acceleration that is kept for the next kick. Setting a
// state, even to itself, discards it too.
TEST(LinkedBodies, LandAsIfNoAccelerationWereKept) {
    for_each_kind([](const Method& method, Precision precision) {
        Bodies one_call(2, precision);
        one_call.set_gravity({0, -4});
        one_call.add({.position = {0, 0.25}});
        one_call.add({.position = {0.5, 1.5}});
        one_call.link(0, 1, {.stiffness = 40, .damping = 1, .rest_length = 1});
        one_call.add_plane({.normal = {0, 1}, .restitution = 0.5});
        one_call.set_contact(0, Contact{});
        Bodies one_by_one = one_call;
        one_call.step(method, {rate, 0, 64});
        std::size_t impacts = 0;
        for (int i = 0; i < 64; ++i) {
            one_by_one.step(method, {rate, i});
            one_by_one.set_state(1, one_by_one.state(1));
            impacts += one_by_one.impact_count();
        }
        EXPECT_EQ(hash_of(one_call), hash_of(one_by_one));
        EXPECT_GT(impacts, 0U);
    });
}

// A copy must not change data that it shares with the original.
TEST(LinkedBodies, AreCopiedInTheMiddleOfARun) {
    for_each_kind([](const Method& method, Precision precision) {
        Bodies original = linked(precision);
        Bodies alone = original;
        alone.step(method, {rate, 0, 20});
        original.step(method, {rate, 0, 10});
        Bodies copy = original;
        Bodies changed = original;
        changed.link(0, 4, {.stiffness = 100});
        changed.set_position(2, {1, 1, 0});
        changed.step(method, {rate, 10, 10});
        copy.step(method, {rate, 10, 10});
        EXPECT_EQ(hash_of(copy), hash_of(alone));
        original.step(method, {rate, 10, 10});
        EXPECT_EQ(hash_of(original), hash_of(alone));
        EXPECT_NE(hash_of(changed), hash_of(alone));
    });
}

struct Change {
    const char* what;
    std::function<void(Bodies&)> make;
};

std::vector<Change> changes() {
    return {
        {"none", [](Bodies&) {}},
        {"a position",
         [](Bodies& bodies) {
             bodies.set_position(1, {4, 0.5, 0});
         }},
        {"a velocity",
         [](Bodies& bodies) {
             bodies.set_velocity(1, {4, 0.5, 0});
         }},
        {"a spring",
         [](Bodies& bodies) {
             bodies.attach(1, Spring{{0, 0, 0}, 30, 3});
         }},
        {"a coil spring",
         [](Bodies& bodies) {
             bodies.attach(0, CoilSpring{{9, 0, 0}, 3, 3, 1});
         }},
        {"drag", [](Bodies& bodies) { bodies.attach(4, QuadraticDrag{0.5}, LinearDrag{0.5}); }},
        {"gravity",
         [](Bodies& bodies) {
             bodies.set_gravity({0, 4, 0});
         }},
        {"a link",
         [](Bodies& bodies) {
             bodies.link(0, 3, {11, 0.7, 2});
         }},
        {"a body",
         [](Bodies& bodies) {
             bodies.link(bodies.add({.mass = 2, .position = {5}}), 1, {3, 0.5});
         }},
        {"a body less", [](Bodies& bodies) { bodies.remove(1); }},
    };
}

// Cached accelerations, flows and factorised equations must be discarded when they become invalid.
TEST(LinkedBodies, StepAfterAChangeAsNewOnesDo) {
    for_each_kind([](const Method& method, Precision precision) {
        Bodies run = linked(precision);
        run.step(method, {rate, 0, 7});
        for (const Change& change : changes()) {
            Bodies changed = run;
            change.make(changed);
            Bodies fresh = rebuilt(changed);
            ASSERT_EQ(hash_of(changed), hash_of(fresh)) << change.what;
            changed.step(method, {rate, 7, 5});
            fresh.step(method, {rate, 7, 5});
            EXPECT_EQ(hash_of(changed), hash_of(fresh)) << change.what;
        }
    });
}

void expect_as_new(Bodies bodies, const Method& method, const Steps& steps) {
    Bodies fresh = rebuilt(bodies);
    bodies.step(method, steps);
    fresh.step(method, steps);
    EXPECT_EQ(hash_of(bodies), hash_of(fresh)) << method.name;
}

/// Bodies with springs, linear drag and links only. Implicit methods keep their factorised
/// equations.
Bodies linear(Precision precision) {
    Bodies bodies(2, precision);
    bodies.set_gravity({0.25, -4});
    for (std::size_t row = 0; row < 3; ++row) {
        const auto i = static_cast<double>(row);
        bodies.add({.mass = mass_of(row), .position = {i, 2 - i}}, LinearDrag{0.2 * i});
    }
    bodies.attach(1, Spring{{1, 1, 0}, 400, 2});
    bodies.link(0, 1, {.stiffness = 300, .damping = 0.3});
    bodies.link(2, 1, {.stiffness = 500});
    return bodies;
}

void expect_other_ways_as_new(Bodies run, const Method& method) {
    run.step(method, {rate, 0, 4});
    for (const Method& other : methods())
        if (other.order != exact_order) expect_as_new(run, other, {rate, 4, 3});
    for (const Rate& other : {Rate{32}, Rate{128}}) expect_as_new(run, method, {other, 4, 3});
    for (const Damping damping : {Damping::in_kick, Damping::in_drift}) {
        expect_as_new(run, method, {rate, 4, 3, damping});
        Bodies there = run;
        there.step(method, {rate, 4, 3, damping});
        expect_as_new(there, method, {rate, 7, 3});
    }
}

TEST(LinkedBodies, StepWithAnotherSettingAsNewOnesDo) {
    for (const Method& method : methods()) {
        if (method.order == exact_order) continue;
        expect_other_ways_as_new(linked(Precision::single), method);
        expect_other_ways_as_new(linear(Precision::double_), method);
    }
}

// An implicit method solves the equations of all rows together, to a few units of round-off of the
// largest speed, below 8 m/s. These forces do not amplify the error.
TEST(LinkedBodies, DoNotAffectOthers) {
    constexpr int steps = 64;
    for_each_kind([](const Method& method, Precision precision) {
        Bodies with = linked(precision);
        Bodies without = assorted(precision);
        with.step(method, {rate, 0, steps});
        without.step(method, {rate, 0, steps});
        const double unit = precision == Precision::single ? 0x1p-24 : 0x1p-53;
        const double slack = method.evaluations == 0 ? 2 * std::sqrt(steps) * unit * 8 : 0;
        EXPECT_NE(with.position(4), without.position(4));
        for (const std::size_t row : {5U, 6U, 7U}) {
            EXPECT_LE(largest(with.position(row) - without.position(row)), slack) << row;
            EXPECT_LE(largest(with.velocity(row) - without.velocity(row)), slack) << row;
        }
    });
}

int kicks_of(const Method& method) {
    int kicks = 0;
    for (const auto& stage : std::get<Splitting>(method.rule).stages())
        kicks += stage.move == Move::kick ? 1 : 0;
    return kicks;
}

// The first kick of a step reuses the acceleration of the last kick of the step before, unless a
// body was moved. Other methods reuse nothing.
TEST(LinkedBodies, EvaluateAsOftenAsTheMethodSaysAndOnceMore) {
    for (const Method& method : methods()) {
        if (method.evaluations == 0 || method.order == exact_order) continue;
        const bool splits = std::holds_alternative<Splitting>(method.rule);
        const int extra = splits ? kicks_of(method) - method.evaluations : 0;
        EXPECT_TRUE(extra == 0 || extra == 1) << method.name;
        Bodies bodies = linked(Precision::double_);
        const auto step = [&](Damping damping) {
            const std::int64_t before = bodies.evaluations();
            bodies.step(method, {rate, 0, 1, damping});
            return bodies.evaluations() - before;
        };
        EXPECT_EQ(step(Damping::in_drift), method.evaluations + extra) << method.name;
        EXPECT_EQ(step(Damping::in_drift), method.evaluations) << method.name;
        bodies.set_velocity(3, {1, 1, 0});
        bodies.set_position(3, {1, 1, 0});
        EXPECT_EQ(step(Damping::in_drift), method.evaluations + extra) << method.name;
        EXPECT_EQ(step(Damping::in_kick), method.evaluations + extra) << method.name;
        EXPECT_EQ(step(Damping::in_kick), method.evaluations + extra) << method.name;
    }
}

std::vector<LinkEnds> ends_of(const Bodies& bodies) {
    std::vector<LinkEnds> ends;
    for (std::size_t i = 0; i < bodies.link_count(); ++i) ends.push_back(bodies.link_ends(i));
    return ends;
}

// The last row moves to the place of the removed one; links keep their order and their numbers.
TEST(LinkedBodies, AreRemovedWithTheirLinks) {
    Bodies bodies = linked(Precision::double_);
    bodies.link(7, 0, {.stiffness = 5, .damping = 6, .rest_length = 7});
    bodies.link(5, 7, {.stiffness = 8});
    bodies.remove(1);
    const LinkEnds point{3, {}, {0, 9}};
    EXPECT_EQ(ends_of(bodies), (std::vector<LinkEnds>{{2, 4}, {4, 3}, {1, 0}, {5, 1}, point}));
    const Link link = bodies.link_at(2);
    EXPECT_EQ(link.stiffness, 5);
    EXPECT_EQ(link.damping, 6);
    EXPECT_EQ(link.rest_length, 7);
    bodies.remove(6);
    EXPECT_EQ(bodies.link_count(), 5U);
    bodies.link_to_point(5, {1, 2}, {.stiffness = 8});
    bodies.remove(4);
    EXPECT_EQ(ends_of(bodies), (std::vector<LinkEnds>{{1, 0}, {4, 1}, point, {4, {}, {1, 2}}}));
    EXPECT_EQ(bodies.linked_rows(), (std::vector<bool>{true, true, false, true, true}));
    bodies.remove(4);
    bodies.remove(0);
    EXPECT_EQ(ends_of(bodies), (std::vector<LinkEnds>{{0, {}, {0, 9}}}));
}

struct Linked {
    std::size_t a;
    std::size_t b;
    Link link;
};

/// A net of 11 × 9 bodies of several masses with these links.
Bodies net(Precision precision, const std::vector<Linked>& links) {
    Bodies bodies(2, precision);
    for (std::size_t row = 0; row < 99; ++row) {
        const auto i = static_cast<double>(row);
        bodies.add({.mass = 1 + 0.125 * static_cast<double>(row % 5),
                    .position = {i - 11 * std::floor(i / 11), std::floor(i / 11)},
                    .velocity = {std::sin(i), std::cos(3 * i)}});
    }
    for (const auto& [a, b, link] : links) bodies.link(a, b, link);
    return bodies;
}

TEST(LinkedBodies, MoveTheSameInWhateverOrderTheyAreLinked) {
    constexpr Link link{.stiffness = 30, .damping = 0.75, .rest_length = 0.5};
    std::vector<Linked> alternating;
    for (std::size_t row = 0; row < 99; ++row) {
        if (row % 11 != 10) alternating.push_back({row, row + 1, link});
        if (row < 88) alternating.push_back({row, row + 11, link});
    }
    std::vector<Linked> backwards(alternating.rbegin(), alternating.rend());
    for_each_kind([&](const Method& method, Precision precision) {
        Bodies one = net(precision, alternating);
        Bodies other = net(precision, backwards);
        const std::uint64_t start = hash_of(one);
        for (Bodies* bodies : {&one, &other}) bodies->step(method, {rate, 0, 10});
        EXPECT_NE(hash_of(one), start);
        EXPECT_EQ(hash_of(one), hash_of(other));
    });
}

/// The largest difference of two velocities, m/s.
double velocity_difference(const Bodies& one, const Bodies& other) {
    double most = 0;
    for (std::size_t row = 0; row < one.size(); ++row)
        most = std::max(most, largest(one.velocity(row) - other.velocity(row)));
    return most;
}

// Dampers are stepped in batches of links that share no body: every other link of a chain, and as
// many links as there are rows between their two bodies. RK4 evaluates their forces instead. The
// drift of velocity Verlet has order 2: with rates of up to 30/s, its error after 1/8 s at 8192 Hz
// is below (30/8192)² times a speed of 2 m/s, 2.7e-5; a damper left out or applied twice at any
// link changes the velocities by 2·b·t = 0.2 m/s.
TEST(LinkedBodies, AreDampedLinkByLinkInRunsOfAnyShift) {
    for (const bool length : {false, true})
        for (const int shift : {1, -1, 2, 3, -3, 5, 11, -17, 40}) {
            std::vector<Linked> links;
            for (std::size_t row = 0; row + std::abs(shift) < 99; ++row) {
                const std::size_t other = row + std::abs(shift);
                links.push_back(
                    {shift > 0 ? row : other,
                     shift > 0 ? other : row,
                     {.stiffness = 30, .damping = 0.75, .rest_length = length ? 0.5 : 0.0}});
            }
            Bodies drifted = net(Precision::double_, links);
            Bodies evaluated = drifted;
            const Bodies start = drifted;
            const Rate fine{8192};
            drifted.step(find_method("velocity_verlet"), {fine, 0, 1024, Damping::in_drift});
            evaluated.step(find_method("rk4"), {fine, 0, 1024});
            EXPECT_LT(velocity_difference(drifted, evaluated), 2.7e-5)
                << shift << (length ? ", with a length" : "");
            EXPECT_GT(velocity_difference(drifted, start), 0.2) << shift;
        }
}

// Links without stiffness or length: a half-step multiplies the relative velocity of its bodies by
// e^(−b·(1/m₁ + 1/m₂)·dt/2) and keeps their momentum. To a
// point, 1/m₂ is 0. Each of the 2 × 9 half-steps rounds a speed
// of at most 2 m/s a few times. Another order of the dampers changes the velocities by b²·dt² ~
// 1e-3.
TEST(LinkedBodies, AreDampedInTheReportedOrder) {
    constexpr double dt = 1.0 / 64;
    Bodies bodies(1, Precision::double_);
    std::array<double, 6> v{};
    for (std::size_t row = 0; row < v.size(); ++row) {
        v[row] = std::sin(5.0 * static_cast<double>(row));
        bodies.add({.mass = mass_of(row), .position = {0.5}, .velocity = {v[row]}});
    }
    const auto link = [&](std::size_t a, std::size_t b, double damping) {
        bodies.link(a, b, {.damping = damping});
    };
    link(4, 0, 3);
    link(2, 3, 2);
    link(0, 1, 2);
    link(3, 4, 2);
    link(1, 2, 2);
    link(5, 2, 1);
    link(4, 5, 2);
    for (const std::size_t row : {5, 2}) bodies.link_to_point(row, {0.25}, {.damping = 1.5});
    const auto damp = [&](std::size_t i) {
        const auto [a, b, point] = bodies.link_ends(i);
        const double inverse = 1 / mass_of(a) + (b ? 1 / mass_of(*b) : 0);
        const double lost = -std::expm1(-bodies.link_at(i).damping * inverse * dt / 2);
        const double impulse = ((b ? v[*b] : 0) - v[a]) * lost / inverse;
        v[a] += impulse / mass_of(a);
        if (b) v[*b] -= impulse / mass_of(*b);
    };
    const std::vector<std::size_t> order = bodies.damping_order();
    std::for_each(order.begin(), order.end(), damp);
    std::for_each(order.rbegin(), order.rend(), damp);
    bodies.step(find_method("velocity_verlet"), {rate, 0, 1, Damping::in_drift});
    for (std::size_t row = 0; row < v.size(); ++row)
        EXPECT_NEAR(bodies.velocity(row)[0], v[row], 1e-14) << row;
}

}  // namespace
}  // namespace oiler::test
