// SPDX-License-Identifier: MIT
// Plays the demos cannon and bounce.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/played.hpp"

namespace oiler::test {
namespace {

constexpr double g = 9.81;  // m/s²

struct Aim {
    double x, y;  // m, where the mouse points
};

/// Hits a target at (x, y) with the speed of a number of steps of charging, without air: the
/// smaller solution of tan θ = (v² ± √(v⁴ − g(g·x² + 2·y·v²)))/(g·x), from a muzzle that is 2.2 m
/// from the pivot.
Aim aim_at(double x, double y, int steps) {
    const double v2 = std::pow(6 + 16.0 * steps / 60, 2);
    double angle = 0.5;
    for (int i = 0; i < 100; ++i) {
        const double dx = x - 3 - 2.2 * std::cos(angle);
        const double dy = y - 1.2 - 2.2 * std::sin(angle);
        angle = std::atan((v2 - std::sqrt(v2 * v2 - g * (g * dx * dx + 2 * dy * v2))) / (g * dx));
    }
    return {3 + 12 * std::cos(angle), 1.2 + 12 * std::sin(angle)};
}

std::string shot(int step, const Aim& aim, int charging, const std::string& button) {
    return fmt::format("{} mouse {} {}\n{} hold {}\n{} release {}\n", step, aim.x, aim.y, step,
                       button, step + charging, button);
}

bool has(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

TEST(Cannon, HitsWhereTheFormulaAimsAndReachesTheSecondLevel) {
    const Folder folder;
    const std::string script = shot(0, aim_at(17, 5, 45), 45, "Mouse left") +
                               shot(60, aim_at(25, 9.5, 60), 60, "Space") +
                               shot(130, aim_at(33, 4, 70), 70, "Pad south");
    const auto texts = texts_of("cannon" + with_script(folder, script), 9);
    ASSERT_EQ(texts.size(), 9U);
    EXPECT_TRUE(has(texts[0], "Level 1 of 4\nScore 0   Shots 0\n")) << texts[0];
    EXPECT_TRUE(has(texts[3], "Score 100   Shots 2\n")) << texts[3];
    EXPECT_TRUE(has(texts[5], "Level 1 of 4\nScore 300   Shots 3\n")) << texts[5];
    EXPECT_TRUE(has(texts[8], "Level 2 of 4\nScore 300   Shots 3\n")) << texts[8];
    // The radii of ball and target are 1.1 m together.
    for (const double y : {5 - 1.5, 5 + 1.5}) {
        const std::string beside = shot(0, aim_at(17, y, 45), 45, "Mouse left");
        const std::string text = texts_of("cannon" + with_script(folder, beside), 3)[2];
        EXPECT_TRUE(has(text, "Score 0   Shots 1\n")) << text;
    }
}

TEST(Cannon, ItsScriptHitsRestartsPausesAndReachesTheSecondLevel) {
    const Folder folder;
    const std::string script = text_of(OILER_SOURCE "/demos/scripts/cannon.txt");
    const auto texts = texts_of("cannon" + with_script(folder, script), 12);
    ASSERT_EQ(texts.size(), 12U);
    EXPECT_TRUE(has(texts[2], "Score 100   Shots 1\n")) << texts[2];
    EXPECT_TRUE(has(texts[3], "Level 1 of 4\nScore 0   Shots 0\n")) << texts[3];
    EXPECT_TRUE(has(texts[10], "Pause\nEscape: resume   R: restart   Q: quit\n")) << texts[10];
    EXPECT_TRUE(has(texts[11], "Level 2 of 4\nScore 300   Shots 3\n")) << texts[11];
    EXPECT_FALSE(has(texts[11], "Pause")) << texts[11];
    const std::string tape = " '" + (folder / "tape").string() + "'";
    EXPECT_EQ(shell("cannon --steps 660 --record" + tape + with_script(folder, script)).exit, 0);
    const Outcome replay = shell("cannon --quiet --threads 2 --steps 660 --replay" + tape);
    EXPECT_EQ(replay.exit, 0) << replay.err;
}

// No step is taken in the menu, and Q ends the program there.
TEST(Cannon, TheMenuHoldsTheWorldAndQuits) {
    const Folder folder;
    const auto report =
        report_of("cannon --steps 100" + with_script(folder, "10 press Escape\n60 press Q\n"));
    EXPECT_EQ(report.at("steps"), 60);
    const auto held =
        report_of("cannon --steps 60" + with_script(folder, "10 press Escape\n50 press Escape\n"));
    EXPECT_EQ(held.at("state_hash"), report_of("cannon --quiet --steps 20").at("state_hash"));
    const auto paused = report_of("cannon --steps 60" + with_script(folder, "20 press Escape\n"));
    EXPECT_EQ(paused.at("energy"), held.at("energy"));
    EXPECT_NE(paused.at("state_hash"), held.at("state_hash")) << "the hash covers the menu";
    EXPECT_EQ(report_of("cannon --steps 100" + with_script(folder, "60 press Q\n")).at("steps"),
              100);
}

// A ball comes every 0.08 s, rounded up to 5 steps of 1/60 s, and leaves after 7 s.
TEST(Bounce, BallsComeAndLeave) {
    const Folder folder;
    EXPECT_EQ(report_of("bounce --quiet --steps 60").at("bodies"), 60 / 5);
    EXPECT_EQ(report_of("bounce --steps 60" + with_script(folder, "30 press Space\n")).at("bodies"),
              60 / 5 + 40);
    EXPECT_EQ(report_of("bounce --quiet --steps 900").at("bodies"), 7 * 60 / 5);
}

}  // namespace
}  // namespace oiler::test
