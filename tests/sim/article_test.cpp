// SPDX-License-Identifier: MIT
#include <cstdio>

#include "oiler/physics/closed_forms.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/reference.hpp"
#include "support/spring.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

struct Row {
    double label;  // the article's t: float steps accumulated in double
    float position;
    float velocity;
};

/// The article's program with the engine in place of its two lines of physics.
std::vector<Row> engine_rows(Rate rate) {
    Bodies bodies(1, Precision::single);
    bodies.set_gravity({10, 0, 0});
    bodies.add(Body{});
    std::vector<Row> rows;
    std::int64_t tick = 0;
    for (double t = 0; t <= 10.0; t += static_cast<double>(rate.dt<float>())) {
        rows.push_back({t, static_cast<float>(bodies.position(0)[0]),
                        static_cast<float>(bodies.velocity(0)[0])});
        bodies.step(find_method("explicit_euler"), {rate, tick++, 1});
    }
    return rows;
}

/// The article's program, verbatim except for the printing.
std::vector<Row> article_rows(float dt) {
    std::vector<Row> rows;
    double t = 0.0;
    float velocity = 0.0f;
    float position = 0.0f;
    float force = 10.0f;
    float mass = 1.0f;
    while (t <= 10.0) {
        rows.push_back({t, position, velocity});
        position = position + velocity * dt;
        velocity = velocity + (force / mass) * dt;
        t += static_cast<double>(dt);
    }
    return rows;
}

/// The article's program compiled with fused multiply-adds.
std::vector<Row> fused_rows(float dt) {
    std::vector<Row> rows;
    float velocity = 0;
    float position = 0;
    for (double t = 0; t <= 10.0; t += static_cast<double>(dt)) {
        rows.push_back({t, position, velocity});
        position = std::fma(velocity, dt, position);
        velocity = std::fma(10.0F, dt, velocity);
    }
    return rows;
}

bool same_numbers(const Row& a, const Row& b) {
    return a.position == b.position && a.velocity == b.velocity;
}

std::string print(const char* format, const Row& row) {
    char line[128];
    std::snprintf(line, sizeof line, format, row.label, static_cast<double>(row.position),
                  static_cast<double>(row.velocity));
    return line;
}

constexpr const char* second_format = "t=%.2f: position = %f velocity = %f";

TEST(Article, TheFirstTableMatches) {
    const auto table = reference("article").at("table_dt_1");
    const std::vector<Row> rows = engine_rows({1});
    ASSERT_EQ(rows.size(), 11U);
    ASSERT_EQ(table.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        EXPECT_EQ(print("t=%g: position = %g velocity = %g", rows[i]), table[i].get<std::string>());
}

TEST(Article, TheSecondTableMatches) {
    const auto table = reference("article").at("table_dt_0.01_last_rows");
    const std::vector<Row> rows = engine_rows({100});
    ASSERT_EQ(rows.size(), 1001U);
    ASSERT_EQ(table.size(), 11U);
    for (std::size_t i = 0; i < table.size(); ++i)
        EXPECT_EQ(print(second_format, rows[rows.size() - table.size() + i]),
                  table[i].get<std::string>());
}

// The eleven printed rows do not show whether a compiler fused; the other rows do.
TEST(Article, EveryRowOfTheSecondTableEqualsTheArticlesProgram) {
    const std::vector<Row> rows = engine_rows({100});
    const std::vector<Row> article = article_rows(1.0F / 100.0F);
    ASSERT_EQ(rows.size(), article.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        EXPECT_TRUE(same_numbers(rows[i], article[i])) << print(second_format, article[i]);
}

// 299 rows print differently if fused, none of them in the article.
TEST(Article, TheMiddleOfTheSecondTableShowsFusion) {
    const std::vector<Row> article = article_rows(1.0F / 100.0F);
    const std::vector<Row> fused = fused_rows(1.0F / 100.0F);
    ASSERT_EQ(article.size(), fused.size());
    int differing = 0;
    for (std::size_t i = 0; i < article.size(); ++i)
        if (print(second_format, article[i]) != print(second_format, fused[i])) ++differing;
    EXPECT_EQ(differing, 299);
    for (std::size_t i = article.size() - 11; i < article.size(); ++i)
        EXPECT_EQ(print(second_format, article[i]), print(second_format, fused[i]));
}

TEST(Article, TheEnginesTimeIsNotAccumulated) {
    EXPECT_EQ(Rate{100}.time(1000), 10.0);
    EXPECT_LT(engine_rows({100}).back().label, 10.0);
}

struct Expected {
    double x;
    double v;
};

Expected expected_state(const char* run, const char* method) {
    const auto state = reference("spring_states").at(run).at("state").at(method);
    return {number(state[0]), number(state[1])};
}

/// `operations` roundings per step: 4 in the kick, 2 in the drift, 1 of dt.
void expect_state(const Bodies& bodies, const Expected& expected, int steps, double amplitude) {
    const double tolerance = drift_of_rounding(steps, 7, amplitude);
    EXPECT_NEAR(bodies.position(0)[0], expected.x, tolerance);
    EXPECT_NEAR(bodies.velocity(0)[0], expected.v, tolerance * omega);
}

// With damping, the amplitude of explicit Euler grows by √det per step, to 1.284 times. The axes of
// the ellipse of undamped semi-implicit Euler's rounding errors have the ratio √((2 + h)/(2 − h)),
// here 1.22.
TEST(ArticleSpring, EndsAtTheStateOfTheory) {
    struct Run {
        const char* method;
        double damping;
        Rate rate;
        int steps;
        const char* run;
        const char* name;
        double amplitude;  ///< m; 0: that of the end
    };
    for (const Run& run :
         {Run{"explicit_euler",
              damping,
              {100},
              1000,
              "damped_dt0.01_n1000",
              "explicit_euler",
              1.29 * start_x},
          Run{"semi_implicit_euler",
              damping,
              {100},
              1000,
              "damped_dt0.01_n1000",
              "semi_implicit_euler_kd/E",
              start_x},
          Run{"explicit_euler", 0, {10}, 900, "undamped_dt0.1_n900", "explicit_euler", 0},
          Run{"semi_implicit_euler",
              0,
              {10},
              900,
              "undamped_dt0.1_n900",
              "semi_implicit_euler_kd",
              1.22 * start_x}}) {
        SCOPED_TRACE(testing::Message() << run.method << ", b = " << run.damping);
        Bodies bodies = article_spring(run.damping);
        bodies.step(find_method(run.method), {run.rate, 0, run.steps});
        const Expected expected = expected_state(run.run, run.name);
        const double end = std::hypot(expected.x, expected.v / omega);
        if (run.amplitude == 0) {
            ASSERT_GT(end, 1e30);
        }
        expect_state(bodies, expected, run.steps, run.amplitude > 0 ? run.amplitude : end);
    }
}

// The step matrix A = [[1, dt], [−k·dt, 1 − b·dt]] has det A = 1 − b·dt + k·dt². For every 2×2
// matrix the area z ∧ Az = x·(Az)_v − v·(Az)_x grows by det A per step. Divided by −dt, the area is
// the form k·x² + b·x·v + v². Its difference from twice the energy is b·x·v, |b·x·v| ≤ (b/ω)·E.
long double explicit_form(const Bodies& bodies) {
    const long double x = bodies.position(0)[0];
    const long double v = bodies.velocity(0)[0];
    return stiffness * x * x + damping * x * v + v * v;
}

TEST(ArticleSpring, ExplicitEulersEnergyGrowsAsInTheory) {
    const auto threshold = reference("article").at("explicit_euler_threshold");
    const double per_step =
        number(threshold.at("amplitude_factor_per_step_dt_0.01=sqrt(1-b dt+k dt^2)"));
    const double after_90_s = number(threshold.at("amplitude_factor_after_90s"));
    Bodies bodies = article_spring(damping);
    const long double form = explicit_form(bodies);
    const double energy = bodies.energy().total();
    constexpr int steps = 9000;
    for (int i = 0; i < steps; ++i) {
        const long double before = explicit_form(bodies);
        bodies.step(find_method("explicit_euler"), {{100}, i, 1});
        // A quadratic form doubles the step's relative error: 2 · 7 roundings.
        ASSERT_NEAR(static_cast<double>(explicit_form(bodies) / before), per_step * per_step,
                    14 * round_off)
            << i;
    }
    EXPECT_NEAR(static_cast<double>(std::sqrt(explicit_form(bodies) / form)), after_90_s,
                drift_of_rounding(steps, 7, after_90_s));
    EXPECT_NEAR(bodies.energy().total() / energy, after_90_s * after_90_s,
                after_90_s * after_90_s * damping / omega);
}

/// The largest difference from the exact position over the first `seconds`.
double largest_error(const char* method, int seconds) {
    Bodies bodies = article_spring(damping);
    double largest = 0;
    for (int i = 1; i <= 100 * seconds; ++i) {
        bodies.step(find_method(method), {{100}, i - 1, 1});
        const auto exact = damped_oscillator(1.0, stiffness, damping, {start_x, 0.0}, i / 100.0);
        largest = std::max(largest, std::abs(bodies.position(0)[0] - exact.x));
    }
    return largest;
}

// The reference prints ten digits.
TEST(ArticleSpring, LargestErrorsMatchTheReference) {
    const auto errors = reference("article").at("damped_dt_0.01_max_abs_x_error");
    for (const auto& [method, name] : {std::pair("semi_implicit_euler", "semi_implicit_euler_kd/E"),
                                       std::pair("explicit_euler", "explicit_euler")}) {
        const double expected = number(errors.at(name).at("0..90s")[0]);
        EXPECT_NEAR(largest_error(method, 90), expected, 5e-10 * expected) << method;
    }
}

}  // namespace
}  // namespace oiler::test
