// SPDX-License-Identifier: MIT
#include "oiler/certify/region.hpp"

#include <functional>

#include "support/test.hpp"

namespace oiler::test {
namespace {

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
