// SPDX-License-Identifier: MIT
// Impacts on walls, which gravity does not lead to.
#include <fmt/core.h>

#include "lab/measured_rates.hpp"

namespace oiler::test {
namespace {

const std::string wall = "[[plane]]\nnormal = [-1.0, 0.0]\noffset = -{}\nrestitution = {}\n";

std::string ball(const std::string& rest) {
    return "[scene]\naxes = 2\nrate = 60\nduration = 5.0\n" + rest;
}

// From the middle, 3.5 m at 3 m/s.
TEST(RatesAtAWall, HaveTheTimeOfTheFirstImpact) {
    const Rates rates =
        rates_of(ball("[[body]]\nposition = [0.0, 0.0]\nvelocity = [3.0, 0.0]\ncontact = 0.5\n" +
                      fmt::format(fmt::runtime(wall), 4.0, 0.5)),
                 {30, 60}, {"velocity_verlet", "exact"});
    EXPECT_NEAR(quantity_of(rates, "time of the first impact").truth, 3.5 / 3, 1e-12);
    for (const std::size_t method : {0, 1})
        for (const std::size_t rate : {0, 1})
            EXPECT_NEAR(value_of(rates, "time of the first impact", method, rate), 3.5 / 3, 1e-12);
}

// It slides along the floor, which it touches from the start, and meets the wall after 2.9 m.
TEST(RatesAtAWall, OfASlidingBallAreThoseOfTheWall) {
    const Rates rates =
        rates_of(ball("[gravity]\nacceleration = [0.0, -9.81]\n"
                      "[[plane]]\nnormal = [0.0, 1.0]\nrestitution = 0.5\n"
                      "[[body]]\nposition = [0.0, 0.1]\nvelocity = [2.0, 0.0]\ncontact = 0.1\n" +
                      fmt::format(fmt::runtime(wall), 3.0, 0.5)),
                 {60}, {"velocity_verlet"});
    EXPECT_NEAR(quantity_of(rates, "time of the first impact").truth, 1.45, 1e-9);
    EXPECT_NEAR(value_of(rates, "time of the first impact", 0, 0), 1.45, 1e-9);
    EXPECT_EQ(find(rates, "height of bounce"), nullptr);
}

// Between walls at 2 m the ball of 0.5 m reaches 1.5 m, at sample times too: every half second.
TEST(RatesBetweenWalls, HaveTheDistanceOfTheWallsAsAmplitude) {
    const Rates rates =
        rates_of(ball("[[body]]\nposition = [0.0, 0.0]\nvelocity = [3.0, 0.0]\ncontact = 0.5\n" +
                      fmt::format(fmt::runtime(wall), 2.0, 1.0) +
                      "[[plane]]\nnormal = [1.0, 0.0]\noffset = -2.0\nrestitution = 1.0\n"),
                 {60}, {"exact"});
    EXPECT_NEAR(quantity_of(rates, "amplitude").truth, 1.5, 1e-12);
    EXPECT_NEAR(quantity_of(rates, "period").truth, 2, 1e-12);
}

}  // namespace
}  // namespace oiler::test
