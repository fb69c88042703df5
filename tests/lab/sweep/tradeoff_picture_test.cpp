// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "oiler/picture/palette.hpp"
#include "support/text.hpp"

namespace oiler::test {
namespace {

using namespace lab;

TradeoffRow row_of(const char* method, std::int64_t rate, double us, double error) {
    TradeoffRow row{.stepping = {&find_method(method), {rate}, Precision::double_}};
    row.judgement.position_error = error;
    row.judgement.evaluations = 100 * us;
    row.ns_per_second = 1e3 * us;
    return row;
}

Ladder ladder_of(const char* method, const std::vector<TradeoffRow>& rows) {
    return {.method = &find_method(method), .rows = rows, .done = true};
}

/// A scene of rk4 at 40 Hz, 1 m wide.
Tradeoff made_up(const std::vector<Ladder>& ladders) {
    Tradeoff tradeoff;
    tradeoff.title = "Made up";
    tradeoff.current = {&find_method("rk4"), {40}, Precision::double_};
    tradeoff.reference.extent = 1;
    tradeoff.reference.floor.position = 1e-9;
    tradeoff.ladders = ladders;
    return tradeoff;
}

const CostAxis time_axis{time_of, 1e3, "computing for a second of the scene, µs", "µs"};

Tradeoff three_rates() {
    return made_up({ladder_of("rk4", {row_of("rk4", 20, 10, 1), row_of("rk4", 40, 100, 0.1),
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

struct Segment {
    Point from;
    Point to;
};

/// The points of the dashed line, the Pareto front of all methods.
std::vector<Segment> best_line(const Picture& picture) {
    std::vector<Segment> segments;
    for (const Polyline& line : picture.polylines)
        if (line.width == 2.2F && line.colour == palette::ink)
            for (std::size_t i = 1; i < line.points.size(); ++i)
                segments.push_back({line.points[i - 1], line.points[i]});
    return segments;
}

bool has_label(const Picture& picture, const std::string& text) {
    return std::any_of(picture.labels.begin(), picture.labels.end(),
                       [&](const Label& label) { return label.text == text; });
}

// ---- the best of all methods

TEST(BestLine, HasHorizontalAndVerticalSegmentsOnly) {
    const std::vector<Segment> segments = best_line(work_precision(three_rates(), time_axis));
    std::size_t along = 0;
    std::size_t down = 0;
    for (const auto& [from, to] : segments) {
        EXPECT_TRUE(from.x == to.x || from.y == to.y)
            << from.x << " " << from.y << " to " << to.x << " " << to.y;
        along += from.y == to.y && from.x < to.x;
        down += from.x == to.x && from.y > to.y;
    }
    EXPECT_GT(along, 10U);
    EXPECT_GT(down, 10U);
}

// Up to the cost of a row, the line stays at the error of the row before it.
TEST(BestLine, IsNeverBelowTheErrorsOfTheRows) {
    const Picture picture = work_precision(three_rates(), time_axis);
    const std::vector<Point> marks = marks_of(picture);
    ASSERT_EQ(marks.size(), 3U);
    constexpr float rounding = 1e-3F;
    for (const auto& [from, to] : best_line(picture))
        for (const Point at : {from, to})
            EXPECT_TRUE(std::any_of(
                marks.begin(), marks.end(),
                [&](Point mark) { return mark.x <= at.x + rounding && mark.y <= at.y + rounding; }))
                << at.x << " " << at.y;
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
    EXPECT_TRUE(has_label(time, "rk4 40 Hz: 100"));
    EXPECT_TRUE(has_label(time, "rk4 80 Hz: 1000"));
    const Picture forces = work_precision(
        three_rates(), {evaluations_of, 1, "force evaluations in the run", "forces"});
    EXPECT_TRUE(has_label(forces, "rk4 40 Hz: 1e+04"));
    EXPECT_TRUE(has_label(forces, "rk4 80 Hz: 1e+05"));
    EXPECT_FALSE(has_label(forces, "rk4 40 Hz: 100"));
}

// ---- methods

// Only these methods step the scene, each at one rate, and each is on the Pareto front.
Tradeoff of_methods(const std::vector<const char*>& names) {
    std::vector<Ladder> ladders;
    double us = 1;
    for (const char* name : names) {
        ladders.push_back(ladder_of(name, {row_of(name, 40, us, 1 / us)}));
        us *= 2;
    }
    return made_up(ladders);
}

TEST(NotableMethods, AreEightAtMost) {
    const std::vector<const char*> names{"rk4",         "velocity_verlet", "semi_implicit_euler",
                                         "exact",       "rk2_heun",        "rk3_kutta",
                                         "rk2_ralston", "rk2_midpoint",    "rk4_38"};
    EXPECT_EQ(notable_methods(of_methods(names)).size(), 8U);
    for (std::size_t count = 1; count <= 8; ++count) {
        const std::vector<const Method*> found =
            notable_methods(of_methods({names.begin(), names.begin() + std::ptrdiff_t(count)}));
        EXPECT_EQ(found.size(), count);
        EXPECT_EQ(found.front()->name, "rk4");
    }
}

}  // namespace
}  // namespace oiler::test
