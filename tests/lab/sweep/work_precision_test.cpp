// SPDX-License-Identifier: MIT
#include <ostream>

#include "oiler/lab/sweep/tradeoff.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/reference.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double stiffness = 15;  // N/m, of the article's spring, on 1 kg
constexpr double damping = 0.1;   // N·s/m
constexpr std::int64_t duration = 10;
const double omega = std::sqrt(stiffness);

/// Two motions in (ωx, v), one per column.
using Matrix = std::array<std::array<Real, 2>, 2>;

/// exp(AT), from x0·e^(−γt)·(cos ωd·t + (γ/ωd)·sin ωd·t) + v0·e^(−γt)·sin(ωd·t)/ωd.
Matrix exact_map() {
    const Real gamma = Real(damping) / 2;
    const Real turning = std::sqrt(stiffness - gamma * gamma);
    const Real decay = std::exp(-gamma * duration);
    const Real c = decay * std::cos(turning * duration);
    const Real s = decay * std::sin(turning * duration) / turning;
    const Real w = std::sqrt(Real(stiffness));
    return {{{c + gamma * s, w * s}, {-w * s, c - gamma * s}}};
}

/// The larger singular value.
double norm(const Matrix& m) {
    const Real squares =
        m[0][0] * m[0][0] + m[0][1] * m[0][1] + m[1][0] * m[1][0] + m[1][1] * m[1][1];
    const Real determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    const Real gap = std::sqrt(std::max(0.0L, squares * squares - 4 * determinant * determinant));
    return static_cast<double>(std::sqrt((squares + gap) / 2));
}

struct Run {
    double error;  ///< ‖Mⁿ − exp(AT)‖₂, the largest relative error of any start
    std::int64_t evaluations;
};

/// Runs both unit states together. Round-off of double is negligible: n steps leave about n·u, at
/// most 3·10⁻⁹ here, while errors near the target of 10⁻⁶ differ from it by at least 7·10⁻⁹.
Run run(const Method& method, std::int64_t rate) {
    Bodies bodies(1, Precision::double_);
    const Spring spring{.stiffness = stiffness, .damping = damping};
    bodies.add({.position = {1}}, spring);
    bodies.add({.velocity = {1}}, spring);
    bodies.step(method, {{rate}, 0, duration * rate});
    const Matrix exact = exact_map();
    const Real w = std::sqrt(Real(stiffness));
    const auto along = bodies.state(0);
    const auto across = bodies.state(1);
    const Matrix apart{{{along.x[0] - exact[0][0], w * across.x[0] - exact[0][1]},
                        {along.v[0] / w - exact[1][0], across.v[0] - exact[1][1]}}};
    return {norm(apart), bodies.evaluations()};
}

/// The evaluations of the first rate that meets the target together with the next. This rejects
/// phases that are right by accident, as in the reference. 0 if no rate up to `most` does.
std::int64_t evaluations_to_meet(const Method& method, double target, std::int64_t most,
                                 const std::vector<std::int64_t>& rates) {
    std::int64_t first = 0;
    for (const std::int64_t rate : rates) {
        if (rate * duration * method.evaluations > most) break;
        const Run at = run(method, rate);
        if (at.error >= target)
            first = 0;
        else if (first > 0)
            return first;
        else
            first = at.evaluations;
    }
    return 0;
}

std::vector<std::int64_t> lab_rates() {
    Scene scene;
    scene.stepping.rate.steps = 1;
    return lab::sweep_rates(scene, 1 << 22);
}

/// The evaluations of the first rate with at least the steps of `least` evaluations. Methods that
/// reuse the last kick for the next step need one more evaluation at the start.
std::int64_t evaluations_of_rate_above(const Method& method, std::int64_t least,
                                       const std::vector<std::int64_t>& rates) {
    const std::int64_t per_hertz = duration * method.evaluations;
    for (const std::int64_t rate : rates)
        if (rate * per_hertz + 1 >= least) return rate * per_hertz + 1;
    throw std::out_of_range("no such rate");
}

/// The reference's name of a method as it is run here.
struct Named {
    std::string method;
    std::string in_reference;
};
void PrintTo(const Named& named, std::ostream* out) { *out << named.method; }

/// Without optimisation, runs of many million steps take too long.
#ifdef NDEBUG
constexpr std::int64_t most_evaluations = 20'000'000;
#else
constexpr std::int64_t most_evaluations = 100'000;
#endif

class WorkPrecision : public testing::TestWithParam<Named> {};

// The errors are those after whole steps. The lab finds the first rate with the needed steps.
TEST_P(WorkPrecision, TakesTheEvaluationsOfTheReference) {
    const auto table = reference("work_precision_spring").at("T=10 k=15 b=0.1");
    const auto& needed = table.at("force_evaluations_needed").at(GetParam().in_reference);
    const auto& targets = table.at("targets");
    const auto rates = lab_rates();
    const Method& method = find_method(GetParam().method);
    std::size_t found = 0;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const double target = number(targets.at(i));
        if (target != 1e-3 && target != 1e-6) continue;
        ++found;
        const auto least = needed.at(i).get<std::int64_t>();
        if (least > most_evaluations) continue;
        const std::int64_t evaluations = evaluations_to_meet(method, target, 3 * least, rates);
        EXPECT_GE(evaluations, least) << target;
        EXPECT_LE(evaluations, evaluations_of_rate_above(method, least, rates)) << target;
    }
    EXPECT_EQ(found, 2U);
}

INSTANTIATE_TEST_SUITE_P(
    Spring, WorkPrecision,
    testing::Values(Named{"semi_implicit_euler", "semi_implicit_euler_kd/E"},
                    Named{"velocity_verlet", "verlet_velocity_kdk/A"}, Named{"rk4", "rk4_classic"},
                    Named{"forest_ruth4", "forest_ruth4/A"}, Named{"pefrl", "pefrl/A"},
                    Named{"position_verlet", "verlet_position_dkd/A"},
                    Named{"rk2_heun", "rk2_heun"}, Named{"rk3_kutta", "rk3_kutta"},
                    Named{"blanes_moan_srkn6b", "blanes_moan_srkn6b/A"},
                    Named{"blanes_moan_srkn14a", "blanes_moan_srkn14a/A"},
                    Named{"kahan_li8_kdk", "kahan_li8_kdk/A"}),
    [](const auto& tested) { return tested.param.method; });

// Rungs are 4/3 or 3/2 apart, and farther below 60 Hz; this test checks the number of steps. With 1
// % fewer steps than in the reference, the error is above the target.
TEST(WorkPrecisionOfSemiImplicitEuler, TakesTheStepsOfTheReferenceWithin1Percent) {
    const Method& method = find_method("semi_implicit_euler");
    EXPECT_LT(run(method, 1593).error, 1e-3);
    EXPECT_GT(run(method, 1577).error, 1e-3);
}

// 11 divisors of 60 below 60 Hz, 60·2⁰ to 60·2¹⁶, and 90·2⁰ to 90·2¹⁵.
TEST(LabsRates, AreFourThirdsAndThreeHalvesApart) {
    const auto rates = lab_rates();
    ASSERT_EQ(rates.size(), 11U + 17U + 16U);
    EXPECT_EQ(rates[11], 60);
    EXPECT_EQ(rates.back(), 60 << 16);
    for (std::size_t i = 12; i < rates.size(); ++i) {
        const bool to_power = i % 2 == 1;
        EXPECT_EQ(rates[i] * (to_power ? 3 : 2), rates[i - 1] * (to_power ? 4 : 3)) << rates[i];
    }
}

}  // namespace
}  // namespace oiler::test
