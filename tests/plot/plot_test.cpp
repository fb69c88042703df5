// SPDX-License-Identifier: MIT
#include "oiler/plot/plot.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

const Plot square{.box = {{100, 50}, {300, 150}}, .x = {0, 10}, .y = {-1, 1}};

Plot with_curve(std::vector<DataPoint> points) {
    Plot plot = square;
    plot.series = {{.name = "curve", .colour = {255, 0, 0}, .points = std::move(points)}};
    return plot;
}

/// The red polylines of a drawn plot: its curve, in one piece or several.
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
    // The line leads from the middle up to twice the height, and is cut half way, at y = 1.
    const auto pieces = curve_pieces(with_curve({{5, 0}, {6, 2}, {7, 0}}));
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_EQ(pieces[0].points.back(), (Point{210, 150}));
    EXPECT_EQ(pieces[1].points.front(), (Point{230, 150}));
    for (const Polyline& piece : pieces)
        for (const Point at : piece.points) EXPECT_LE(at.y, 150);
}

TEST(Plot, OmitsSegmentsOutsideTheBox) {
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

TEST(Plot, MarksWithRingsThatHideTheCurve) {
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

TEST(Plot, HasTheRequestedNumberOfTicks) {
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

const Plot logarithmic{.box = {{100, 50}, {400, 250}},
                       .x = {1, 1000},
                       .y = {1e-6, 1e4},
                       .x_scale = Scale::logarithmic,
                       .y_scale = Scale::logarithmic};

Plot logarithmic_with(std::vector<DataPoint> points) {
    Plot plot = logarithmic;
    plot.series = {{.name = "curve", .colour = {255, 0, 0}, .points = std::move(points)}};
    return plot;
}

Picture drawn(const Plot& plot, ElementKey key = {.object = 1}) {
    Picture picture;
    plot.draw(picture, key);
    return picture;
}

/// The texts of the labels with that alignment.
std::vector<std::string> words(const Plot& plot, Align align) {
    std::vector<std::string> found;
    for (const Label& label : drawn(plot).labels)
        if (label.align == align && !label.text.empty()) found.push_back(label.text);
    return found;
}

void expect_near(const std::vector<double>& at, const std::vector<double>& expected) {
    ASSERT_EQ(at.size(), expected.size());
    for (std::size_t i = 0; i < at.size(); ++i) EXPECT_NEAR(at[i] / expected[i], 1, 1e-12);
}

TEST(LogarithmicTicks, ArePowersOfTenInTheRequestedNumber) {
    expect_near(logarithmic_ticks({1, 1000}, 4), {1, 10, 100, 1000});
    expect_near(logarithmic_ticks({1, 100}, 4), {1, 10, 100});
    expect_near(logarithmic_ticks({0.5, 2e3}, 4), {1, 10, 100, 1000});
    expect_near(logarithmic_ticks({1e-6, 1e6}, 6), {1e-6, 1e-4, 1e-2, 1, 1e2, 1e4, 1e6});
    expect_near(logarithmic_ticks({1e-7, 1e5}, 4), {1e-6, 1e-3, 1, 1e3});
}

TEST(LogarithmicTicks, OfShortRangesHaveOtherNumbersToo) {
    expect_near(logarithmic_ticks({3, 60}, 4), {5, 10, 20, 50});
    expect_near(logarithmic_ticks({21, 45}, 5), {25, 30, 35, 40, 45});
}

TEST(LogarithmicTicks, OfRangesThatAreNotAboveZeroAreNone) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const Range range : {Range{0, 1}, Range{-1, 1}, Range{2, 1}, Range{1, 1},
                              Range{1, infinity}, Range{std::nan(""), 1}})
        EXPECT_TRUE(logarithmic_ticks(range, 4).empty()) << range.low << " " << range.high;
}

TEST(LogarithmicPlot, MapsDecadesEvenly) {
    EXPECT_EQ(logarithmic.to_canvas({1, 1e-6}), (Point{100, 50}));
    EXPECT_EQ(logarithmic.to_canvas({1000, 1e4}), (Point{400, 250}));
    EXPECT_NEAR(logarithmic.to_canvas({10, 1}).x, 200, 1e-3);
    EXPECT_NEAR(logarithmic.to_canvas({10, 1}).y, 170, 1e-3);
}

TEST(LogarithmicPlot, WritesPlainNumbersUpToFourDigits) {
    Plot plot = logarithmic;
    plot.y_ticks = 11;
    EXPECT_EQ(words(plot, Align::centre), (std::vector<std::string>{"1", "10", "100", "1000"}));
    EXPECT_EQ(words(plot, Align::right),
              (std::vector<std::string>{"1e-6", "1e-5", "1e-4", "0.001", "0.01", "0.1", "1", "10",
                                        "100", "1000", "1e4"}));
    plot.y = {1.5e-6, 6e-5};
    EXPECT_EQ(words(plot, Align::right),
              (std::vector<std::string>{"2e-6", "5e-6", "1e-5", "2e-5", "5e-5"}));
}

TEST(LogarithmicPlot, LeavesAGapAtAPointThatIsNotAboveZero) {
    const auto pieces = curve_pieces(
        logarithmic_with({{1, 1}, {10, 1}, {20, 0}, {100, 1}, {200, 1}, {300, -5}, {500, 1}}));
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_NEAR(pieces[0].points.back().x, 200, 1e-3);
    EXPECT_NEAR(pieces[1].points.front().x, 300, 1e-3);
    EXPECT_EQ(curve_pieces(logarithmic_with({{-1, 1}, {10, 1}, {100, 1}})).size(), 1U);
}

TEST(LogarithmicPlot, MarksOnlyPointsAboveZero) {
    Plot plot = logarithmic_with({{1, 1}, {0, 1}, {10, 0}, {-3, -4}, {1000, 1e4}});
    plot.series[0].mark = Mark::disc;
    EXPECT_EQ(drawn(plot).discs.size(), 3U);  // one of the legend's
}

TEST(LogarithmicPlot, HasAMinorGridOfFourDecadesAtMost) {
    const auto lines = [](Range x) {
        Plot plot = logarithmic;
        plot.x = x;
        plot.y = {0, 1};
        plot.y_scale = Scale::linear;
        plot.y_ticks = 1;
        return std::ranges::count_if(drawn(plot).polylines, [](const Polyline& line) {
            return line.points[0].x == line.points[1].x && line.width < 1;
        });
    };
    EXPECT_EQ(lines({1, 1e4}), 5 + 4 * 8);
    EXPECT_EQ(lines({1, 1e5}), 6);
}

/// The polylines of the mark at the only point of a plot.
std::vector<Polyline> outlines(Mark mark) {
    Plot plot = with_curve({{5, 0}});
    plot.series[0].name = "";
    plot.series[0].mark = mark;
    std::vector<Polyline> found;
    const Picture picture = drawn(plot);
    EXPECT_TRUE(picture.discs.empty());
    for (const Polyline& line : picture.polylines)
        if (line.points.size() > 3) found.push_back(line);
    return found;
}

TEST(Marks, ArePolygonsThatHideTheCurve) {
    for (const auto& [mark, corners] :
         {std::pair{Mark::square, 4U}, {Mark::diamond, 4U}, {Mark::triangle, 3U}}) {
        const auto lines = outlines(mark);
        ASSERT_EQ(lines.size(), 2U);
        EXPECT_EQ(lines[0].colour, Picture{}.background);
        EXPECT_EQ(lines[1].colour, (Colour{255, 0, 0}));
        for (const Polyline& line : lines) {
            EXPECT_EQ(line.points.size(), corners + 1);
            EXPECT_EQ(line.points.front(), line.points.back());
            EXPECT_EQ(line.key, ElementKey{});
            Point middle{};
            for (std::size_t i = 0; i < corners; ++i) {
                middle.x += line.points[i].x / static_cast<float>(corners);
                middle.y += line.points[i].y / static_cast<float>(corners);
            }
            EXPECT_NEAR(middle.x, 200, 1e-3);
            EXPECT_NEAR(middle.y, 100, 1e-3);
        }
    }
}

TEST(Marks, StandOnTheirSideOrOnTheirCorner) {
    const auto highest = [](Mark mark) {
        std::vector<Point> corners = outlines(mark).at(1).points;
        corners.pop_back();
        const float top = std::ranges::max(corners, {}, &Point::y).y;
        return std::ranges::count_if(corners, [&](Point at) { return at.y > top - 0.1F; });
    };
    EXPECT_EQ(highest(Mark::square), 2);
    EXPECT_EQ(highest(Mark::diamond), 1);
    EXPECT_EQ(highest(Mark::triangle), 1);
}

TEST(Marks, AreAboveEveryCurve) {
    Plot plot = with_curve({{5, 0}});
    plot.series[0].mark = Mark::square;
    plot.series.push_back({.name = "", .colour = {0, 255, 0}, .points = {{0, 0}, {10, 0}}});
    const auto lines = drawn(plot).polylines;
    EXPECT_EQ(lines.back().colour, (Colour{255, 0, 0}));
}

TEST(Plot, DashesACurveEvenlyAroundItsCorners) {
    Plot plot = with_curve({{0, 0}, {5, 0.5}, {10, 0}});
    plot.series[0].dashed = true;
    const auto dashes = curve_pieces(plot);
    const float whole = 2 * std::hypot(100.0F, 25.0F);
    EXPECT_NEAR(static_cast<float>(dashes.size()), whole / 11, 1);
    EXPECT_EQ(dashes.front().points.front(), (Point{100, 100}));
    for (const Polyline& dash : dashes) {
        EXPECT_EQ(dash.key, ElementKey{});
        float length = 0;
        for (std::size_t i = 1; i < dash.points.size(); ++i)
            length += std::hypot(dash.points[i].x - dash.points[i - 1].x,
                                 dash.points[i].y - dash.points[i - 1].y);
        const bool is_last = &dash == &dashes.back();
        EXPECT_NEAR(length, is_last ? std::min(length, 6.0F) : 6, 1e-3);
    }
}

TEST(Plot, ListsItsNamesBesideTheBoxFromTheTop) {
    Plot plot = square;
    plot.legend_beside = true;
    for (int i = 0; i < 12; ++i)
        plot.series.push_back({.name = "curve " + std::to_string(i),
                               .points = {{static_cast<double>(i) / 2, 0}},
                               .mark = Mark::disc});
    const Picture picture = drawn(plot);
    ASSERT_EQ(picture.discs.size(), 24U);
    float above = plot.box.high.y + 4;
    for (std::size_t i = 0; i < 12; ++i) {
        const Label name = find(picture, "curve " + std::to_string(i));
        EXPECT_EQ(name.align, Align::left);
        EXPECT_EQ(name.at.x, plot.box.high.x + 44);
        EXPECT_GT(name.at.y, plot.box.low.y - 1);
        EXPECT_LT(name.at.y, above - 7);
        above = name.at.y;
        EXPECT_GT(picture.discs[i].centre.x, plot.box.high.x);
        EXPECT_NEAR(picture.discs[i].centre.y, name.at.y + 3.5F, 1e-3F);
    }
}

// Twelve lines at 13 units are higher than the box.
TEST(Plot, ListsNamesOfSeveralLinesDownToTheBottomOfTheBox) {
    Plot plot = square;
    plot.legend_beside = true;
    plot.series.assign(6, {.name = "one\ntwo", .points = {{5, 0}}});
    int lines = 0;
    for (const Label& label : drawn(plot).labels) {
        if (label.text != "one" && label.text != "two") continue;
        EXPECT_GT(label.at.y, plot.box.low.y);
        ++lines;
    }
    EXPECT_EQ(lines, 12);
}

// The first curve has no point, the second none within the ranges, the third only crosses them.
TEST(Plot, NamesOnlyCurvesThatAreDrawn) {
    for (const bool beside : {false, true}) {
        Plot plot = square;
        plot.legend_beside = beside;
        plot.series = {{.name = "none"},
                       {.name = "outside", .points = {{0, 3}, {10, 3}}},
                       {.name = "across", .points = {{-5, 0}, {15, 0}}}};
        const Picture picture = drawn(plot);
        const auto has = [&](const char* name) {
            return std::ranges::find(picture.labels, name, &Label::text) != picture.labels.end();
        };
        EXPECT_FALSE(has("none"));
        EXPECT_FALSE(has("outside"));
        EXPECT_TRUE(has("across"));
    }
}

TEST(Plot, WritesNotesBelowTheNamesBesideTheBox) {
    Plot plot = with_curve({{5, 0}});
    plot.legend_beside = true;
    plot.series[0].name = "one\ntwo";
    plot.notes = {"first", "second"};
    const Picture picture = drawn(plot);
    float above = plot.box.high.y;
    for (const char* line : {"one", "two", "first", "second"}) {
        const Label label = find(picture, line);
        EXPECT_LE(label.at.y + label.size, above + 3) << line;
        above = label.at.y;
    }
}

// A ring of 5.2 units around the point, on the layer above the marks, and no line.
TEST(Marks, AroundOtherMarksHideNothing) {
    for (const Mark mark : {Mark::halo, Mark::frame}) {
        Plot plot = with_curve({{5, 0}, {6, 0}});
        plot.series[0].name = "";
        plot.series[0].width = 0;
        plot.series[0].mark = mark;
        const Picture picture = drawn(plot);
        EXPECT_TRUE(picture.discs.empty());
        std::vector<Polyline> red;
        for (const Polyline& line : picture.polylines)
            if (line.colour == Colour{255, 0, 0}) red.push_back(line);
        ASSERT_EQ(red.size(), 2U);
        for (const Polyline& line : red) {
            EXPECT_EQ(line.layer, 1);
            const auto [low, high] = std::ranges::minmax(line.points, {}, &Point::x);
            EXPECT_NEAR(high.x - low.x, 10.4F, 0.1F);
        }
        EXPECT_NEAR(std::ranges::max(red[0].points, {}, &Point::x).x, 205.2F, 0.1F);
    }
}

}  // namespace
}  // namespace oiler::test
