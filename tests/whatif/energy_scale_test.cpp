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

}  // namespace
}  // namespace oiler::test
