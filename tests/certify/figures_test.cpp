// SPDX-License-Identifier: MIT
#include "oiler/certify/figures.hpp"

#include <fmt/format.h>

#include "oiler/physics/closed_forms.hpp"
#include "oiler/picture/palette.hpp"
#include "support/reference.hpp"
#include "support/spring.hpp"
#include "support/test.hpp"

namespace oiler::test {
using namespace certify;
namespace {

/// The expected contents of the figures, in order.
struct Expected {
    double b;
    int rate;
    double from, to;
    std::vector<std::string> methods;
};

const std::vector<std::string> euler{"semi_implicit_euler"}, both{"semi_implicit_euler", "rk4"};
const std::vector<Expected> expected{
    {damping, 100, 0, 20, {}},      {damping, 100, 0, 90, {"explicit_euler"}},
    {damping, 100, 0, 10, euler},   {damping, 100, 0, 10, both},
    {damping, 100, 3.6, 3.7, both}, {0, 10, 0, 20, {}},
    {0, 10, 86, 90, both},          {0, 4, 0, 90, {"rk4"}},
    {0, 4, 0, 90, euler},           {0, 4, 84, 90, both}};

const std::vector<Figure>& figures() {
    static const std::vector<Figure> all = article_figures();
    return all;
}

struct Style {
    const char* name;
    Colour colour;
};
const std::map<std::string, Style> styles{
    {"explicit_euler", {"explicit Euler", palette::purple}},
    {"semi_implicit_euler", {"semi-implicit Euler", palette::vermilion}},
    {"rk4", {"RK4", palette::green}}};

bool has_label(const Picture& picture, const std::string& text) {
    return std::ranges::find(picture.labels, text, &Label::text) != picture.labels.end();
}

/// Whether a label is below the x axis and its name.
bool is_in_caption(const Label& label) { return label.align == Align::left && label.at.y < 45; }

std::string caption(const Picture& picture) {
    std::string words;
    for (const Label& label : picture.labels)
        if (is_in_caption(label)) words += (words.empty() ? "" : " ") + label.text;
    return words;
}

struct Tick {
    double at, value;
};

/// Tick labels are centred along the x axis and right-aligned along the y axis.
std::vector<Tick> ticks_of(const Picture& picture, Align align) {
    std::vector<Tick> ticks;
    for (const Label& label : picture.labels)
        if (label.align == align &&
            label.text.find_first_not_of("-.0123456789") == std::string::npos)
            ticks.push_back(
                {align == Align::centre ? label.at.x : label.at.y + 3, std::stod(label.text)});
    return ticks;
}

double between_ticks(const std::vector<Tick>& ticks, double at) {
    const auto& [a, low] = ticks.front();
    const auto& [b, high] = ticks.back();
    return low + (at - a) / (b - a) * (high - low);
}

struct Seen {
    double t, x;
};

/// The longest line of a colour, in the units of the ticks. Its swatch in the legend is shorter.
std::vector<Seen> curve(const Picture& picture, const Colour& colour) {
    const Polyline& line = *std::ranges::max_element(picture.polylines, {}, [&](const Polyline& l) {
        return l.colour == colour ? l.points.size() : 0;
    });
    const std::vector<Tick> t = ticks_of(picture, Align::centre);
    const std::vector<Tick> x = ticks_of(picture, Align::right);
    std::vector<Seen> seen;
    for (const Point at : line.points)
        seen.push_back({between_ticks(t, at.x), between_ticks(x, at.y)});
    return seen;
}

double exact_x(double b, double t) {
    return damped_oscillator(1.0, stiffness, b, {start_x, 0.0}, t).x;
}

double stepped_x(const Expected& run, const std::string& method, std::int64_t tick) {
    Bodies bodies = article_spring(run.b);
    bodies.step(find_method(method), {{run.rate}, 0, tick});
    return bodies.position(0)[0];
}

TEST(ArticleFigures, HaveTitlesLegendsAndCaptions) {
    ASSERT_EQ(figures().size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        SCOPED_TRACE(figures()[i].name);
        const Picture& picture = figures()[i].picture;
        EXPECT_TRUE(figures()[i].name.starts_with(fmt::format("{:02}_", i + 1)));
        const auto title = std::ranges::max_element(picture.labels, {}, &Label::size);
        EXPECT_GT(title->text.size(), 10U);
        for (const char* words : {"time, s", "position, m", "exact"})
            EXPECT_TRUE(has_label(picture, words)) << words;
        for (const std::string& method : expected[i].methods)
            EXPECT_TRUE(has_label(picture, styles.at(method).name)) << method;
        EXPECT_TRUE(caption(picture).ends_with("."));
        EXPECT_LE(std::ranges::count_if(picture.labels, is_in_caption), 2);
        EXPECT_GE(ticks_of(picture, Align::centre).size(), 7U);
        EXPECT_LE(ticks_of(picture, Align::centre).size(), 11U);
        EXPECT_EQ(ticks_of(picture, Align::right).size(), 5U);
    }
}

TEST(ArticleFigures, DrawTheExactMotion) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
        SCOPED_TRACE(figures()[i].name);
        const auto line = curve(figures()[i].picture, expected[i].to - expected[i].from > 50
                                                          ? Colour{155, 211, 242}
                                                          : palette::sky_blue);
        ASSERT_GT(line.size(), 2000U);
        EXPECT_NEAR(line.front().t, expected[i].from, 1e-4);
        EXPECT_NEAR(line.back().t, expected[i].to, 1e-4);
        // In float, a canvas of 90 s resolves 5 μs, in which the mass moves by 2 cm.
        for (const auto& [t, x] : line) EXPECT_NEAR(x, exact_x(expected[i].b, t), 0.04);
    }
}

TEST(ArticleFigures, HaveTheExactMotionOfTheReference) {
    for (const auto& [figure, table] : {std::pair{0, "exact_damped"}, {5, "exact_undamped"}}) {
        const auto line = curve(figures().at(figure).picture, palette::sky_blue);
        ASSERT_EQ(line.size(), 3001U);
        for (const char* t : {"1", "2", "5", "10", "20"}) {
            const double x = number(reference("article").at(table).at("table").at(t)[0]);
            EXPECT_NEAR(line[std::stoul(t) * 150].x, x, 0.001) << table << " " << t;
        }
    }
}

TEST(ArticleFigures, DrawWhatTheEngineSteps) {
    for (std::size_t i = 0; i < expected.size(); ++i)
        for (const std::string& method : expected[i].methods) {
            SCOPED_TRACE(figures()[i].name + " " + method);
            const auto line = curve(figures()[i].picture, styles.at(method).colour);
            const auto steps = std::lround((expected[i].to - expected[i].from) * expected[i].rate);
            ASSERT_EQ(line.size(), static_cast<std::size_t>(steps) + 1);
            for (std::size_t k = 0; k < line.size(); k += 1 + line.size() / 20) {
                const double tick = line[k].t * expected[i].rate;
                EXPECT_NEAR(tick, std::round(tick), 1e-3);
                EXPECT_NEAR(line[k].x, stepped_x(expected[i], method, std::lround(tick)), 0.01);
            }
        }
}

TEST(ArticleFigures, MarkStepsWhereThereAreFew) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const double steps = (expected[i].to - expected[i].from) * expected[i].rate;
        const bool few = steps < 50 && !expected[i].methods.empty();
        // One disc per step and legend entry of one method, two of the other.
        const double discs = few ? 3 * (std::round(steps) + 2) : 0;
        EXPECT_EQ(static_cast<double>(figures()[i].picture.discs.size()), discs)
            << figures()[i].name;
    }
}

TEST(ArticleFigures, HaveLabelsThatDoNotOverlapOnTheCanvas) {
    struct Extent {
        double left, right, low, high;
    };
    const auto extent = [](const Label& label) {
        const auto letters =
            std::ranges::count_if(label.text, [](char c) { return (c & 0xC0) != 0x80; });
        const double width = 0.56 * label.size * static_cast<double>(letters);
        const double left = label.at.x - width * static_cast<double>(label.align) / 2;
        return Extent{left, left + width, label.at.y - label.size * 0.2,
                      label.at.y + label.size * 0.75};
    };
    for (const Figure& figure : figures()) {
        const auto& labels = figure.picture.labels;
        for (std::size_t i = 0; i < labels.size(); ++i) {
            const Extent a = extent(labels[i]);
            EXPECT_TRUE(a.left > 8 && a.right < 640 && a.low > 8 && a.high < 352)
                << figure.name << ": " << labels[i].text;
            for (std::size_t j = 0; j < i; ++j) {
                const Extent b = extent(labels[j]);
                const bool apart =
                    a.right <= b.left || b.right <= a.left || a.high <= b.low || b.high <= a.low;
                EXPECT_TRUE(apart) << figure.name << ": " << labels[i].text << labels[j].text;
            }
        }
    }
}

/// Expects all parts in the caption of a figure, counted from 1.
void expect_caption(std::size_t figure, const std::vector<std::string>& parts) {
    const std::string words = caption(figures().at(figure - 1).picture);
    for (const std::string& part : parts)
        EXPECT_TRUE(holds(words, part)) << '"' << part << "\" in: " << words;
}

double degrees(const nlohmann::json& radians) {
    return std::abs(number(radians)) * 180 / std::numbers::pi;
}

TEST(FigureCaptions, OfTheExactMotions) {
    const auto damped = reference("article").at("exact_damped");
    expect_caption(1, {fmt::format("{:.3f} s", number(damped.at("period_d"))),
                       fmt::format("Every {:g} s", number(damped.at("decay_time_2/b"))),
                       fmt::format("{:.1f} %", 100 / std::numbers::e), "at 1000 m", "1 kg"});
    expect_caption(6, {fmt::format("{:.3f} s", 2 * std::numbers::pi / omega), "7.5 MJ", "1000 m"});
}

TEST(FigureCaptions, SayHowExplicitEulerGrows) {
    const auto threshold = reference("article").at("explicit_euler_threshold");
    const double factor = number(threshold.at("amplitude_factor_after_90s"));
    expect_caption(2, {fmt::format("every {:.1f} s", number(threshold.at("doubling_time_s"))),
                       fmt::format("{:.2f} times as large after 90 s", factor),
                       fmt::format("b/k = 1/{:.0f} s", 1 / number(threshold.at("dt_max=b/k")))});
}

TEST(FigureCaptions, SayTheLargestErrors) {
    const auto errors = reference("article").at("damped_dt_0.01_max_abs_x_error");
    const auto semi = errors.at("semi_implicit_euler_kd/E").at("0..10s");
    const std::string off = fmt::format("{:.1f} m", number(semi[0]));
    ASSERT_EQ(semi[1], "at t=3.65");
    const std::string rk4 =
        fmt::format("{:.4f} m", number(errors.at("rk4_classic").at("0..10s")[0]));
    // Where k·dt² + 2·b·dt = 4.
    const double limit = (std::sqrt(damping * damping + 4 * stiffness) - damping) / stiffness;
    expect_caption(
        3, {"largest error is " + off, "at t = 3.65 s", fmt::format("below {:.2f} s", limit)});
    expect_caption(4, {off + " for semi-implicit Euler", rk4 + " for RK4"});
    double largest = 0;
    for (int tick = 0; tick <= 370; ++tick)
        largest = std::max(largest, std::abs(stepped_x(expected[4], "rk4", tick) -
                                             exact_x(damping, Rate{100}.time(tick))));
    expect_caption(5, {off, fmt::format("error of RK4 is {:.4f} m", largest),
                       "4 force evaluations per step instead of 1"});
}

TEST(FigureCaptions, SayHowFarAheadSemiImplicitEulerIs) {
    const Expected& zoom = expected[4];
    const double x = stepped_x(zoom, "semi_implicit_euler", 365);
    // The time at which the exact motion reaches x, by bisection; it falls monotonically here.
    double low = zoom.from;
    double high = zoom.to;
    while (high - low > 1e-12) {
        const double middle = (low + high) / 2;
        (exact_x(damping, middle) > x ? low : high) = middle;
    }
    expect_caption(5, {fmt::format("{:.1f} ms ahead", 1000 * (low - 3.65))});
}

TEST(FigureCaptions, SayPhasesAndEnergiesAfter90Seconds) {
    const auto at_10_hz = reference("article").at("undamped_90s_dt_0.1");
    const double mean = number(at_10_hz.at("sie_energy_mean_over_E0=1/(1-h^2/4)"));
    expect_caption(
        7, {fmt::format("gained {:.0f}°", degrees(at_10_hz.at("sie_phase_error_90s_rad"))),
            fmt::format("{:.1f} % too large", 100 * (mean - 1)),
            fmt::format("lost {:.1f} % of its", number(at_10_hz.at("rk4_energy_lost_percent"))),
            fmt::format("lags by {:.1f}°", degrees(at_10_hz.at("rk4_phase_error_90s_rad")))});
    const auto at_4_hz = reference("article").at("undamped_90s_dt_0.25");
    const std::string lag =
        fmt::format("lags by {:.0f}°", degrees(at_4_hz.at("rk4_phase_error_90s_rad")));
    expect_caption(
        8,
        {fmt::format("lost {:.1f} % of its", number(at_4_hz.at("rk4_energy_lost_percent"))), lag});
    expect_caption(
        10, {fmt::format("gained {:.2f} cycles", number(at_4_hz.at("sie_phase_error_cycles"))), lag,
             fmt::format("{:.0f} % of its amplitude",
                         100 * number(at_4_hz.at("rk4_amplitude_remaining")))});
}

TEST(FigureCaptions, SayBetweenWhichLimitsSemiImplicitEulersEnergyOscillates) {
    const auto at_4_hz = reference("article").at("undamped_90s_dt_0.25");
    const auto percent = [&](const char* key) { return 100 * number(at_4_hz.at(key)); };
    const double mean = percent("sie_energy_mean_over_E0=1/(1-h^2/4)");
    expect_caption(9, {fmt::format("between {:.0f} % and {:.0f} %",
                                   percent("sie_energy_min_over_E0=1/(1+h/2)"),
                                   percent("sie_energy_max_over_E0=1/(1-h/2)")),
                       fmt::format("{:.1f} % too large", mean - 100),
                       fmt::format("= {:.3f}", number(at_4_hz.at("h=omega*dt")))});
    Bodies bodies = article_spring(0);
    const double first = bodies.energy().total();
    double sum = 0;
    for (int tick = 0; tick < 360; ++tick) {
        bodies.step(find_method("semi_implicit_euler"), {{4}, tick, 1});
        sum += bodies.energy().total();
    }
    EXPECT_NEAR(100 * sum / 360 / first, mean, 1);
}

}  // namespace
}  // namespace oiler::test
