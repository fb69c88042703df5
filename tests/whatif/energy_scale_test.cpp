// SPDX-License-Identifier: MIT
// Changes of the energy are a share of what moves, whatever the zero of the potential.
#include "oiler/whatif/energy_scale.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

// An oscillator of 1 J: its energy is all kinetic in the middle, all potential at the ends.
TEST(EnergyScale, OfAnOscillatorIsItsEnergy) {
    for (const double zero : {0.0, -1e6, 1e6}) {
        EnergyScale scale;
        for (int i = 0; i <= 64; ++i) {
            const double c = std::cos(i / 10.0);
            scale.add({.kinetic = 1 - c * c, .potential = zero + c * c});
        }
        EXPECT_NEAR(scale.joules(), 1, 1e-2) << zero;  // 0.1 rad from an extreme is 1 % of it
    }
}

TEST(EnergyScale, IsTheLargerOfKineticEnergyAndPotentialRangeSoFar) {
    EnergyScale scale;
    EXPECT_EQ(scale.joules(), 0);
    const auto with = [&](double kinetic, double potential) {
        scale.add({kinetic, potential});
        return scale.joules();
    };
    EXPECT_EQ(with(2, 5), 2);
    EXPECT_TRUE(scale.is_kinetic());
    EXPECT_EQ(with(1, 8), 3);
    EXPECT_FALSE(scale.is_kinetic());
    EXPECT_EQ(with(7, 6), 7);
    EXPECT_EQ(with(0, 6), 7);
}

// The last place of 1 m is 2^-52 m in double and 2^-23 m in float. A body of 2 kg that moves by ten
// of them in each of 60 steps per second has (600·2^-52 m/s)²·1 kg, or (600·2^-23 m/s)²·1 kg.
TEST(RoundOffEnergy, IsOfTenLastPlacesOfACoordinatePerStep) {
    for (const auto& [precision, place] : {std::pair(Precision::double_, std::ldexp(1, -52)),
                                           {Precision::single, std::ldexp(1, -23)}}) {
        World world(1, {.rate = {60}, .precision = precision});
        (void)world.spawn(Body{.mass = 2, .position = {1}});
        EXPECT_NEAR(round_off_energy(world), 360'000 * place * place, 1e-9 * place * place);
        (void)world.spawn(Body{.mass = 1, .position = {-2}});
        EXPECT_NEAR(round_off_energy(world), 1'080'000 * place * place, 1e-9 * place * place);
    }
    EXPECT_EQ(round_off_energy(World(2)), 0);
}

// A body of 3 kg at a height of 8 m has 240 J, below the zero −240 J.
TEST(RoundOffEnergy, IsOfTenLastPlacesOfTheEnergyIfTheyAreMore) {
    for (const double height : {8.0, -8.0}) {
        World world(1, {.rate = {60}});
        world.set_gravity({-10});
        (void)world.spawn(Body{.mass = 3, .position = {height}});
        EXPECT_NEAR(round_off_energy(world), 2400 * std::ldexp(1, -52), 1e-20);
    }
}

/// The scale of 2 s of a body that hangs from a spring at its rest, or is pushed, m/s.
double scale_of_hanging(double push) {
    World world(1, {.rate = {60}});
    world.set_gravity({-9.81});
    constexpr double stiffness = 9;
    (void)world.spawn(Body{.mass = 0.3, .position = {0.97}, .velocity = {push}},
                      Spring{.anchor = {0.97 + 0.3 * 9.81 / stiffness}, .stiffness = stiffness});
    EnergyScale scale;
    for (int step = 0; step < 120; ++step) {
        world.step();
        scale.add(world.energy());
    }
    EXPECT_GT(scale.joules(), 0) << "its rest is not a double";
    return joules_of(scale, world);
}

TEST(EnergyScale, OfAWorldAtRestIsNone) {
    EXPECT_EQ(scale_of_hanging(0), 0);
    EXPECT_NEAR(scale_of_hanging(1e-3), 0.3 * 1e-6 / 2, 1e-8);
}

}  // namespace
}  // namespace oiler::test
