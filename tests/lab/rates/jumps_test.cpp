// SPDX-License-Identifier: MIT
#include <cmath>
#include <functional>
#include <numbers>

#include "lab/measured_rates.hpp"

namespace oiler::test {
namespace {

/// The height above the start after n steps of h seconds.
using Height = std::function<double(int n, double h)>;

struct Jump {
    double apex = 0;
    double apex_time = 0;
    double landing = 0;
};

/// The jump as drawn: straight lines between the steps.
Jump jump_of(const Height& height, double h) {
    Jump jump;
    int n = 1;
    for (; height(n, h) >= 0; ++n)
        if (height(n, h) > jump.apex) jump = {height(n, h), n * h, 0};
    const double above = height(n - 1, h);
    jump.landing = h * (n - 1 + above / (above - height(n, h)));
    return jump;
}

constexpr double v0 = 9.1;  // m/s
constexpr double g = 20;    // m/s²
constexpr double across = 4;

const std::vector<Rate> usual{20, 30, 50, 60, 100, 240};

// Each step first slows down, then moves: x = v0·n·h − g·h²·n(n+1)/2, highest at the whole n next
// to v0/(g·h) − ½, where it is v0²/2g − v0·h/2 + g·h²/8 but for less than g·h²/8.
double semi_implicit(int n, double h) { return v0 * n * h - g * h * h * n * (n + 1) / 2; }
double exact(int n, double h) { return v0 * n * h - g * (n * h) * (n * h) / 2; }

void expect_jump(const Rates& rates, const Height& height, std::size_t method) {
    for (std::size_t i = 0; i < usual.size(); ++i) {
        const double h = 1.0 / static_cast<double>(usual[i]);
        const Jump jump = jump_of(height, h);
        // Hundreds of roundings of 2 m; twice as many for the crossing of the last line.
        EXPECT_NEAR(value_of(rates, "apex", method, i), jump.apex, 1e-12) << usual[i];
        EXPECT_NEAR(value_of(rates, "time of the apex", method, i), jump.apex_time, 1e-12);
        EXPECT_NEAR(value_of(rates, "time of landing", method, i), jump.landing, 1e-12);
        EXPECT_NEAR(value_of(rates, "place of landing", method, i), across * jump.landing, 1e-11);
    }
}

const std::string jump =
    "[scene]\naxes = 2\nrate = 60\nduration = 1.2\n[gravity]\nacceleration = [0.0, -20.0]\n"
    "[[body]]\nname = \"player\"\nposition = [3.0, 7.0]\nvelocity = [4.0, 9.1]\n";

TEST(RatesOfAJump, AreThoseOfTheStepsByTheory) {
    const Rates rates = rates_of(jump, usual, {"semi_implicit_euler", "velocity_verlet"});
    EXPECT_EQ(rates.body, "player");
    EXPECT_EQ(rates.rates, usual);
    EXPECT_EQ(rates.quantities.size(), 4U);
    expect_jump(rates, semi_implicit, 0);
    expect_jump(rates, exact, 1);
    for (std::size_t i = 0; i < usual.size(); ++i) {
        const double h = 1.0 / static_cast<double>(usual[i]);
        const double highest = v0 * v0 / (2 * g) - v0 * h / 2 + g * h * h / 8;
        const double apex = value_of(rates, "apex", 0, i);
        EXPECT_LE(apex, highest + 1e-12);
        EXPECT_GE(apex, highest - g * h * h / 8 - 1e-12);
    }
}

TEST(RatesOfAJump, HaveTheTruth) {
    const Rates rates = rates_of(jump, usual, {"exact"});
    const auto truth = [&](const char* part) { return quantity_of(rates, part).truth; };
    // A cubic through positions and velocities reproduces the parabola.
    EXPECT_NEAR(truth("apex"), v0 * v0 / (2 * g), 1e-12);
    // The maximum of a parabola is found to the square root of the round-off.
    EXPECT_NEAR(truth("time of the apex"), v0 / g, 1e-7);
    EXPECT_NEAR(truth("time of landing"), 2 * v0 / g, 1e-12);
    EXPECT_NEAR(truth("place of landing"), across * 2 * v0 / g, 1e-11);
    EXPECT_EQ(quantity_of(rates, "apex").unit, "m");
    EXPECT_EQ(quantity_of(rates, "time of landing").unit, "s");
}

// A jump to the left, with gravity to the right.
TEST(RatesOfAJump, GoAgainstGravityWhereverThatIs) {
    const Rates rates = rates_of(
        "[scene]\naxes = 2\nrate = 60\nduration = 1.2\n[gravity]\nacceleration = [20.0, 0.0]\n"
        "[[body]]\nvelocity = [-9.1, 4.0]\n",
        usual, {"semi_implicit_euler", "velocity_verlet"});
    EXPECT_EQ(rates.body, "body 0");
    expect_jump(rates, semi_implicit, 0);
    expect_jump(rates, exact, 1);
}

TEST(RatesOfAJump, AreOfTheGivenBody) {
    const Rates rates = rates_of(jump + "[[body]]\nname = \"b\"\nvelocity = [0.0, 4.0]\n", usual,
                                 {"velocity_verlet"}, 1);
    EXPECT_EQ(rates.body, "b");
    EXPECT_NEAR(quantity_of(rates, "apex").truth, 4 * 4 / (2 * g), 1e-12);
    // 4 m/s against 20 m/s²: the apex is at 0.2 s, where all rates have a step.
    for (std::size_t i = 0; i < usual.size(); ++i)
        EXPECT_NEAR(value_of(rates, "apex", 0, i), 0.4, 1e-12) << usual[i];
}

TEST(RatesOfAJump, SpreadFromTheLeastToTheMost) {
    const Rates rates = rates_of(jump, usual, {"semi_implicit_euler"});
    const double low = jump_of(semi_implicit, 1.0 / 20).apex;
    const double high = jump_of(semi_implicit, 1.0 / 240).apex;
    EXPECT_NEAR(quantity_of(rates, "apex").lines.front().spread_percent,
                100 * (high - low) / (v0 * v0 / (2 * g)), 1e-9);
}

// At 2 Hz semi-implicit Euler loses 10 m/s before it moves: the body never leaves the ground.
TEST(RatesOfAJump, ThatDoesNotRiseAreUnknown) {
    const Rates rates = rates_of(jump, {2, 60}, {"semi_implicit_euler"});
    const RatesLine& line = quantity_of(rates, "apex").lines.front();
    EXPECT_TRUE(std::isnan(line.values[0]));
    EXPECT_FALSE(std::isnan(line.values[1]));
    EXPECT_TRUE(std::isnan(line.spread_percent));
}

TEST(RatesOfAFall, AreNoJump) {
    const Rates rates = rates_of(
        "[scene]\naxes = 2\nduration = 1.0\n[gravity]\nacceleration = [0.0, -20.0]\n"
        "[[body]]\nvelocity = [4.0, -1.0]\n",
        usual, {"velocity_verlet"});
    EXPECT_TRUE(rates.quantities.empty());
}

TEST(RatesOfAJump, WithoutLandingHaveNone) {
    std::string brief = jump;
    brief.replace(brief.find("1.2"), 3, "0.8");
    const Rates rates = rates_of(brief, usual, {"velocity_verlet"});
    EXPECT_NE(find(rates, "apex"), nullptr);
    EXPECT_EQ(find(rates, "time of landing"), nullptr);
    EXPECT_EQ(find(rates, "place of landing"), nullptr);
}

// At 0.3 s the body still rises, at 20 m/s².
TEST(RatesOfAJump, ThatEndsOnTheWayUpHaveNoApex) {
    std::string brief = jump;
    brief.replace(brief.find("1.2"), 3, "0.3");
    EXPECT_TRUE(rates_of(brief, usual, {"velocity_verlet"}).quantities.empty());
}

// All apexes of an elastic ball are equally high. The first is at 3 m/s / 20 m/s².
TEST(RatesOfAJump, HaveTheFirstOfEqualApexes) {
    const Rates rates = rates_of(
        "[scene]\naxes = 2\nrate = 60\nduration = 6.0\n[gravity]\nacceleration = [0.0, -20.0]\n"
        "[[plane]]\nnormal = [0.0, 1.0]\nrestitution = 1.0\n"
        "[[body]]\nposition = [0.0, 0.25]\nvelocity = [1.0, 3.0]\ncontact = 0.25\n",
        usual, {"velocity_verlet", "rk4", "exact"});
    EXPECT_NEAR(quantity_of(rates, "time of the apex").truth, 3 / g, 1e-7);
    for (std::size_t method = 0; method < 3; ++method)
        for (std::size_t i = 0; i < usual.size(); ++i)
            EXPECT_NEAR(value_of(rates, "time of the apex", method, i), 3 / g,
                        0.5000001 / static_cast<double>(usual[i]))
                << usual[i];
}

// The spring lifts a weight from its lowest point, 0.5 m under the balance: 1 m, after half a
// period, again and again.
TEST(RatesOfAJump, HaveTheFirstApexOfASpring) {
    const Rates rates = rates_of(
        "[scene]\naxes = 1\nrate = 60\nduration = 10.0\n[gravity]\nacceleration = [-20.0]\n" +
            on_spring(-1, 40),
        usual, {"velocity_verlet", "exact"});
    const double half_period = std::numbers::pi / std::sqrt(40.0);
    EXPECT_NEAR(quantity_of(rates, "apex").truth, 1, 1e-6);
    // A slope of cubics over h has an error of the order of (ωh)³, a hundredth of that here.
    EXPECT_NEAR(quantity_of(rates, "time of the apex").truth, half_period, 1e-5);
    for (std::size_t method = 0; method < 2; ++method)
        for (std::size_t i = 2; i < usual.size(); ++i)
            EXPECT_NEAR(value_of(rates, "time of the apex", method, i), half_period,
                        1.0 / static_cast<double>(usual[i]))
                << usual[i];
}

}  // namespace
}  // namespace oiler::test
