// SPDX-License-Identifier: MIT
// Plays the demos jump, integrator_race and jump_rates, whose lanes have settings of their own.
#include <fmt/format.h>

#include "app/played.hpp"
#include "oiler/overlay/legible.hpp"
#include "oiler/picture/text.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double half = 1e-9;  // m; a half of a printed digit is rounded up
constexpr std::array lane_rates{20, 30, 60, 120, 240};  // Hz

/// The apex of a jump at 9 m/s under 20 m/s², at the steps: the highest of v·n·dt − g·dt²·n(n ±
/// 1)/2, with plus for semi-implicit Euler, with minus for explicit Euler, with neither for Verlet.
double apex(int rate, int sign) {
    double highest = 0;
    for (int n = 0; n < rate; ++n) {
        const double dt = 1.0 / rate;
        highest = std::max(highest, 9 * n * dt - 10 * dt * dt * n * (n + sign));
    }
    return highest;
}

/// The labels on the canvas of a picture as a window of 400 by 300 pixels shows them.
std::vector<Label> small_labels(const nlohmann::json& picture) {
    Picture small;
    for (const auto& label : picture.at("labels"))
        if (label.at("space") == "canvas")
            small.labels.push_back({.at = {label.at("at")[0], label.at("at")[1]},
                                    .text = label.at("text"),
                                    .size = label.at("size"),
                                    .align = static_cast<Align>(label.at("align").get<int>())});
    keep_legible(small, OverlayArea({400, 300}));
    return small.labels;
}

// 9 pixels are 14.4 units.
TEST(JumpDemo, TheRatesOfItsSliderAreLegibleInASmallWindow) {
    int rates = 0;
    for (const Label& label : small_labels(pictures_of("jump --quiet", 1).at(0))) {
        if (label.at.y != 20) continue;
        EXPECT_GT(label.size, 14) << label.text;
        ++rates;
    }
    EXPECT_EQ(rates, 12);
}

// The left ball has 60 Hz, the right one the rate of the run, whose result is there at once. The
// slider has 10 to 240 Hz in twelve places; 150 Hz is none of them.
TEST(JumpDemo, ShowsTheRunBesideSixtyHertz) {
    for (const int rate : {10, 60, 120, 144, 150, 240}) {
        const std::string text = texts_of(fmt::format("jump --quiet --rate {}", rate), 1).at(0);
        for (const int shown : {60, rate}) {
            EXPECT_TRUE(holds(text, fmt::format("\n{} Hz\n", shown))) << text;
            EXPECT_TRUE(holds(text, fmt::format("\napex {:.3f} m\n", apex(shown, 1) + half)))
                << text;
        }
        EXPECT_TRUE(holds(text, "\nmisses\n"));
        EXPECT_EQ(holds(text, "\nlands\n"), apex(rate, 1) >= 2);
    }
}

// Somebody plays at once: they jump at 0.75 s and rise for 0.45 s.
TEST(JumpRatesDemo, JudgesNoJumpBeforeItsApex) {
    const Folder folder;
    const auto texts =
        texts_of("jump_rates" + with_script(folder, "1 press Left\n180 press Space\n"), 3);
    EXPECT_FALSE(holds(texts[1], "cm too")) << texts[1];
    EXPECT_TRUE(holds(texts[2], "cm too")) << texts[2];
}

struct LaneCase {
    const char* method;
    int sign;
};

class JumpRates : public testing::TestWithParam<LaneCase> {};

TEST_P(JumpRates, EachLaneShowsTheApexOfItsRate) {
    const auto [method, sign] = GetParam();
    const auto texts = texts_of(fmt::format("jump_rates --quiet --method {}", method), 4);
    ASSERT_EQ(texts.size(), 4U);
    for (const int rate : lane_rates) {
        EXPECT_TRUE(holds(texts[3], fmt::format("\n{:.3f} m\n", apex(rate, sign) + half)));
        const double off = 100 * (apex(rate, sign) - 2.025);
        if (std::abs(off) >= 0.05) {
            const std::string words = fmt::format(
                "\n{:.1f} cm too {}\n", std::abs(off) + 100 * half, off < 0 ? "low" : "high");
            EXPECT_TRUE(holds(texts[3], words)) << words << texts[3];
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, JumpRates,
                         testing::Values(LaneCase{"semi_implicit_euler", 1},
                                         LaneCase{"explicit_euler", -1},
                                         LaneCase{"velocity_verlet", 0}));

// The body's centre is 0.3 m above its sole. The lane of the loop has its body in the trace.
TEST(JumpRatesDemo, LandsOnTheLedgeIfItsApexReachesIt) {
    const auto height = [](const std::string& options) {
        return trace_of("jump_rates --quiet " + options).back().y;
    };
    EXPECT_NEAR(height("--steps 720"), 2.3, 1e-9);
    EXPECT_NEAR(height("--steps 360 --rate 120"), 0.3, 1e-9);
    EXPECT_NEAR(height("--steps 180 --rate 60"), 0.3, 1e-9);
    EXPECT_NEAR(height("--steps 180 --rate 60 --method velocity_verlet"), 2.3, 1e-9);
}

// It walks at 3 m/s from 7 m, and stops its own example with the first key.
TEST(JumpRatesDemo, ThePlayerWalksAndJumps) {
    const Folder folder;
    const std::string script = "0 hold Left\n240 release Left\n300 press Space\n";
    const auto rows = trace_of("jump_rates --steps 700" + with_script(folder, script));
    EXPECT_NEAR(rows.at(240).x, 4, 1e-9);
    EXPECT_NEAR(rows.back().x, 4, 1e-9);
    const auto highest = std::ranges::max_element(rows, {}, &TraceRow::y);
    EXPECT_NEAR(highest->y, 0.3 + apex(240, 1), 1e-9);
    EXPECT_NEAR(rows.back().y, 0.3, 1e-9);
    const auto texts = texts_of("jump_rates" + with_script(folder, script), 3);
    for (const int rate : lane_rates)
        EXPECT_TRUE(holds(texts[2], fmt::format("\n{:.3f} m\n", apex(rate, 1) + half)));
}

// The reference of --what-if plays the lane of the loop, too.
TEST(JumpRatesDemo, WhatIfComparesTheLaneOfTheLoop) {
    const Folder folder;
    const std::string tape = "'" + (folder / "tape").string() + "'";
    ASSERT_EQ(shell("jump_rates --quiet --steps 720 --record " + tape).exit, 0);
    shell("jump_rates --quiet --steps 720 --replay " + tape, 0);
    const Outcome run =
        shell("jump_rates --replay " + tape + " --what-if velocity_verlet --json -", 0);
    const auto json = nlohmann::json::parse(run.out);
    const auto off = [&](int setting) {
        return json.at("settings").at(setting).at("readings").at(0).at("difference").get<double>();
    };
    EXPECT_NEAR(off(0), -9.0 / 240 / 2, 1e-6);
    EXPECT_NEAR(off(1), 0, 1e-6);
}

/// The result of each lane of the race at q = ω·dt, from |R(iq)|² of each method's stability
/// function R, per oscillation. The two symplectic methods have 1.
std::vector<std::string> results(int rate) {
    const double q = 2 * std::numbers::pi / rate;
    const auto words = [&](const char* verb, double factor) {
        const double percent = 100 * std::abs(std::pow(factor, rate) - 1);
        return fmt::format(
            "\n{} {} % per oscillation\n", verb,
            percent < 100 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent));
    };
    return {words("▲ gains", 1 + q * q), words("▲ gains", 1 + std::pow(q, 4) / 4),
            words("▼ loses", 1 / (1 + q * q)),
            words("▼ loses", 1 - std::pow(q, 6) / 72 + std::pow(q, 8) / 576)};
}

std::string race(const Folder& folder, const std::string& script) {
    return texts_of("integrator_race" + with_script(folder, script), 2).at(1);
}

TEST(IntegratorRace, NamesWhatTheTheoryOfEachMethodSays) {
    const Folder folder;
    const std::string text = race(folder,
                                  "0 press Left\n1 press Left\n2 press Left\n"
                                  "3 press Left\n4 press Left\n");
    ASSERT_TRUE(holds(text, "\n20 Hz\n"));
    for (const std::string& result : results(20))
        EXPECT_TRUE(holds(text, result)) << result << text;
    // Semi-implicit Euler keeps x² + v² − q·x·v, in units where ω is 1: the energy is between
    // 1/(1 + q/2) and 1/(1 − q/2) of the start.
    const double q = 2 * std::numbers::pi / 20;
    EXPECT_TRUE(holds(
        text, fmt::format("\n= keeps its energy within {:.2g} %\n", 100 * (1 / (1 - q / 2) - 1))));
}

// The rings of radius 9 are at most 60 units from the middle, 190.
TEST(IntegratorRace, DistancesKeepFromTheRings) {
    const Folder folder;
    std::string script;
    for (int i = 0; i < 4; ++i) script += fmt::format("{} press Left\n", i);
    int left = 0, right = 0;
    for (const auto& picture : pictures_of("integrator_race" + with_script(folder, script), 10))
        for (const Label& label : small_labels(picture)) {
            const float width = wider_letters * text_width(label.text, label.size);
            if (label.text.starts_with("◀ ")) {
                EXPECT_LT(label.at.x + width, 190 - 69) << label.text;
                ++left;
            } else if (label.text.ends_with(" ▶")) {
                EXPECT_EQ(label.align, Align::right);
                EXPECT_GT(label.at.x - width, 190 + 69) << label.text;
                EXPECT_LT(label.at.x, 366);
                ++right;
            }
        }
    EXPECT_GT(left + right, 4);
}

// The slider goes from 196 to 612 units of a canvas of 640 × 360; without a picture of its own, the
// camera of the game is 10 m high around the origin, so that 36 units are 1 m.
TEST(IntegratorRace, KeysAndMouseSetTheRate) {
    const Folder folder;
    const auto mouse = [](int step, double x, double y) {
        return fmt::format("{} mouse {} {}\n", step, (x - 320) / 36, (y - 180) / 36);
    };
    EXPECT_TRUE(holds(race(folder, "0 press Right\n"), "\n80 Hz\n"));
    EXPECT_TRUE(holds(race(folder, mouse(0, 612, 28) + "1 click left\n"), "\n240 Hz\n"));
    EXPECT_TRUE(holds(race(folder, mouse(0, 400, 28) + "1 hold Mouse left\n" + mouse(2, 0, 200)),
                      "\n10 Hz\n"));
    EXPECT_TRUE(holds(race(folder, mouse(0, 196, 200) + "1 click left\n"), "\n60 Hz\n"));
    EXPECT_TRUE(holds(race(folder, mouse(0, 196, 28) + "1 press Space\n"), "\n60 Hz\n"));
}

TEST(IntegratorRace, RefusesSettingsThatItsLanesWouldNotFollow) {
    const Folder folder;
    for (const char* const words : {"--method rk4", "--rate 60", "--precision float"}) {
        const Outcome run = shell(std::string("integrator_race --steps 3 ") + words, 2);
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_TRUE(holds(run.err, "the slider sets the rate of all"));
    }
    const std::string tape = "'" + (folder / "tape").string() + "'";
    ASSERT_EQ(shell("integrator_race --quiet --steps 480 --record " + tape).exit, 0);
    shell("integrator_race --quiet --steps 480 --replay " + tape, 0);
    const Outcome run = shell("integrator_race --replay " + tape + " --what-if", 2);
    EXPECT_TRUE(holds(run.err, "each lane has its own method"));
}

}  // namespace
}  // namespace oiler::test
