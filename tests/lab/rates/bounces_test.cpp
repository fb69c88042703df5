// SPDX-License-Identifier: MIT
#include <cmath>

#include "lab/measured_rates.hpp"

namespace oiler::test {
namespace {

constexpr double g = 20;  // m/s²
constexpr double dropped = 2;
constexpr double kept = 0.8;

/// The height of bounce n of a ball that falls 2 m.
double bounce(int n) { return dropped * std::pow(kept, 2 * n); }

const std::string ball =
    "[scene]\naxes = 2\nrate = 60\nduration = 6.0\n[gravity]\nacceleration = [0.0, -20.0]\n"
    "[[plane]]\nnormal = [3.0, 0.0]\noffset = -30.0\n"
    "[[plane]]\nnormal = [0.0, 2.0]\noffset = 1.0\nrestitution = 0.8\n"
    "[[body]]\nposition = [0.0, 2.75]\nvelocity = [0.5, 0.0]\ncontact = 0.25\n"
    "[[body]]\nposition = [0.0, 2.75]\n";

// As drawn, an apex is at most g·h²/8 lower than the curve. The last bounce above 1 % is n = 10;
// the ball is below from then on, at the height 0.02 m of its fall.
TEST(RatesOfABounce, AreThoseOfTheClosedForm) {
    const Rates rates = rates_of(ball, {30, 60, 240}, {"velocity_verlet", "exact"});
    for (const int n : {1, 3, 10}) {
        const std::string name = "height of bounce " + std::to_string(n);
        EXPECT_NEAR(quantity_of(rates, name).truth, bounce(n), 1e-12) << n;
        for (std::size_t i = 0; i < 3; ++i)
            for (const std::size_t method : {0, 1}) {
                const double h = 1.0 / static_cast<double>(rates.rates[i]);
                const double shown = value_of(rates, name, method, i);
                EXPECT_LE(shown, bounce(n) + 1e-12) << n;
                EXPECT_GE(shown, bounce(n) - g * h * h / 8 - 1e-12) << n;
            }
    }
    const int last = 10;
    ASSERT_GT(bounce(last), 0.01 * dropped);
    ASSERT_LT(bounce(last + 1), 0.01 * dropped);
    double t = std::sqrt(2 * dropped / g);
    for (int n = 1; n < last; ++n) t += 2 * std::sqrt(2 * bounce(n) / g);
    t += std::sqrt(2 * bounce(last) / g) + std::sqrt(2 * (bounce(last) - 0.01 * dropped) / g);
    EXPECT_NEAR(quantity_of(rates, "time at which bounces").truth, t, 1e-9);
    EXPECT_NEAR(value_of(rates, "time at which bounces", 0, 2), t, 1 / 240.0);
}

TEST(RatesOfABounce, NeedAContact) {
    const Rates rates = rates_of(ball, {60}, {"exact"}, 1);
    EXPECT_EQ(find(rates, "height of bounce"), nullptr);
    EXPECT_EQ(find(rates, "time at which bounces"), nullptr);
}

/// A ball of 0.25 m that starts 2 m above a floor.
std::string ball_for(double seconds, double restitution) {
    return fmt::format(
        "[scene]\naxes = 2\nrate = 60\nduration = {}\n[gravity]\nacceleration = [0.0, -20.0]\n"
        "[[plane]]\nnormal = [0.0, 1.0]\nrestitution = {}\n"
        "[[body]]\nposition = [0.0, 2.25]\ncontact = 0.25\n",
        seconds, restitution);
}
const double fall = std::sqrt(2 * dropped / g);  // s

// A run may end anywhere, also within 1 % of the height and a moment before or after an impact.
TEST(RatesOfABounce, OfAnElasticBallNeverStayLow) {
    for (const double early : {0.03, 0.001, 1e-5, 0.0, -1e-5, -0.001, -0.03}) {
        const Rates rates = rates_of(ball_for(5 * fall - early, 1), {60, 240}, {"exact"});
        EXPECT_EQ(find(rates, "time at which bounces"), nullptr) << early;
        EXPECT_NEAR(quantity_of(rates, "height of bounce 1").truth, dropped, 1e-12) << early;
    }
}

// Between two samples a cubic would pass below the floor, or stop above it.
TEST(RatesOfABounce, OfAnElasticBallHaveHalfTheDropAsAmplitude) {
    for (const double seconds : {5.3 * fall, 7.0 * fall, 9.9 * fall}) {
        const Rates rates = rates_of(ball_for(seconds, 1), {60}, {"exact"});
        EXPECT_NEAR(quantity_of(rates, "amplitude").truth, dropped / 2, 1e-12) << seconds;
    }
}

TEST(RatesOfABounce, StayLowOnceALowApexIsSeen) {
    double t = fall;
    for (int n = 1; n < 11; ++n) t += 2 * std::sqrt(2 * bounce(n) / g);
    const double rise = std::sqrt(2 * bounce(11) / g);
    for (const double after : {-0.5 * rise, 0.5 * rise})
        EXPECT_EQ(find(rates_of(ball_for(t + after, kept), {240}, {"exact"}), "time at which"),
                  nullptr)
            << after;
    EXPECT_NE(find(rates_of(ball_for(t + 1.5 * rise, kept), {240}, {"exact"}), "time at which"),
              nullptr);
}

TEST(RatesOfABounce, ThatIsNotOverHasNoHeight) {
    const double rise = kept * fall;
    EXPECT_EQ(
        find(rates_of(ball_for(fall + 0.9 * rise, kept), {60}, {"exact"}), "height of bounce"),
        nullptr);
    EXPECT_NEAR(quantity_of(rates_of(ball_for(fall + 1.1 * rise, kept), {60}, {"exact"}),
                            "height of bounce 1")
                    .truth,
                bounce(1), 1e-12);
}

TEST(RatesOfAnImpact, HaveItsTime) {
    for (const double restitution : {0.0, 0.5}) {
        const Rates rates = rates_of(ball_for(2, restitution), {20, 60}, {"exact"});
        const RatesQuantity impact = quantity_of(rates, "time of the first impact");
        EXPECT_NEAR(impact.truth, fall, 1e-12);
        EXPECT_NEAR(impact.lines[0].values[0], fall, 1e-9);
        EXPECT_EQ(find(rates, "height of bounce") == nullptr, restitution == 0);
        EXPECT_EQ(find(rates, "time at which") == nullptr, restitution == 0);
    }
}

// At low rates, steps end bounces that are lower than gravity's change of a step. The ball falls
// from 0.4 m to the floor within the step from 0.4 s; 1 % of its height is at 0.95 of the line.
TEST(RatesOfABounce, OfARunThatRestsHaveTheTime) {
    for (const double restitution : {0.01, 0.02, 0.03}) {
        const Rates rates = rates_of(ball_for(2, restitution), {20, 30, 50, 60, 144}, {"exact"});
        const RatesQuantity rest = quantity_of(rates, "time at which");
        EXPECT_NEAR(rest.truth, std::sqrt(2 * 0.99 * dropped / g), 1e-9);
        // The bounces in that step are lower than 2 mm: 0.5 % of the line.
        EXPECT_NEAR(rest.lines[0].values[0], 0.4 + 0.05 * 0.95, 0.005 * 0.05) << restitution;
        for (std::size_t i = 0; i < rates.rates.size(); ++i)
            EXPECT_NEAR(rest.lines[0].values[i], rest.truth,
                        1.0 / static_cast<double>(rates.rates[i]))
                << restitution;
    }
}

void expect_no_bounce(const std::string& text, std::size_t bodies = 1) {
    const MeasuredScene measured(text);
    for (std::size_t row = 0; row < bodies; ++row) {
        const Rates rates = measure_rates(measured.scene, measured.reference, row, {60},
                                          {&find_method("velocity_verlet")}, [] { return false; });
        for (const char* part : {"height of bounce", "time at which bounces", "time of the first"})
            EXPECT_EQ(find(rates, part), nullptr) << text;
    }
}

const std::string on_floor =
    "[scene]\naxes = 2\nrate = 60\nduration = 3.0\n[gravity]\nacceleration = [0.0, -10.0]\n"
    "[[plane]]\nnormal = [0.0, 1.0]\nrestitution = 0.5\nfriction = 0.2\n";

// 3 m/s against 2 m/s²: at t, (1.5 s − t)² m remain of 2.25 m.
TEST(RatesOfASlide, HaveNoBouncesButTheTimeToStop) {
    // In double, 0.3 is not three times 0.1: the body starts a hair above the floor or below it.
    for (const auto& [offset, y] : {std::pair("0.0", "0.1"), {"0.2", "0.3"}, {"0.6", "0.7"}}) {
        std::string floor = on_floor;
        floor.insert(floor.find("restitution"), fmt::format("offset = {}\n", offset));
        const std::string body = fmt::format(
            "[[body]]\nposition = [0.0, {}]\nvelocity = [3.0, 0.0]\ncontact = 0.1\n", y);
        expect_no_bounce(floor + body);
        const Rates rates = rates_of(floor + body, {60}, {"exact"});
        EXPECT_NEAR(quantity_of(rates, "time to settle").truth, 1.5 * (1 - std::sqrt(0.05)), 1e-9);
        EXPECT_EQ(find(rates, "overshoot"), nullptr);
        EXPECT_EQ(find(rates, "apex"), nullptr);
    }
}

// Friction stops 4 m/s within v/(μg), far less than the time between two samples.
TEST(RatesOfASlide, ThatStopsAtOnceDoesNotOvershoot) {
    for (const double friction : {300.0, 1e3, 1e5}) {
        std::string floor = on_floor;
        floor.replace(floor.find("0.2"), 3, fmt::format("{:.1f}", friction));
        const std::string body = "[[body]]\nvelocity = [4.0, 0.0]\ncontact = 0.0\n";
        const Rates rates = rates_of(floor + body, {60}, {"velocity_verlet"});
        const double stop = 4 / (friction * 10);
        EXPECT_NEAR(quantity_of(rates, "time to settle").truth, stop * (1 - std::sqrt(0.05)),
                    1e-9 * stop);
        EXPECT_EQ(find(rates, "overshoot"), nullptr) << friction;
    }
}

TEST(RatesOfASlide, OfLinkedBodiesHaveNoBounces) {
    const std::string two =
        on_floor +
        "[[body]]\nname = \"a\"\nposition = [0.0, 0.1]\nvelocity = [3.0, 0.0]\ncontact = 0.1\n"
        "[[body]]\nname = \"b\"\nposition = [1.0, 0.1]\ncontact = 0.1\n"
        "[[spring]]\nbody = \"a\"\nto = \"b\"\nstiffness = 50.0\nrest_length = 1.0\n";
    expect_no_bounce(two, 2);
}

TEST(RatesOfABounce, NeedAFloorThatTheBodyTouches) {
    const std::string hanging = on_floor +
                                "[[body]]\nname = \"a\"\nposition = [0.0, 2.0]\ncontact = 0.1\n"
                                "[[spring]]\nbody = \"a\"\nanchor = [0.0, 3.0]\nstiffness = 40.0\n";
    expect_no_bounce(hanging);
    EXPECT_NE(find(rates_of(hanging, {60}, {"exact"}), "period"), nullptr);
    // Thrown upwards, it has not landed yet.
    expect_no_bounce(on_floor +
                     "[[body]]\nposition = [0.0, 0.1]\nvelocity = [0.0, 20.0]\ncontact = 0.1\n");
}

}  // namespace
}  // namespace oiler::test
