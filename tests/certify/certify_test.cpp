// SPDX-License-Identifier: MIT
#include <functional>
#include <set>

#include "oiler/certify/certify.hpp"
#include "oiler/certify/region.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using certify::Certificate;
using certify::certify;

constexpr std::int64_t steps = 50'000;

Certificate certificate_of(const Method& method) { return certify(method, method.damping, steps); }

class EachMethod : public testing::TestWithParam<Method> {};

TEST_P(EachMethod, IsWhatItsTableClaims) {
    const Certificate certificate = certificate_of(GetParam());
    for (const std::string& failure : certificate.failures) ADD_FAILURE() << failure;
    EXPECT_GE(certificate.orders.size(), 4U);
    // A step alone shares no kick with the next one.
    if (const auto* splitting = std::get_if<Splitting>(&GetParam().rule)) {
        EXPECT_EQ(
            certificate.single_evaluations,
            static_cast<double>(std::ranges::count(splitting->stages(), Move::kick, &Stage::move)));
    }
}

INSTANTIATE_TEST_SUITE_P(Certificate, EachMethod,
                         testing::ValuesIn(methods().begin(), methods().end()),
                         [](const auto& tested) { return std::string(tested.param.name); });

// With damping in the kicks, all splittings claim order 1 on the damped spring.
TEST(Certificate, HoldsForDampingInTheKicks) {
    for (const char* name : {"velocity_verlet", "forest_ruth4", "kahan_li8_kdk"}) {
        const Certificate certificate = certify(find_method(name), Damping::in_kick, steps);
        for (const std::string& failure : certificate.failures) ADD_FAILURE() << failure;
    }
}

/// Expects the certificate to have a failure that contains `reason`.
void expect_failure(const Method& method, const std::string& reason) {
    const Certificate certificate = certificate_of(method);
    const auto& failures = certificate.failures;
    EXPECT_TRUE(std::any_of(
        failures.begin(), failures.end(),
        [&](const std::string& failure) { return failure.find(reason) != std::string::npos; }))
        << method.name << testing::PrintToString(failures);
}

Method with_rule(const char* name, const decltype(Method::rule)& rule) {
    Method method = find_method(name);
    method.rule = rule;
    return method;
}

// PEFRL with the sign of one kick reversed.
TEST(BrokenTable, WithAWrongSignFails) {
    const auto k = [](long double c) { return Stage{Move::kick, c}; };
    const auto d = [](long double c) { return Stage{Move::drift, c}; };
    const Method broken =
        with_rule("pefrl", Splitting::palindrome({d(0.1786178958448091L), k(0.7123418310626054L),
                                                  d(-0.06626458266981849L), k(0.2123418310626054L),
                                                  d(0.77529337365001878L)}));
    expect_failure(broken, "spring in long double: positions fall as dt^0.0");
    expect_failure(broken, "orbit in double");
}

// Ruth's third order with its first two kicks swapped.
TEST(BrokenTable, WithASwappedPairFails) {
    const Method broken = with_rule("ruth3", Splitting{{Move::kick, 3 / 4.0L},
                                                       {Move::drift, 2 / 3.0L},
                                                       {Move::kick, 7 / 24.0L},
                                                       {Move::drift, -2 / 3.0L},
                                                       {Move::kick, -1 / 24.0L},
                                                       {Move::drift, 1}});
    expect_failure(broken, "spring in long double: positions fall as dt^1.0");
}

// Forest and Ruth's outer drifts cut to six digits.
TEST(BrokenTable, WithATruncatedCoefficientFails) {
    const auto k = [](long double c) { return Stage{Move::kick, c}; };
    const auto d = [](long double c) { return Stage{Move::drift, c}; };
    const Method broken =
        with_rule("forest_ruth4",
                  Splitting::palindrome({d(0.675603L), k(1.351207191959657634L),
                                         d(-0.17560359597982881702L), k(-1.702414383919315268L)}));
    expect_failure(broken, "claimed 4");
}

// Swapped weights of a tableau keep their sum.
TEST(BrokenTable, OfRungeAndKuttaFails) {
    const Method broken = with_rule("rk4", Tableau{{{1 / 2.0L}, {0, 1 / 2.0L}, {0, 0, 1}},
                                                   {1 / 3.0L, 1 / 6.0L, 1 / 3.0L, 1 / 6.0L},
                                                   {0, 1 / 2.0L, 1 / 2.0L, 1}});
    expect_failure(broken, "positions fall as dt^");
}

TEST(FalseClaim, OfBeingSymplecticFails) {
    Method claims = find_method("rk4");
    claims.symplectic = true;
    expect_failure(claims, "claimed symplectic, but the defect is");
    expect_failure(claims, "energy grows by");
}

TEST(FalseClaim, OfNotBeingSymplecticFails) {
    Method claims = find_method("velocity_verlet");
    claims.symplectic = false;
    expect_failure(claims, "claimed not symplectic");
}

TEST(FalseClaim, OfSymmetryFails) {
    Method claims = find_method("mclachlan_atela5");
    claims.symmetric = true;
    expect_failure(claims, "claimed symmetric, but the defect is");
}

TEST(FalseClaim, OfAnotherOrderFails) {
    Method claims = find_method("rk3_kutta");
    claims.order = 4;
    expect_failure(claims, "claimed 4");
    claims.order = 2;
    expect_failure(claims, "claimed 2");
}

TEST(FalseClaim, OfFewerEvaluationsFails) {
    Method claims = find_method("position_verlet");
    claims.evaluations = 2;
    expect_failure(claims, "1.000 force evaluations per step, claimed 2");
}

// A published "SymplecticEuler" was plain explicit Euler.
TEST(FalseClaim, OfExplicitEulerToBeSemiImplicitFails) {
    expect_failure(with_rule("semi_implicit_euler", find_method("explicit_euler").rule),
                   "claimed symplectic");
}

using certify::measure_region;
using certify::StabilityGrid;
using certify::StabilityRegion;

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
    EXPECT_EQ(certify::to_csv({region}, {.columns = 1, .rows = 1}),
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

const StabilityGrid small{.columns = 6, .rows = 4};

Picture atlas_of(std::size_t panels) {
    static const std::vector<StabilityRegion> all = [] {
        std::vector<StabilityRegion> regions;
        for (const Method& method : methods())
            regions.push_back(measure_region(method, method.damping, small));
        return regions;
    }();
    return certify::atlas({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(panels)}, small);
}

struct Area {
    float left, right, low, high;
    [[nodiscard]] bool meets(const Area& other) const {
        return left < other.right && other.left < right && low < other.high && other.low < high;
    }
};

Area area_of(const Sprite& panel) {
    return {panel.centre.x - panel.size.x / 2, panel.centre.x + panel.size.x / 2,
            panel.centre.y - panel.size.y / 2, panel.centre.y + panel.size.y / 2};
}

/// Its letters of DejaVu Sans are 0.49 em wide on average, as those of the longest name and the
/// longest line of the legend, and 0.76 em high.
Area area_of(const Label& label) {
    const auto letters = static_cast<float>(std::count_if(
        label.text.begin(), label.text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
    const float width = 0.49F * label.size * letters;
    const float part = label.align == Align::left ? 0 : label.align == Align::right ? 1 : 0.5F;
    return {label.at.x - part * width, label.at.x + (1 - part) * width, label.at.y,
            label.at.y + 0.76F * label.size};
}

TEST(Atlas, HasAPanelWithANameForEachMethod) {
    for (std::size_t panels = 1; panels <= methods().size(); ++panels) {
        const Picture picture = atlas_of(panels);
        EXPECT_EQ(picture.sprites.size(), panels);
        std::size_t named = 0;
        for (const auto& label : picture.labels)
            named +=
                static_cast<std::size_t>(std::ranges::count(methods(), label.text, &Method::name));
        EXPECT_EQ(named, panels);
    }
}

TEST(Atlas, HasPanelsAndLabelsThatDoNotMeetOnTheCanvas) {
    for (std::size_t panels = 1; panels <= methods().size(); ++panels) {
        const Picture picture = atlas_of(panels);
        std::vector<Area> areas;
        for (const auto& sprite : picture.sprites) areas.push_back(area_of(sprite));
        for (const auto& label : picture.labels) areas.push_back(area_of(label));
        for (std::size_t i = 0; i < areas.size(); ++i) {
            EXPECT_GE(areas[i].left, 0) << panels << " panels, " << i;
            EXPECT_LE(areas[i].right, canvas_width) << panels << " panels, " << i;
            EXPECT_GE(areas[i].low, 2) << panels << " panels, " << i;
            EXPECT_LE(areas[i].high, canvas_height) << panels << " panels, " << i;
            for (std::size_t k = 0; k < i; ++k)
                EXPECT_FALSE(areas[i].meets(areas[k]))
                    << panels << " panels, " << i << " and " << k;
        }
    }
}

// The lowest panel has 0, 1, 2 and 3 below it.
TEST(Atlas, HasTheNumbersOfOmegaOnceInEachColumn) {
    for (std::size_t panels = 1; panels <= methods().size(); ++panels) {
        const Picture picture = atlas_of(panels);
        std::set<float> columns;
        for (const auto& sprite : picture.sprites) columns.insert(sprite.centre.x);
        EXPECT_EQ(std::ranges::count(picture.labels, Align::centre, &Label::align),
                  4 * std::ssize(columns))
            << panels;
    }
}

// The panels of a few methods cover what those of all methods do, at least: no place is lost.
TEST(Atlas, FillsTheCanvasWithAnyNumberOfPanels) {
    for (std::size_t panels = 1; panels <= methods().size(); ++panels) {
        float covered = 0;
        for (const auto& sprite : atlas_of(panels).sprites)
            covered += sprite.size.x * sprite.size.y;
        EXPECT_GT(covered, 0.36F * canvas_width * canvas_height) << panels;
    }
}

// A texel for each cell, so that there is no seam between cells.
TEST(Atlas, ShowsCellsAsOneImage) {
    const Picture picture = atlas_of(1);
    ASSERT_TRUE(picture.sprites.at(0).bitmap);
    EXPECT_FALSE(picture.sprites[0].is_smooth);
}

}  // namespace
}  // namespace oiler::test
