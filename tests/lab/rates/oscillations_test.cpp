// SPDX-License-Identifier: MIT
#include <cmath>
#include <functional>
#include <numbers>

#include "lab/measured_rates.hpp"

namespace oiler::test {
namespace {

constexpr double stiffness = 15;
constexpr double start = 1000;

std::string spring_with(const std::string& damping) {
    return one_axis + "duration = 20.0\n" + on_spring(start, stiffness) + "damping = " + damping +
           "\n";
}

/// A coordinate after n steps.
using Samples = std::function<double(int n)>;

/// The mean time between upward crossings of 0 by straight lines.
double period_of(const Samples& x, double h, int steps) {
    double first = unknown;
    double last = unknown;
    int count = 0;
    for (int n = 1; n <= steps; ++n) {
        if (!(x(n - 1) < 0 && x(n) >= 0)) continue;
        last = h * (n - 1 + x(n - 1) / (x(n - 1) - x(n)));
        if (count++ == 0) first = last;
    }
    return (last - first) / (count - 1);
}

/// The phase of a step of h, equal for both methods: cos θ = 1 − (ωh)²/2.
double turn_of(double h) { return std::acos(1 - stiffness * h * h / 2); }

// Semi-implicit Euler from rest: x = A·cos((n + ½)θ)/cos(θ/2); velocity Verlet: x = A·cos(nθ). Both
// follow from x(n+1) − 2x(n) + x(n−1) = −ω²h²·x(n).
Samples semi_implicit_oscillation(double h) {
    const double turn = turn_of(h);
    return [=](int n) { return start * std::cos((n + 0.5) * turn) / std::cos(turn / 2); };
}
Samples verlet_oscillation(double h) {
    const double turn = turn_of(h);
    return [=](int n) { return start * std::cos(n * turn); };
}

double amplitude_of(const Samples& x, double h, int steps, double period) {
    double high = -INFINITY;
    double low = INFINITY;
    for (int n = steps; n * h > steps * h - period; --n) {
        high = std::max(high, x(n));
        low = std::min(low, x(n));
    }
    return (high - low) / 2;
}

const std::vector<Rate> oscillation_rates{5, 10, 20, 50, 100};

TEST(RatesOfAnOscillation, HaveThePeriodOfTheStepsByTheory) {
    const Rates rates =
        rates_of(spring_with("0.0"), oscillation_rates, {"semi_implicit_euler", "velocity_verlet"});
    const double period = 2 * std::numbers::pi / std::sqrt(stiffness);
    // Cubics between 50 samples per second have an error of (ωh)⁴/384, also at the maximum.
    EXPECT_NEAR(quantity_of(rates, "period").truth, period, 1e-7);
    EXPECT_NEAR(quantity_of(rates, "amplitude").truth, start, 1e-7 * start);
    EXPECT_EQ(find(rates, "time to settle"), nullptr);
    EXPECT_EQ(find(rates, "apex"), nullptr);
    for (std::size_t i = 0; i < oscillation_rates.size(); ++i) {
        const double h = 1.0 / static_cast<double>(oscillation_rates[i]);
        const int steps = static_cast<int>(20 * oscillation_rates[i]);
        const Samples paths[]{semi_implicit_oscillation(h), verlet_oscillation(h)};
        for (std::size_t method = 0; method < 2; ++method) {
            // The centre is known to 1e-7 of the amplitude, which shifts both crossings.
            EXPECT_NEAR(value_of(rates, "period", method, i), period_of(paths[method], h, steps),
                        1e-8)
                << oscillation_rates[i];
            EXPECT_NEAR(value_of(rates, "amplitude", method, i),
                        amplitude_of(paths[method], h, steps, period), 1e-8 * start)
                << oscillation_rates[i];
        }
    }
    // The spread, relative to the truth: runs are too fast by (ωh)²/24.
    const RatesLine& line = quantity_of(rates, "period").lines[1];
    EXPECT_NEAR(line.spread_percent, 100 * (line.values.back() - line.values.front()) / period,
                1e-6);
    EXPECT_GT(line.spread_percent, 1);
}

double damped(double damping, double t) {
    const double w = std::sqrt(stiffness - damping * damping / 4);
    return start * std::exp(-damping / 2 * t) *
           (std::cos(w * t) + damping / (2 * w) * std::sin(w * t));
}

/// The time after which straight lines between the samples stay within 50 m.
double settle_time_of(const Samples& x, double h, int steps) {
    int n = steps;
    while (std::abs(x(n)) <= 0.05 * start) --n;
    const double edge = std::copysign(0.05 * start, x(n));
    return h * (n + (edge - x(n)) / (x(n + 1) - x(n)));
}

TEST(RatesOfAnOscillation, HaveTheTimeToSettle) {
    const Rates rates = rates_of(spring_with("0.5"), {20, 50, 100, 1000}, {"exact"});
    const auto settle = [](double h) {
        return settle_time_of([h](int n) { return damped(0.5, n * h); }, h,
                              static_cast<int>(std::lround(20 / h)));
    };
    // Straight lines of 10 µs differ from the curve by (ωh)² rad.
    EXPECT_NEAR(quantity_of(rates, "time to settle").truth, settle(1e-5), 1e-6);
    EXPECT_NEAR(value_of(rates, "time to settle", 0, 0), settle(1.0 / 20), 1e-7);
    EXPECT_NEAR(value_of(rates, "time to settle", 0, 1), settle(1.0 / 50), 1e-7);
    EXPECT_NEAR(value_of(rates, "time to settle", 0, 2), settle(1.0 / 100), 1e-7);
    EXPECT_NEAR(value_of(rates, "time to settle", 0, 3), settle(1.0 / 1000), 1e-7);
    EXPECT_EQ(quantity_of(rates, "time to settle").name, "time to settle to 5 %");
}

/// The motion from 1 m at rest with ω = 10/s and this damping ratio.
double camera(double zeta, double t) {
    const double gamma = 10 * zeta;
    if (zeta == 1) return std::exp(-gamma * t) * (1 + gamma * t);
    const double w = 10 * std::sqrt(std::abs(1 - zeta * zeta));
    return zeta < 1 ? std::exp(-gamma * t) * (std::cos(w * t) + gamma / w * std::sin(w * t))
                    : std::exp(-gamma * t) * (std::cosh(w * t) + gamma / w * std::sinh(w * t));
}

TEST(RatesOfACamera, HaveTheOvershootAndTheTimeToSettle) {
    for (const double zeta : {0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.5}) {
        const std::string scene = one_axis + "duration = 3.0\n" + on_spring(1, 100) +
                                  fmt::format("damping = {}\n", 20 * zeta);
        const Rates rates = rates_of(scene, {60, 240}, {"exact"});
        double t = 3;
        while (std::abs(camera(zeta, t)) <= 0.05) t -= 1e-5;
        EXPECT_NEAR(quantity_of(rates, "time to settle").truth, t, 2e-5) << zeta;
        EXPECT_NEAR(value_of(rates, "time to settle", 0, 1), t, 1e-3) << zeta;
        const double overshoot =
            zeta < 1 ? std::exp(-std::numbers::pi * zeta / std::sqrt(1 - zeta * zeta)) : 0;
        const RatesQuantity* const shown = find(rates, "overshoot");
        EXPECT_EQ(shown != nullptr, overshoot > 0) << zeta;
        if (shown) {
            EXPECT_NEAR(shown->truth, overshoot, 1e-5) << zeta;
        }
    }
}

TEST(RatesOfACamera, ThatHasNotSettledHaveNoTime) {
    const std::string scene = on_spring(1, 100) + "damping = 4.0\n";
    // It passes its rest within 5 % at 0.18 s, but oscillates by 53 %.
    EXPECT_TRUE(
        rates_of(one_axis + "duration = 0.18\n" + scene, {60}, {"exact"}).quantities.empty());
}

// A weight on a spring oscillates around g/k below the anchor.
TEST(RatesOfAnOscillation, GoAroundTheCentre) {
    const Rates rates = rates_of(one_axis + "duration = 20.0\n[gravity]\nacceleration = [-9.81]\n" +
                                     on_spring(3, 15) + "damping = 0.5\n",
                                 {100}, {"exact"});
    const double rest = -9.81 / stiffness;
    const double oscillation = (3 - rest) / start;
    const double settle = settle_time_of([&](int n) { return damped(0.5, n / 100.0); }, 0.01, 2000);
    EXPECT_NEAR(value_of(rates, "time to settle", 0, 0), settle, 1e-6);
    EXPECT_NEAR(quantity_of(rates, "period").truth,
                2 * std::numbers::pi / std::sqrt(stiffness - 0.25 * 0.25), 1e-6);
    EXPECT_GT(oscillation, 0);
}

// Around 10⁶ m, a double rounds by 1e-10 m.
TEST(RatesOfAnOscillation, AreTheSameFarFromTheOrigin) {
    const auto at = [](const char* place, const char* anchor) {
        return rates_of(std::string("[scene]\naxes = 1\nrate = 100\nduration = 10.0\n[[body]]\n") +
                            "name = \"mass\"\nposition = [" + place + "]\n[[spring]]\n" +
                            "body = \"mass\"\nanchor = [" + anchor +
                            "]\nstiffness = 100.0\ndamping = 2.0\n",
                        {100}, {"velocity_verlet"});
    };
    const Rates far = at("1000001.0", "1000000.0");
    for (const RatesQuantity& quantity : at("1.0", "0.0").quantities)
        EXPECT_NEAR(quantity_of(far, quantity.name).truth, quantity.truth, 1e-6) << quantity.name;
    EXPECT_NEAR(quantity_of(far, "period").truth, 2 * std::numbers::pi / std::sqrt(99.0), 1e-6);
}

/// Two masses on springs of 1 N/m and a link: they oscillate together at 1 rad/s, against each
/// other at √(1 + 2·of_link) rad/s.
std::string pair(const std::string& first, const std::string& second, const std::string& of_link) {
    return one_axis + "duration = 30.0\n[[body]]\nname = \"a\"\nposition = [" + first +
           "]\n[[body]]\nname = \"b\"\nposition = [" + second +
           "]\n[[spring]]\nbody = \"a\"\nanchor = [0.0]\nstiffness = 1.0\n" +
           "[[spring]]\nbody = \"b\"\nanchor = [0.0]\nstiffness = 1.0\n" +
           "[[spring]]\nbody = \"a\"\nto = \"b\"\nstiffness = " + of_link + "\n";
}

// x = cos t + 0.05·cos 10t repeats after 2π s. Its small extremes lie near those of cos t.
TEST(RatesOfAnOscillation, HaveThePeriodOfTheWholeMotion) {
    const Rates rates = rates_of(pair("1.05", "0.95", "49.5"), {100}, {"rk4"});
    EXPECT_NEAR(quantity_of(rates, "period").truth, 2 * std::numbers::pi, 1e-6);
}

// x = cos t + 0.4·cos √3·t never repeats. Its cycles differ by more than a tenth.
TEST(RatesOfAnOscillation, WithoutAPeriodHaveNone) {
    EXPECT_EQ(find(rates_of(pair("1.4", "0.6", "1.0"), {100}, {"rk4"}), "period"), nullptr);
}

TEST(RatesOfAnOscillation, OfSeveralFrequenciesHaveAMeanPeriodAndARange) {
    const Rates rates = rates_of(pair("1.4", "0.6", "1.0"), {100}, {"rk4"});
    const auto x = [](double t) { return std::cos(t) + 0.4 * std::cos(std::sqrt(3.0) * t); };
    constexpr double h = 1e-4;
    double low = INFINITY;
    double high = -INFINITY;
    const double mean =
        (std::sin(30.0) + 0.4 / std::sqrt(3.0) * std::sin(std::sqrt(3.0) * 30)) / 30;
    std::vector<double> up;
    for (double t = h; t < 30; t += h) {
        low = std::min(low, x(t));
        high = std::max(high, x(t));
        if (x(t - h) < mean && x(t) >= mean) up.push_back(t);
    }
    EXPECT_NEAR(quantity_of(rates, "half of the range").truth, (high - low) / 2, 1e-5);
    // The mean of 60 samples and more per second differs from the integral by less than 2 mm, and
    // the slope at the crossings is more than 0.5 m/s.
    const double period = (up.back() - up.front()) / static_cast<double>(up.size() - 1);
    EXPECT_NEAR(quantity_of(rates, "mean period").truth, period,
                8e-3 / static_cast<double>(up.size() - 1));
    EXPECT_NEAR(value_of(rates, "mean period", 0, 0), period, 0.01);
}

// A driven spring with two frequencies.
TEST(RatesOfAnOscillation, OfADrivenSpringAreShown) {
    const Rates rates =
        rates_of(one_axis + "duration = 30.0\n" + on_spring(1, 40) +
                     "[[drive]]\nbody = \"mass\"\namplitude = [60.0]\nfrequency = 1.6\n",
                 {60}, {"rk4"});
    EXPECT_NE(find(rates, "mean period"), nullptr);
    EXPECT_NE(find(rates, "half of the range"), nullptr);
}

// ω·dt is 3.9 at 1 Hz; the limit is 2.
TEST(RatesOfAnOscillation, ThatIsUnstableAreUnknown) {
    const Rates rates =
        rates_of(spring_with("0.0"), {1, 100}, {"velocity_verlet", "implicit_midpoint"});
    for (const RatesQuantity& quantity : rates.quantities) {
        EXPECT_TRUE(std::isnan(quantity.lines[0].values[0])) << quantity.name;
        EXPECT_FALSE(std::isnan(quantity.lines[0].values[1])) << quantity.name;
        EXPECT_TRUE(std::isnan(quantity.lines[0].spread_percent)) << quantity.name;
        EXPECT_FALSE(std::isnan(quantity.lines[1].values[1])) << quantity.name;
    }
}

TEST(RatesOfAnOscillation, OfAMethodThatCannotStepItAreUnknown) {
    const Rates rates = rates_of(
        "[scene]\naxes = 2\nrate = 100\nduration = 20.0\n[[attractor]]\nposition = [0.0, 0.0]\n"
        "gm = 1.0\n[[body]]\nposition = [1.0, 0.0]\nvelocity = [0.0, 1.0]\n",
        {100}, {"exact", "rk4"});
    const RatesQuantity period = quantity_of(rates, "period");
    // The orbital period is 2π s.
    EXPECT_NEAR(period.truth, 2 * std::numbers::pi, 1e-6);
    EXPECT_TRUE(std::isnan(period.lines[0].values[0]));
    EXPECT_NEAR(period.lines[1].values[0], 2 * std::numbers::pi, 1e-5);
}

}  // namespace
}  // namespace oiler::test
