// SPDX-License-Identifier: MIT
#include "oiler/compare/captures/changes.hpp"

#include "oiler/sim/bodies.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Bodies = std::vector<BodyState>;

const Bodies bodies{{"a", {1, 2, 3}, {4, 5, 6}},
                    {"b", {-1, -2, -3}, {-4, -5, -6}},
                    {"c", {0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}}};

template <class Real>
Real moved(Real value, int steps) {
    for (; steps > 0; --steps) value = std::nextafter(value, Real(1000));
    return value;
}

TEST(StateChanges, OfEqualBodiesAreEmpty) {
    EXPECT_EQ(describe_state_change(bodies, bodies, "double"), "");
    EXPECT_EQ(describe_state_change({}, {}, "float"), "");
}

TEST(StateChanges, NameEachField) {
    const char* const names[] = {"x", "y", "z", "vx", "vy", "vz"};
    for (std::size_t i = 0; i < 6; ++i) {
        Bodies actual = bodies;
        double& value = i < 3 ? actual[0].position[i] : actual[0].velocity[i - 3];
        value = moved(value, 7);
        const std::string words = describe_state_change(bodies, actual, "double");
        const std::string start =
            std::string("body 'a', ") + names[i] + ": " + std::to_string(i + 1) + " → ";
        EXPECT_TRUE(words.starts_with(start)) << words;
        EXPECT_TRUE(words.ends_with(", 7 ulp")) << words;
    }
}

// The change of b is larger in metres, the change of c in units in the last place.
TEST(StateChanges, NameTheLargestInUlps) {
    Bodies actual = bodies;
    actual[1].position[2] = moved(-3.0, 2);
    actual[2].velocity[1] = moved(0.5, 3);
    actual[0].position[0] = moved(1.0, 1);
    EXPECT_EQ(describe_state_change(bodies, actual, "double"),
              "body 'c', vy: 0.5 → 0.5000000000000003, 3 ulp");
}

TEST(StateChanges, CountUlpsOfFloat) {
    const auto before = static_cast<double>(0.1F);
    const Bodies golden{{"a", {before}, {}}};
    const Bodies actual{{"a", {static_cast<double>(moved(0.1F, 5))}, {}}};
    EXPECT_EQ(describe_state_change(golden, actual, "float"),
              "body 'a', x: 0.1 → 0.10000004, 5 ulp");
}

TEST(StateChanges, ASignOfZeroIsAChange) {
    const Bodies golden{{"a", {0.0}, {}}};
    const Bodies actual{{"a", {-0.0}, {}}};
    EXPECT_EQ(describe_state_change(golden, actual, "double"), "body 'a', x: 0 → -0, 0 ulp");
}

TEST(StateChanges, NameMissingAndNewBodies) {
    const Bodies one{bodies[1]};
    EXPECT_EQ(describe_state_change(bodies, one, "double"), "body 'a' and 1 more are missing");
    EXPECT_EQ(describe_state_change({bodies[0], bodies[1]}, one, "double"), "body 'a' is missing");
    EXPECT_EQ(describe_state_change(one, {bodies[1], bodies[2]}, "double"), "body 'c' is new");
    EXPECT_EQ(describe_state_change(one, bodies, "double"), "body 'a' and 1 more are new");
}

TEST(StateChanges, NameSwappedBodies) {
    Bodies actual = bodies;
    std::swap(actual[0].position, actual[2].position);
    std::swap(actual[0].velocity, actual[2].velocity);
    EXPECT_EQ(describe_state_change(bodies, actual, "double"), "bodies 'a' and 'c' are swapped");
}

// Only positions are exchanged, or one bit of a third body differs.
TEST(StateChanges, DoNotTakeOtherExchangesForASwap) {
    Bodies half = bodies;
    std::swap(half[0].position, half[2].position);
    EXPECT_TRUE(describe_state_change(bodies, half, "double").starts_with("body '"));
    for (const auto& [first, second, third] :
         {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}) {
        Bodies actual = bodies;
        std::swap(actual.at(first).position, actual.at(second).position);
        std::swap(actual.at(first).velocity, actual.at(second).velocity);
        double& bit = actual.at(third).velocity[2];
        bit = moved(bit, 1);
        EXPECT_TRUE(describe_state_change(bodies, actual, "double").starts_with("body '"));
    }
}

TEST(StateChanges, NameAnotherOrder) {
    EXPECT_EQ(describe_state_change(bodies, {bodies[1], bodies[0], bodies[2]}, "double"),
              "bodies in another order");
}

}  // namespace
}  // namespace oiler::test
