// SPDX-License-Identifier: MIT
#include "oiler/plot/plot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace oiler {
namespace {

const Plot square{.box = {{100, 50}, {300, 150}}, .x = {0, 10}, .y = {-1, 1}};

Plot with_curve(std::vector<DataPoint> points) {
    Plot plot = square;
    plot.series = {{.name = "curve", .colour = {255, 0, 0}, .points = std::move(points)}};
    return plot;
}

/// The red polylines of a drawn plot: its curve, in as many pieces as the box cuts it into.
std::vector<Polyline> curve_pieces(const Plot& plot, ElementKey key = {.object = 1}) {
    Picture picture;
    plot.draw(picture, key);
    std::vector<Polyline> pieces;
    for (const Polyline& line : picture.polylines)
        if (line.colour == Colour{255, 0, 0} && line.width == plot.series[0].width)
            pieces.push_back(line);
    return pieces;
}

TEST(Ticks, AreRoundAndWithinTheRange) {
    EXPECT_EQ(ticks({0, 20}, 8), (std::vector<double>{0, 5, 10, 15, 20}));
    EXPECT_EQ(ticks({-1000, 1000}, 4), (std::vector<double>{-1000, -500, 0, 500, 1000}));
    EXPECT_EQ(ticks({3, 7}, 4), (std::vector<double>{3, 4, 5, 6, 7}));
    EXPECT_EQ(ticks({0.12, 0.31}, 2), (std::vector<double>{0.2, 0.30000000000000004}));
}

TEST(Ticks, OfAnEmptyOrInfiniteRangeAreNone) {
    EXPECT_TRUE(ticks({1, 1}, 5).empty());
    EXPECT_TRUE(ticks({0, std::numeric_limits<double>::infinity()}, 5).empty());
}

TEST(Plot, MapsItsRangesOntoItsBox) {
    EXPECT_EQ(square.to_canvas({0, -1}), (Point{100, 50}));
    EXPECT_EQ(square.to_canvas({10, 1}), (Point{300, 150}));
    EXPECT_EQ(square.to_canvas({5, 0}), (Point{200, 100}));
}

TEST(Plot, DrawsACurveInOnePieceWithItsKey) {
    const auto pieces =
        curve_pieces(with_curve({{0, 0}, {5, 0.5}, {10, 0}}), {.object = 7, .jump = 3});
    ASSERT_EQ(pieces.size(), 1U);
    EXPECT_EQ(pieces[0].points.size(), 3U);
    EXPECT_EQ(pieces[0].key, (ElementKey{.object = 7, .part = 1, .jump = 3}));
}

TEST(Plot, CutsACurveAtTheBox) {
    // From the middle straight up to twice the height: cut where y = 1, half way.
    const auto pieces = curve_pieces(with_curve({{5, 0}, {6, 2}, {7, 0}}));
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_EQ(pieces[0].points.back(), (Point{210, 150}));
    EXPECT_EQ(pieces[1].points.front(), (Point{230, 150}));
    for (const Polyline& piece : pieces)
        for (const Point at : piece.points) EXPECT_LE(at.y, 150);
}

TEST(Plot, LeavesOutWhatIsWhollyOutside) {
    EXPECT_TRUE(curve_pieces(with_curve({{0, 2}, {10, 3}})).empty());
    EXPECT_TRUE(curve_pieces(with_curve({{11, 0}, {12, 0}})).empty());
}

TEST(Plot, SurvivesACurveThatRunsAwayToInfinity) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const Polyline& piece : curve_pieces(with_curve({{0, 0}, {1, 1e300}, {2, infinity}})))
        for (const Point at : piece.points) {
            EXPECT_GE(at.y, 50);
            EXPECT_LE(at.y, 150);
        }
}

TEST(Plot, LabelsEveryTickAndTheAxes) {
    Plot plot = square;
    plot.x_label = "time, s";
    plot.y_label = "position, m";
    Picture picture;
    plot.draw(picture, {});
    for (const char* words : {"time, s", "position, m", "0", "10", "-1", "1"})
        EXPECT_TRUE(std::any_of(picture.labels.begin(), picture.labels.end(),
                                [&](const Label& label) { return label.text == words; }))
            << words;
}

const Label& find(const Picture& picture, const std::string& text) {
    return *std::ranges::find(picture.labels, text, &Label::text);
}

TEST(Plot, PutsTitleAndRemarkAboveTheLegendAndTheYLabel) {
    Plot plot = with_curve({{0, 0}, {10, 1}});
    plot.title = "Title";
    plot.remark = "remark";
    plot.y_label = "position, m";
    Picture picture;
    plot.draw(picture, {});
    for (const char* above : {"Title", "remark"})
        for (const char* below : {"position, m", "curve"})
            EXPECT_GT(find(picture, above).at.y, find(picture, below).at.y + 11);
    EXPECT_EQ(find(picture, "Title").at.x, plot.box.low.x);
    EXPECT_EQ(find(picture, "remark").at.x, plot.box.high.x);
}

TEST(Plot, WrapsACaptionEvenlyWithinTheBox) {
    Plot plot = square;
    plot.x_label = "time, s";
    plot.caption =
        "Of two dozen words no line is longer than 200 units of canvas, at 10 units a letter.";
    Picture picture;
    plot.draw(picture, {});
    const float axis_label = find(picture, "time, s").at.y;
    std::string words;
    std::vector<std::size_t> lengths;
    for (const Label& label : picture.labels)
        if (label.at.y < axis_label && !label.text.empty()) {
            words += (words.empty() ? "" : " ") + label.text;
            lengths.push_back(label.text.size());
            EXPECT_EQ(label.at.x, plot.box.low.x);
        }
    EXPECT_EQ(words, plot.caption);
    ASSERT_EQ(lengths.size(), 3U);
    for (const std::size_t length : lengths) {
        EXPECT_LT(length, 36U);
        EXPECT_GT(length, 20U);
    }
}

TEST(Plot, KeepsANumberTogetherWithItsUnitAndName) {
    for (int letters = 1; letters < 60; ++letters) {
        Plot plot = square;
        plot.caption = std::string(static_cast<std::size_t>(letters), 'a') + " and t = 3.65 s then";
        Picture picture;
        plot.draw(picture, {});
        EXPECT_TRUE(std::ranges::any_of(picture.labels, [](const Label& label) {
            return label.text.find("t = 3.65 s") != std::string::npos;
        })) << letters;
    }
}

TEST(Plot, MarksThePointsWithinItsRangesAndItsLegend) {
    Plot plot = with_curve({{-1, 0}, {0, 0}, {5, 0.5}, {6, 2}, {10, 1}});
    Picture picture;
    plot.draw(picture, {});
    EXPECT_TRUE(picture.discs.empty());
    plot.series[0].mark = Mark::disc;
    plot.draw(picture, {});
    ASSERT_EQ(picture.discs.size(), 4U);
    EXPECT_GT(picture.discs[0].centre.y, plot.box.high.y);
    EXPECT_EQ(picture.discs[1].centre, (Point{100, 100}));
    EXPECT_EQ(picture.discs[2].centre, (Point{200, 125}));
    EXPECT_EQ(picture.discs[3].centre, (Point{300, 150}));
}

TEST(Plot, MarksWithRingsThatLetNothingThrough) {
    Plot plot = with_curve({{5, 0}});
    plot.series[0].mark = Mark::ring;
    Picture picture;
    plot.draw(picture, {});
    ASSERT_EQ(picture.discs.size(), 4U);
    EXPECT_EQ(picture.discs[2].colour, (Colour{255, 0, 0}));
    EXPECT_EQ(picture.discs[3].colour, picture.background);
    EXPECT_LT(picture.discs[3].radius, picture.discs[2].radius);
    EXPECT_EQ(picture.discs[3].centre, picture.discs[2].centre);
}

TEST(Plot, HasAsManyTicksAsItIsAskedFor) {
    const auto labels = [](int x_ticks) {
        Plot plot = square;
        plot.x_ticks = x_ticks;
        Picture picture;
        plot.draw(picture, {});
        return std::ranges::count(picture.labels, Align::centre, &Label::align);
    };
    EXPECT_EQ(labels(2), 3);
    EXPECT_EQ(labels(10), 11);
}

}  // namespace
}  // namespace oiler
