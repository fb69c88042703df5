// SPDX-License-Identifier: MIT
// The pre-flight's limits of springs in several directions, of nets and of uneven damping, compared
// with eigenvalues of matrices that the test assembles, and with runs.
#define EIGEN_DONT_VECTORIZE

#include <Eigen/Eigenvalues>

#include "oiler/sim/bodies.hpp"
#include "oiler/stability/stability.hpp"
#include "support/dice.hpp"
#include "support/explained_step.hpp"
#include "support/springs.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// The highest frequency, 1/s, from the second derivatives of the springs' energies: stiffness
/// along each spring, tension across a stretched one.
double highest_frequency(const SpringScene& scene) {
    using Matrix = Eigen::MatrixXd;
    const auto n = static_cast<Eigen::Index>(scene.masses.size());
    const Eigen::Index axes = scene.axes;
    Matrix stiffness = Matrix::Zero(n * axes, n * axes);
    Eigen::VectorXd weights(n * axes);
    for (Eigen::Index i = 0; i < n * axes; ++i)
        weights[i] = 1 / std::sqrt(scene.masses[static_cast<std::size_t>(i / axes)].mass);
    for (const auto& pull : scene.pulls) {
        const Vec3 between = scene.masses[pull.a].position - scene.other_end(pull);
        Eigen::VectorXd d(axes);
        for (Eigen::Index i = 0; i < axes; ++i) d[i] = between[static_cast<int>(i)];
        const double length = d.norm();
        Matrix block = Matrix::Identity(axes, axes) * pull.stiffness;
        if (pull.rest_length > 0) {
            const Matrix along = d * d.transpose() / (length * length);
            const double tension =
                std::max(0.0, pull.stiffness * (length - pull.rest_length) / length);
            block = pull.stiffness * along + tension * (Matrix::Identity(axes, axes) - along);
        }
        Matrix ends = Matrix::Zero(axes, n * axes);
        ends.middleCols(static_cast<Eigen::Index>(pull.a) * axes, axes).setIdentity();
        if (pull.b >= 0) ends.middleCols(pull.b * axes, axes) = -Matrix::Identity(axes, axes);
        stiffness += ends.transpose() * block * ends;
    }
    const Matrix weighted = weights.asDiagonal() * stiffness * weights.asDiagonal();
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Matrix>(weighted).eigenvalues().maxCoeff());
}

/// The longest timestep without a warning, by bisection.
double longest_step(const Bodies& bodies, const Method& method, double around) {
    double quiet = around / 4;
    double warned = around * 4;
    EXPECT_FALSE(is_warned(bodies, method, quiet));
    EXPECT_TRUE(is_warned(bodies, method, warned));
    while (warned - quiet > 1e-5 * warned) {
        const double middle = (quiet + warned) / 2;
        (is_warned(bodies, method, middle) ? warned : quiet) = middle;
    }
    return quiet;
}

SpringScene crossed_coils(double angle, bool links_to_points = false) {
    SpringScene scene{.links_to_points = links_to_points};
    scene.masses.push_back({});
    scene.add_relaxed({.anchor = {1, 0}, .stiffness = 4000}, true);
    scene.add_relaxed({.anchor = {std::cos(angle), std::sin(angle)}, .stiffness = 4000}, true);
    return scene;
}

// Two equal springs at an angle φ have k·(1 ± cos φ).
TEST(CrossedCoils, AddByTheirDirections) {
    const Method& verlet = find_method("velocity_verlet");
    for (const double angle : {0.3, 1.0, std::acos(0.0), 2.0})
        for (const bool links_to_points : {false, true}) {
            const Bodies bodies = crossed_coils(angle, links_to_points).bodies();
            const double limit = 2 / std::sqrt(4000 * (1 + std::abs(std::cos(angle))));
            EXPECT_NEAR(longest_step(bodies, verlet, limit) / limit, 1, 1e-4) << angle;
            EXPECT_FALSE(explodes(bodies, verlet, 0.99 * limit, 20'000)) << angle;
            EXPECT_TRUE(explodes(bodies, verlet, 1.01 * limit, 20'000)) << angle;
        }
}

TEST(CrossedCoils, ThatAreStretchedPullAcross) {
    SpringScene scene = crossed_coils(2);
    for (auto& pull : scene.pulls) pull.rest_length = 0.4;
    const Method& verlet = find_method("velocity_verlet");
    const double limit = 2 / highest_frequency(scene);
    const double quiet = longest_step(scene.bodies(), verlet, limit) / limit;
    EXPECT_LE(quiet, 1.0001);
    EXPECT_GE(quiet, std::sqrt(1 / 1.9)) << "warned below the sum of all stiffness";
}

// At right angles they have k. Far away both pull along one line, with 2·k: √2·1.8 is above the
// limit of 2.
TEST(CrossedCoils, OfAThrownBodyAreWarnedOfBeforeTheyAlign) {
    const Method& verlet = find_method("velocity_verlet");
    const double dt = 1.8 / std::sqrt(4000);
    for (const bool links_to_points : {false, true}) {
        Bodies bodies = crossed_coils(std::acos(0.0), links_to_points).bodies();
        EXPECT_FALSE(is_warned(bodies, verlet, dt));
        bodies.set_velocity(0, {-1000, -1000});
        EXPECT_TRUE(is_warned(bodies, verlet, dt)) << links_to_points;
        EXPECT_TRUE(bodies.try_step(verlet, {rate_of(dt), 0, 20'000}));
    }
}

/// A net in which neighbours are linked, with diagonals or without.
SpringScene net(int columns, int rows, double stretch, bool diagonals, double damping) {
    SpringScene scene;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            scene.masses.push_back({.mass = 0.02, .position = {0.1 * i, 0.1 * j}});
    const auto link = [&](int i, int j, int right, int up) {
        if (i + right < 0 || i + right >= columns || j + up >= rows) return;
        scene.add_relaxed({.a = static_cast<std::size_t>(j * columns + i),
                           .b = (j + up) * columns + i + right,
                           .stiffness = 800,
                           .damping = damping},
                          true);
        scene.pulls.back().rest_length /= stretch;
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            link(i, j, 1, 0);
            link(i, j, 0, 1);
            if (!diagonals) continue;
            link(i, j, 1, 1);
            link(i, j, -1, 1);
        }
    return scene;
}

TEST(Nets, AreWarnedOfFromTheirEigenvaluesOn) {
    const Method& verlet = find_method("velocity_verlet");
    for (const bool diagonals : {false, true})
        for (const double stretch : {1.0, 1.3}) {
            const SpringScene scene = net(12, 9, stretch, diagonals, 0);
            const double limit = 2 / highest_frequency(scene);
            const double quiet = longest_step(scene.bodies(), verlet, limit);
            EXPECT_LE(quiet, 1.0001 * limit) << diagonals << stretch;
            if (stretch == 1 || !diagonals) {
                EXPECT_GE(quiet, 0.98 * limit) << diagonals;
            } else {
                // It contracts, and its diagonals turn: the run needs shorter steps, or gains more
                // energy than its springs held.
                Bodies run = scene.bodies();
                const double held = run.energy().potential;
                EXPECT_TRUE(run.try_step(verlet, {rate_of(1.05 * quiet), 0, 20'000}) ||
                            run.energy().total() > 2 * held)
                    << diagonals << quiet / limit;
            }
        }
}

// Damping in half-steps around the step leaves the limit where it is. In the kicks of explicit
// Euler, a mode needs k·dt < c.
TEST(Nets, WithDampersAreWarnedOfFromTheRunsLimitOn) {
    for (const char* name : {"velocity_verlet", "explicit_euler", "semi_implicit_euler", "rk4"}) {
        const Method& method = find_method(name);
        const Bodies bodies = net(7, 6, 1, true, 2).bodies();
        const double quiet = longest_step(bodies, method, 0.003);
        EXPECT_FALSE(explodes(bodies, method, 0.99 * quiet, 20'000)) << name;
        EXPECT_TRUE(explodes(bodies, method, 1.05 * quiet, 20'000)) << name;
    }
}

// A solver of cubic time would take minutes.
TEST(Nets, OfAThousandBodiesAreJudged) {
    const Bodies bodies = net(40, 30, 1, true, 0.05).bodies();
    EXPECT_TRUE(is_warned(bodies, find_method("velocity_verlet"), 1 / 250.0));
    EXPECT_FALSE(is_warned(bodies, find_method("velocity_verlet"), 1 / 300.0));
}

/// A damped and an undamped body on a link.
Bodies unevenly_damped(double mass, double drag, double stiffness) {
    Bodies bodies(1, Precision::double_);
    bodies.add({.mass = mass}, LinearDrag{drag});
    bodies.add({});
    bodies.link(0, 1, {.stiffness = stiffness});
    return bodies;
}

/// A body on an anchored spring with a damper, linked to a free one.
Bodies damped_at_the_anchor() {
    Bodies bodies(1, Precision::double_);
    bodies.add({});
    bodies.add({.mass = 0.5}, Spring{.stiffness = 10, .damping = 5});
    bodies.link(0, 1, {.stiffness = 1010});
    return bodies;
}

TEST(UnevenDamping, IsWarnedOfFromTheRunsLimitOn) {
    struct Pair {
        const char* method;
        Bodies bodies;
        double around;
    };
    const std::vector<Pair> pairs{
        {"explicit_euler", unevenly_damped(2, 10, 100), 1 / 60.0},
        {"rk3_kutta", unevenly_damped(0.5, 10, 1000), 1 / 30.0},
        {"blanes_moan_srkn6b", damped_at_the_anchor(), 1 / 20.0},
        {"semi_implicit_euler", unevenly_damped(0.5, 10, 1000), 1 / 30.0},
        // Its drag alone needs 300·dt < 2.
        {"semi_implicit_euler", unevenly_damped(1, 300, 1), 2 / 300.0},
    };
    for (const auto& [name, bodies, around] : pairs) {
        const Method& method = find_method(name);
        const double quiet = longest_step(bodies, method, around);
        EXPECT_FALSE(explodes(bodies, method, 0.99 * quiet, 50'000)) << name << 1 / quiet;
        EXPECT_TRUE(explodes(bodies, method, 1.05 * quiet, 50'000)) << name << 1 / quiet;
    }
}

// The rate that the warning names is stable, and one below it is not.
TEST(UnevenDamping, HasAWarningWithAStableRate) {
    const Bodies bodies = unevenly_damped(2, 10, 100);
    const Method& method = find_method("explicit_euler");
    const auto risks = preflight(bodies, method, {{30}});
    ASSERT_EQ(risks.size(), 1U);
    const std::string line =
        describe(risks[0], method, {{30}}, [](std::size_t row) { return std::to_string(row); });
    const int named = std::stoi(line.substr(line.find("rate ≥ ") + std::string("rate ≥ ").size()));
    EXPECT_FALSE(explodes(bodies, method, 1.0 / named, 50'000)) << line;
    EXPECT_TRUE(explodes(bodies, method, 1.05 / named, 50'000)) << line;
}

class RandomScene : public Dice {
public:
    using Dice::Dice;

    /// Springs at rest: at their rest lengths, or of length 0 between bodies at one place.
    SpringScene make() {
        SpringScene scene{.axes = static_cast<int>(1 + below(3))};
        const std::size_t count = below(8) == 0 ? 20 + below(20) : 1 + below(5);
        const bool has_lengths = below(2) == 0;
        const double damping = below(2) == 0 ? 0 : log_uniform(0.1, 30);
        for (std::size_t i = 0; i < count; ++i) {
            SpringScene::Mass mass{.mass = log_uniform(0.3, 3)};
            if (has_lengths) mass.position[0] = 1.5 * double(i);
            for (int axis = 1; has_lengths && axis < scene.axes; ++axis)
                mass.position[axis] = uniform(-1, 1);
            if (damping > 0 && below(2) == 0) mass.linear_drag = damping * uniform(0, 2);
            scene.masses.push_back(mass);
        }
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t next = 1; next <= 1 + below(3) && i + next < count; ++next)
                scene.add_relaxed(pull(i, static_cast<std::ptrdiff_t>(i + next), damping),
                                  has_lengths);
            for (std::size_t anchors = i == 0 ? 1 : below(3); anchors > 0; --anchors) {
                auto anchored = pull(i, -1, damping);
                anchored.anchor = scene.masses[i].position;
                if (has_lengths)
                    for (int axis = 0; axis < scene.axes; ++axis)
                        anchored.anchor[axis] += uniform(0.2, 1) * (below(2) == 0 ? -1 : 1);
                scene.add_relaxed(anchored, has_lengths);
            }
        }
        return scene;
    }
    const Method& method() {
        constexpr std::array names{
            "semi_implicit_euler", "velocity_verlet", "position_verlet", "rk3_kutta",         "rk4",
            "explicit_euler",      "forest_ruth4",    "ruth3",           "blanes_moan_srkn6b"};
        return find_method(names.at(below(names.size())));
    }

private:
    SpringScene::Pull pull(std::size_t a, std::ptrdiff_t b, double damping) {
        return {.a = a,
                .b = b,
                .stiffness = log_uniform(30, 3000),
                .damping = below(2) == 0 ? 0 : damping * uniform(0, 1)};
    }
};

// Neither misses nor warnings that are more than 5 % early.
TEST(RandomSprings, AreWarnedOfIfTheyExplode) {
    int exploding = 0;
    for (int seed = 0; seed < campaign_length(); ++seed) {
        RandomScene random(static_cast<std::uint64_t>(seed));
        SpringScene scene = random.make();
        scene.links_to_points = seed % 2 == 1;
        const Method& method = random.method();
        const double limit = stability_limit(method, method.damping, {1, 0});
        const double dt = (limit > 0 ? limit : 1) / highest_frequency(scene) *
                          random.uniform(limit > 0 ? 0.6 : 0.1, 1.4);
        const Bodies bodies = scene.bodies();
        const bool warned = is_warned(bodies, method, dt);
        const int steps = scene.masses.size() > 5 ? 20'000 : 40'000;
        const bool unstable = explodes(bodies, method, dt, steps);
        exploding += unstable;
        const std::string where = "seed " + std::to_string(seed) + ", " + std::string(method.name) +
                                  ", dt = " + std::to_string(dt);
        EXPECT_TRUE(warned || !unstable) << "missed: " << where;
        if (warned && !unstable) {
            EXPECT_TRUE(explodes(bodies, method, 1.05 * dt, steps)) << "too early: " << where;
        }
    }
    EXPECT_GT(exploding, campaign_length() / 4);
    EXPECT_LT(exploding, campaign_length() * 9 / 10);
}

// velocity_verlet from x = 0 reaches v/ω/√(1 − (ω·dt/2)²): a hundred times as far just below its
// limit of 2, which is told in as many digits as differ, with a rate that stays below.
TEST(SpringWarning, TellsTheEdgeOfStability) {
    const Method& verlet = find_method("velocity_verlet");
    const auto growth = [](double k, double hertz) {
        return 1 / std::sqrt(1 - k / (hertz * hertz) / 4);
    };
    for (const double k : {14399.0, 14399.5, 4 * 75.0 * 75, 2.025e9}) {
        Bodies bodies(1, Precision::double_);
        bodies.add({.velocity = {1}}, Spring{.stiffness = k});
        const auto lines = warnings(bodies, verlet, {60});
        ASSERT_EQ(lines.size(), 1U) << k;
        const std::int64_t named = rate_in(lines[0]);
        EXPECT_GT(named, 60) << lines[0];
        EXPECT_LT(growth(k, static_cast<double>(named)), 100) << lines[0];
        EXPECT_FALSE(growth(k, static_cast<double>(named - 1)) < 100) << lines[0];
        EXPECT_TRUE(warnings(bodies, verlet, {named}).empty()) << k;
        EXPECT_LT(number_after(lines[0], "needs < "), number_after(lines[0], "ω·dt = "));
    }
    EXPECT_GT(growth(14399, 60), 100);
}

// Explicit Euler multiplies an oscillation by √(1 − c·dt + (ω·dt)²) per step, and wind of 10 m/s
// and 0.1/m damps it by c = 1/s or more: it shrinks for (ω·dt)² < c·dt, that is for ω <
// 60·√(1/60)/s.
TEST(SpringWarning, IsNotGivenForOneThatWindDamps) {
    const Method& euler = find_method("explicit_euler");
    for (const double omega : {3.0, 7.0, 8.5}) {
        Bodies bodies(2, Precision::double_);
        bodies.add({.position = {0, 1}}, Spring{.stiffness = omega * omega});
        EXPECT_EQ(warnings(bodies, euler, {60}).size(), 1U) << omega;
        bodies.attach(0, Wind{.velocity = {10, 0}, .coefficient = 0.1});
        const bool is_damped = omega < 60 * std::sqrt(1 / 60.0);
        EXPECT_EQ(warnings(bodies, euler, {60}).empty(), is_damped) << omega;
        if (!is_damped) continue;
        ASSERT_FALSE(bodies.try_step(euler, {{60}, 0, 60'000}));
        EXPECT_LT(length(bodies.velocity(0)), 1e-3) << omega;
    }
}

}  // namespace
}  // namespace oiler::test
