// SPDX-License-Identifier: MIT
#include "oiler/lab/rates/rates.hpp"

#include <functional>

#include "lab/measured_scenes.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Rate = std::int64_t;

Rates rates_of(const std::string& text, const std::vector<Rate>& rates,
               const std::vector<const char*>& names, std::size_t row = 0) {
    const MeasuredScene measured(text);
    return measure_rates(measured.scene, measured.reference, row, rates, methods_of(names),
                         [] { return false; });
}

const RatesQuantity* find(const Rates& rates, const std::string& part) {
    for (const RatesQuantity& quantity : rates.quantities)
        if (quantity.name.starts_with(part)) return &quantity;
    return nullptr;
}

const RatesQuantity& quantity_of(const Rates& rates, const std::string& part) {
    const RatesQuantity* const found = find(rates, part);
    if (!found) throw std::invalid_argument("no quantity " + part);
    return *found;
}

double value_of(const Rates& rates, const std::string& part, std::size_t method, std::size_t rate) {
    return quantity_of(rates, part).lines.at(method).values.at(rate);
}

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

// ---- bounces

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
        const RatesQuantity& impact = quantity_of(rates, "time of the first impact");
        EXPECT_NEAR(impact.truth, fall, 1e-12);
        EXPECT_NEAR(impact.lines[0].values[0], fall, 1e-9);
        EXPECT_EQ(find(rates, "height of bounce") == nullptr, restitution == 0);
        EXPECT_EQ(find(rates, "time at which") == nullptr, restitution == 0);
    }
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

void expect_no_bounce(const std::string& text, std::size_t row = 0) {
    const Rates rates = rates_of(text, {60}, {"velocity_verlet"}, row);
    for (const char* part : {"height of bounce", "time at which bounces", "time of the first"})
        EXPECT_EQ(find(rates, part), nullptr) << text;
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
    expect_no_bounce(two, 0);
    expect_no_bounce(two, 1);
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

// A stopped call has quantities without values.
TEST(Rates, CanBeStopped) {
    const MeasuredScene measured(article_spring);
    const Rates rates = measure_rates(measured.scene, measured.reference, 0, {20, 30},
                                      {&find_method("rk4")}, [] { return true; });
    ASSERT_FALSE(rates.quantities.empty());
    for (const RatesQuantity& quantity : rates.quantities)
        for (const double value : quantity.lines[0].values) EXPECT_TRUE(std::isnan(value));
}

// ---- springs

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
    const RatesQuantity& period = quantity_of(rates, "period");
    // The orbital period is 2π s.
    EXPECT_NEAR(period.truth, 2 * std::numbers::pi, 1e-6);
    EXPECT_TRUE(std::isnan(period.lines[0].values[0]));
    EXPECT_NEAR(period.lines[1].values[0], 2 * std::numbers::pi, 1e-5);
}

// ---- the body

TEST(FindBody, ByNameOrNumber) {
    const Scene scene = parse_scene(
        "[scene]\naxes = 1\n[[body]]\nname = \"a\"\n[[body]]\nname = \"0\"\n[[body]]\n"
        "[[grid]]\ncount = [4, 1]\nspacing = 1.0\nstiffness = 1.0\n",
        "test.toml");
    EXPECT_EQ(find_body(scene, "a"), 0U);
    EXPECT_EQ(find_body(scene, "0"), 1U);
    EXPECT_EQ(find_body(scene, "1"), 1U);
    EXPECT_EQ(find_body(scene, "6"), 6U);
    for (const char* name : {"7", "-1", "b", "1x", " 1", "1.0", "99999999999999999999"}) {
        const std::string line = line_of_error(Exit::usage, [&] { (void)find_body(scene, name); });
        EXPECT_TRUE(holds(line, name));
        EXPECT_TRUE(holds(line, "from 0 to 6"));
    }
}

}  // namespace
}  // namespace oiler::test
