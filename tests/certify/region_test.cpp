// SPDX-License-Identifier: MIT
#include "oiler/certify/region.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace {

using oiler::Damping;
using oiler::find_method;
using oiler::certify::measure_region;
using oiler::certify::StabilityGrid;
using oiler::certify::StabilityRegion;

constexpr StabilityGrid grid{.columns = 30, .rows = 12};

/// Whether a damped spring is stable by a formula.
using Formula = std::function<bool(double omega_dt, double zeta)>;

/// Checks cells whose centres are more than 1 % from the edge.
void expect_region(const char* name, Damping damping, const Formula& formula) {
    const StabilityRegion region = measure_region(find_method(name), damping, grid);
    int sure = 0;
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            const double h = grid.omega_dt_of(column);
            const double zeta = grid.zeta_of(row);
            if (formula(h * 0.99, zeta) != formula(h * 1.01, zeta)) continue;
            const std::size_t i = grid.index(column, row);
            EXPECT_EQ(region.stable[i], formula(h, zeta)) << name << ", " << h << ", " << zeta;
            EXPECT_EQ(region.bounded_double[i], formula(h, zeta)) << name << h << ", " << zeta;
            EXPECT_EQ(region.bounded_float[i], formula(h, zeta)) << name << h << ", " << zeta;
            ++sure;
        }
    EXPECT_GT(sure, 300);
}

// A cell whose columns all differ from their neighbours.
TEST(Region, HasALineOfCsvPerCell) {
    const StabilityRegion region{.method = &find_method("rk4"),
                                 .damping = Damping::in_drift,
                                 .spectral_radius = {0.5},
                                 .stable = {true},
                                 .bounded_double = {false},
                                 .bounded_float = {true}};
    EXPECT_EQ(oiler::certify::to_csv({region}, {.columns = 1, .rows = 1}),
              "method,damping,omega_dt,zeta,spectral_radius,stable,bounded_double,bounded_float\n"
              "rk4,drift,3,0,0.5,1,0,1\n");
}

// k·dt² + 2b·dt < 4, with m = 1.
TEST(Region, OfSemiImplicitEulerWithDampingInTheKicks) {
    expect_region("semi_implicit_euler", Damping::in_kick,
                  [](double h, double zeta) { return h * h + 4 * zeta * h < 4; });
}

// The step's trace is 1 + e − k·dt·(1 − e)/c and its determinant e = exp(−c·dt): stable while
// k·dt/c · tanh(c·dt/2) < 2.
TEST(Region, OfMethodsWithDampingInTheDrifts) {
    for (const char* name : {"semi_implicit_euler", "semi_implicit_euler_drift_kick",
                             "velocity_verlet", "position_verlet"})
        expect_region(name, Damping::in_drift, [](double h, double zeta) {
            const double z = 2 * zeta * h;
            return zeta == 0 ? h < 2 : h * h / z * std::tanh(z / 2) < 2;
        });
}

// det = 1 − c·dt + k·dt² ≤ 1, and |trace| ≤ 1 + det.
TEST(Region, OfExplicitEuler) {
    expect_region("explicit_euler", Damping::in_drift, [](double h, double zeta) {
        const double z = 2 * zeta * h;
        return h * h <= z && std::abs(2 - z) <= 2 - z + h * h;
    });
}

TEST(Region, OfImplicitAndExactMethodsIsUnlimited) {
    for (const char* name : {"implicit_euler", "implicit_midpoint", "exact"})
        expect_region(name, Damping::in_drift, [](double, double) { return true; });
}

TEST(Region, IsWrittenAsALineForEachCell) {
    const StabilityGrid small{.columns = 4, .rows = 3};
    const std::string csv =
        to_csv({measure_region(find_method("rk4"), Damping::in_drift, small)}, small);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 13);
    // Undamped, ω·dt = 0.75: |R(ih)|² = 1 − h⁶/72 + h⁸/576.
    const std::string first = csv.substr(csv.find('\n') + 1);
    EXPECT_TRUE(first.starts_with("rk4,drift,0.75,0,")) << first.substr(0, 40);
    const double radius = std::stod(first.substr(17));
    EXPECT_NEAR(radius, std::sqrt(1 - std::pow(0.75, 6) / 72 + std::pow(0.75, 8) / 576), 1e-9);
}

TEST(Atlas, NamesEveryMethodAndStaysOnTheCanvas) {
    const StabilityGrid small{.columns = 6, .rows = 4};
    std::vector<StabilityRegion> regions;
    for (const oiler::Method& method : oiler::methods())
        regions.push_back(measure_region(method, method.damping, small));
    const oiler::Picture picture = oiler::certify::atlas(regions, small);
    for (const oiler::Method& method : oiler::methods())
        EXPECT_EQ(std::count_if(picture.labels.begin(), picture.labels.end(),
                                [&](const auto& label) { return label.text == method.name; }),
                  1)
            << method.name;
    for (const auto& label : picture.labels) {
        EXPECT_GE(label.at.y, 1) << label.text;
        EXPECT_LE(label.at.y + label.size, oiler::canvas_height) << label.text;
        EXPECT_LE(label.at.x, oiler::canvas_width) << label.text;
    }
}

}  // namespace
