// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff_picture.hpp"

#include "lab/measured_scenes.hpp"
#include "oiler/picture/palette.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

TradeoffRow row_of(const char* method, std::int64_t rate, double us, double error) {
    TradeoffRow row{.stepping = {&find_method(method), {rate}, Precision::double_}};
    row.judgement.position_error = error;
    row.judgement.evaluations = 100 * us;
    row.ns_per_second = 1e3 * us;
    return row;
}

RateSeries series_of(const char* method, const std::vector<TradeoffRow>& rows) {
    return {.method = &find_method(method), .rows = rows, .done = true};
}

/// A scene of rk4 at 40 Hz, 1 m wide.
Tradeoff made_up(const std::vector<RateSeries>& all_series) {
    Tradeoff tradeoff;
    tradeoff.title = "Made up";
    tradeoff.current = {&find_method("rk4"), {40}, Precision::double_};
    tradeoff.reference.extent = 1;
    tradeoff.reference.floor.position = 1e-9;
    tradeoff.all_series = all_series;
    return tradeoff;
}

const CostAxis time_axis{time_of, 1e3, "computing for a second of the scene, µs", "µs"};

Tradeoff three_rates() {
    return made_up({series_of("rk4", {row_of("rk4", 20, 10, 1), row_of("rk4", 40, 100, 0.1),
                                      row_of("rk4", 80, 1000, 0.01)})});
}

/// The marks of the first method, which are discs, from left to right, without the legend's.
std::vector<Point> marks_of(const Picture& picture) {
    std::vector<Point> marks;
    for (const Disc& disc : picture.discs) marks.push_back(disc.centre);
    std::sort(marks.begin(), marks.end(), [](Point a, Point b) { return a.x < b.x; });
    if (!marks.empty()) marks.pop_back();
    return marks;
}

/// The ends of the outlines with that width, such as the marks around other marks.
std::vector<Point> centres(const Picture& picture, float width, Colour colour) {
    std::vector<Point> found;
    for (const Polyline& line : picture.polylines) {
        if (line.width != width || line.colour != colour || line.layer != 1) continue;
        const auto [left, right] = std::ranges::minmax(line.points, {}, &Point::x);
        const auto [low, high] = std::ranges::minmax(line.points, {}, &Point::y);
        found.push_back({(left.x + right.x) / 2, (low.y + high.y) / 2});
    }
    std::ranges::sort(found, {}, &Point::x);
    return found;
}

/// The corners of the wide band below the curves.
std::vector<Point> front_of(const Picture& picture) {
    std::vector<Point> corners;
    for (const Polyline& line : picture.polylines)
        if (line.width == 9) corners.insert(corners.end(), line.points.begin(), line.points.end());
    return corners;
}

bool is_near(Point a, Point b) { return std::abs(a.x - b.x) < 0.1F && std::abs(a.y - b.y) < 0.1F; }

bool has_label(const Picture& picture, const std::string& text) {
    return std::any_of(picture.labels.begin(), picture.labels.end(),
                       [&](const Label& label) { return label.text == text; });
}

// ---- the front

// rk4 is the only method with a curve in double, and rk4 in float is cheaper at 20 Hz.
TEST(Front, HasAMarkAtEachOfItsCorners) {
    Tradeoff tradeoff = three_rates();
    TradeoffRow in_float = row_of("rk4", 20, 5, 1);
    in_float.stepping.precision = Precision::single;
    tradeoff.all_series.push_back({.method = &find_method("rk4"),
                                   .precision = Precision::single,
                                   .rows = {in_float},
                                   .done = true});
    const Picture picture = work_precision(tradeoff, time_axis);
    const std::vector<Point> corners = front_of(picture);
    EXPECT_EQ(corners.size(), 3U);
    for (const Point corner : corners)
        EXPECT_TRUE(std::ranges::any_of(
            picture.discs, [&](const Disc& disc) { return is_near(disc.centre, corner); }))
            << corner.x << " " << corner.y;
    EXPECT_TRUE(has_label(picture, "other settings on the front"));
}

// ---- marks and axes

TEST(WorkPrecisionPicture, FramesTheCurrentSetting) {
    const Picture picture = work_precision(three_rates(), time_axis);
    const std::vector<Point> frames = centres(picture, 1.5F, palette::black);
    ASSERT_EQ(frames.size(), 2U);  // one in the legend
    EXPECT_TRUE(is_near(frames[0], marks_of(picture).at(1)));
    EXPECT_TRUE(has_label(picture, "current: 40 Hz"));
}

// The extent of 1 m asks for at most 0.1 m, then 0.01 m; nothing is within 0.001 m.
TEST(WorkPrecisionPicture, RingsTheLeastCosts) {
    const Picture picture = work_precision(three_rates(), time_axis);
    const std::vector<Point> rings = centres(picture, 1.5F, palette::ink);
    ASSERT_EQ(rings.size(), 3U);  // one in the legend
    EXPECT_TRUE(is_near(rings[0], marks_of(picture).at(1)));
    EXPECT_TRUE(is_near(rings[1], marks_of(picture).at(2)));
}

// A cost for each decade of errors from 1 m to 1e-12 m. Three of seven decades are game-sized, so
// they have at least a third of the axis.
TEST(WorkPrecisionPicture, HasRoomForErrorsOfGames) {
    std::vector<TradeoffRow> rows;
    for (int i = 0; i <= 12; ++i)
        rows.push_back(row_of("rk4", 20 << i, std::pow(2, i), std::pow(10, -i)));
    Tradeoff tradeoff = made_up({series_of("rk4", rows)});
    tradeoff.reference.floor.position = 1e-14;
    const Picture picture = work_precision(tradeoff, time_axis);
    const std::vector<Point> marks = marks_of(picture);
    ASSERT_GE(marks.size(), 7U);
    EXPECT_LE(marks.size(), 8U);
    float lowest = canvas_height;
    float highest = 0;
    for (const Polyline& line : picture.polylines)
        for (const Point at : line.points) {
            if (line.points.size() != 2 || line.colour != palette::ink) continue;
            lowest = std::min(lowest, at.y);
            highest = std::max(highest, at.y);
        }
    EXPECT_GT(marks[0].y - marks[3].y, (highest - lowest) / 3);
    for (const Point corner : front_of(picture)) EXPECT_GE(corner.y, lowest);
}

// Costs and errors are a decade apart, so marks are equally far apart in both directions.
TEST(WorkPrecisionPicture, IsLogarithmicInBoth) {
    const std::vector<Point> marks = marks_of(work_precision(three_rates(), time_axis));
    ASSERT_EQ(marks.size(), 3U);
    EXPECT_NEAR(marks[1].x - marks[0].x, marks[2].x - marks[1].x, 1e-3);
    EXPECT_NEAR(marks[0].y - marks[1].y, marks[1].y - marks[2].y, 1e-3);
    EXPECT_GT(marks[1].x, marks[0].x);
    EXPECT_LT(marks[1].y, marks[0].y);
}

// ---- words

// 10,000, 100,000 and 1,000,000 ns are 10, 100 and 1000 µs. The made-up evaluations are 100 times
// these.
TEST(WorkPrecisionPicture, ListsTheLeastCostsInTheUnitOfItsAxis) {
    const Picture time = work_precision(three_rates(), time_axis);
    EXPECT_TRUE(has_label(time, "10 cm: 100 µs"));
    EXPECT_TRUE(has_label(time, "  rk4 40 Hz"));
    EXPECT_TRUE(has_label(time, "1 cm: 1000 µs"));
    EXPECT_TRUE(has_label(time, "  rk4 80 Hz"));
    const Picture forces = work_precision(
        three_rates(), {evaluations_of, 1, "force evaluations in the run", "forces"});
    EXPECT_TRUE(has_label(forces, "10 cm: 1e+04 forces"));
    EXPECT_TRUE(has_label(forces, "1 cm: 1e+05 forces"));
    EXPECT_FALSE(has_label(forces, "10 cm: 100 µs"));
}

TEST(WorkPrecisionPicture, NamesCurvesThatLieOnEachOtherTogether) {
    const auto rows = [](const char* method) {
        return series_of(method, {row_of(method, 20, 10, 1), row_of(method, 40, 100, 0.1)});
    };
    Tradeoff tradeoff = made_up({rows("rk4"), rows("velocity_verlet")});
    EXPECT_TRUE(has_label(work_precision(tradeoff, time_axis), "= velocity_verlet"));
    tradeoff.all_series[1].rows[1].judgement.position_error = 0.2;
    EXPECT_TRUE(has_label(work_precision(tradeoff, time_axis), "velocity_verlet"));
}

// ---- energy

// The closed form of a spring has no error. Semi-implicit Euler changes the energy by up to ω·dt/2,
// 1.9 % at 100 Hz.
TEST(EnergyPicture, ListsMethodsWithoutACurveBelowTheLegend) {
    const MeasuredScene measured(article_spring);
    Tradeoff tradeoff;
    tradeoff.title = "Spring";
    const Picture picture =
        energy_over_time(measured.scene, tradeoff, measured.reference,
                         {{&find_method("exact"), {100}, Precision::double_},
                          {&find_method("semi_implicit_euler"), {100}, Precision::double_}});
    EXPECT_TRUE(has_label(picture, "semi_implicit_euler"));
    EXPECT_FALSE(has_label(picture, "exact"));
    EXPECT_TRUE(has_label(picture, "  exact"));
}

// ---- methods

// Only these methods step the scene, each at one rate, and each is on the Pareto front.
Tradeoff of_methods(const std::vector<const char*>& names) {
    std::vector<RateSeries> all_series;
    double us = 1;
    for (const char* name : names) {
        all_series.push_back(series_of(name, {row_of(name, 40, us, 1 / us)}));
        us *= 2;
    }
    return made_up(all_series);
}

TEST(NotableMethods, AreSixAtMost) {
    const std::vector<const char*> names{"rk4",         "velocity_verlet", "semi_implicit_euler",
                                         "exact",       "rk2_heun",        "rk3_kutta",
                                         "rk2_ralston", "rk2_midpoint",    "rk4_38"};
    EXPECT_EQ(notable_methods(of_methods(names)).size(), 6U);
    for (std::size_t count = 1; count <= 6; ++count) {
        const std::vector<const Method*> found =
            notable_methods(of_methods({names.begin(), names.begin() + std::ptrdiff_t(count)}));
        EXPECT_EQ(found.size(), count);
        EXPECT_EQ(found.front()->name, "rk4");
    }
}

// The longest names, the current setting and four tolerances. In DejaVu Sans the longest name
// measures 0.49 em per letter, the label of the y axis 0.50.
TEST(WorkPrecisionPicture, HasLabelsThatDoNotTouch) {
    Tradeoff tradeoff =
        of_methods({"rk4", "semi_implicit_euler_drift_kick", "velocity_verlet",
                    "semi_implicit_euler", "mclachlan8_s15_kdk", "blanes_moan_srkn14a"});
    for (int i = 0; i < 4; ++i)
        tradeoff.all_series.push_back(
            series_of("exact", {row_of("exact", 10 << i, 50 << i, 0.1 * std::pow(10, -i))}));
    const std::vector<Label> labels = work_precision(tradeoff, time_axis).labels;
    const auto width = [](const Label& label) {
        return 0.52F * label.size * static_cast<float>(label.text.size());
    };
    const auto left = [&](const Label& label) {
        const float part = label.align == Align::left ? 0 : label.align == Align::right ? 1 : 0.5F;
        return label.at.x - part * width(label);
    };
    for (const Label& a : labels) {
        EXPECT_GE(left(a), 0) << a.text;
        EXPECT_LE(left(a) + width(a), canvas_width) << a.text;
        for (const Label& b : labels)
            EXPECT_TRUE(&a == &b || a.text.empty() || b.text.empty() ||
                        std::abs(a.at.y - b.at.y) >= std::max(a.size, b.size) ||
                        left(a) + width(a) <= left(b) || left(b) + width(b) <= left(a))
                << a.text << " and " << b.text;
    }
}

}  // namespace
}  // namespace oiler::test
