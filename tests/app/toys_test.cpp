// SPDX-License-Identifier: MIT
// Plays the demos stability_map and cloth.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/played.hpp"
#include "support/text.hpp"

namespace oiler::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double z = 1.7, zeta = 0.1;  // where the crosshair starts, of ω·dt and of damping
constexpr double rate = 60;

std::string first_text(const std::string& command) { return texts_of(command, 1).at(0); }

// The step matrix of semi-implicit Euler has the determinant 1 − c with c = 2ζz and complex
// eigenvalues here. It is stable while z² + 2c < 4.
TEST(StabilityMapDemo, SaysWhatTheSpringAtTheCrosshairDoes) {
    const double c = 2 * zeta * z;
    const double limit = 2 * (std::sqrt(zeta * zeta + 1) - zeta);
    const std::string text = first_text("stability_map --quiet");
    EXPECT_TRUE(holds(
        text, fmt::format("rings: {:.0f} % left after a period", 100 * std::pow(1 - c, pi / z))))
        << text;
    EXPECT_TRUE(holds(text, fmt::format("truly, {:.0f} % is left", 100 * std::exp(-2 * pi * zeta))))
        << text;
    EXPECT_TRUE(holds(text, fmt::format("1 kg on {:.0f} N/m needs ω·dt ≤ {:.2f}, so {:.0f} Hz.",
                                        z * z * rate * rate, limit, std::ceil(rate * z / limit))))
        << text;
}

// Explicit Euler: the determinant is 1 − c + z², and the limit 2ζ. A limit that is rounded down
// may need one hertz more.
TEST(StabilityMapDemo, SaysHowFastTheSpringExplodes) {
    const std::string text = first_text("stability_map --quiet --method explicit_euler");
    EXPECT_TRUE(holds(
        text, fmt::format("explodes: × {:.3g} per step", std::sqrt(1 - 2 * zeta * z + z * z))))
        << text;
    EXPECT_TRUE(holds(text, "needs ω·dt ≤ 0.20, so 510 Hz.") ||
                holds(text, "needs ω·dt ≤ 0.20, so 511 Hz."))
        << text;
    EXPECT_TRUE(holds(first_text("stability_map --quiet --method implicit_euler"), "off the map"));
}

// The map is 272 wide for ω·dt up to 3.2 and 252 high for damping ratios up to 1.4, from (44, 60)
// on; the camera shows 10 m on 360.
TEST(StabilityMapDemo, TheMouseDragsTheCrosshairAndChoosesAMethod) {
    const auto at = [](double x, double y) {
        return fmt::format("{:.4f} {:.4f}", (x - 320) / 36, (y - 180) / 36);
    };
    const Folder folder;
    const std::string drag = fmt::format(
        "5 mouse {}\n5 hold Mouse left\n20 mouse {}\n25 release Mouse left\n30 mouse {}\n",
        at(60, 80), at(44 + 85, 60 + 90), at(200, 200));
    const auto texts = texts_of("stability_map" + with_script(folder, drag), 2);
    EXPECT_TRUE(holds(texts.at(1), "ω·dt = 1.00 at 60 Hz, ζ = 0.50")) << texts.at(1);

    // The third, and later the last of the methods. Velocity Verlet with damping in the drift is
    // stable while z·tanh(ζz) < 4ζ: its trace is 1 + d − z²·(1 − d)/c, with d = exp(−c).
    const std::string click = "5 press Space\n6 press Space\n70 press Space\n71 press Space\n";
    const auto chosen = texts_of("stability_map" + with_script(folder, click), 3);
    double limit = 2;
    for (int i = 0; i < 50; ++i) limit = 4 * zeta / std::tanh(zeta * limit);
    EXPECT_TRUE(holds(chosen.at(1), fmt::format("needs ω·dt ≤ {:.2f}", limit))) << chosen.at(1);
    EXPECT_TRUE(holds(chosen.at(2), "off the map")) << chosen.at(2);
}

// A wave in which all neighbours along one direction move against each other has ω² = 8·k/m, and
// 12·k/m if all threads point the same way. Without damping velocity_verlet holds to ω·dt = 2.
TEST(ClothDemo, NamesTheRatesAndTearsBelow) {
    const auto hertz = [](double n) { return std::ceil(std::sqrt(n * 80 / 0.02) / 2); };
    const auto texts = texts_of("cloth --quiet", 4);
    EXPECT_TRUE(holds(
        texts[0], fmt::format("Flat it needs {:.0f} Hz, crumpled {:.0f} Hz", hertz(8), hertz(12))))
        << texts[0];
    const int threads = 18 * 12 + 19 * 11 + 2 * 18 * 11;
    EXPECT_TRUE(holds(texts[3], fmt::format("\n{} threads\n", threads))) << texts[3];
    const auto torn = texts_of("cloth --quiet --rate 80", 4);
    EXPECT_TRUE(holds(torn[0], "it tears itself to pieces")) << torn[0];
    EXPECT_FALSE(holds(torn[3], fmt::format("\n{} threads\n", threads))) << torn[3];
}

// A cut from the left to the right below the first row of threads leaves what hangs on nails.
TEST(ClothDemo, ACutFallsAndAReplayIsEqual) {
    const Folder folder;
    const std::string script =
        "5 mouse -2 0.2\n6 hold X\n10 mouse 2 0.2\n12 release X\n100 mouse 0 0\n";
    const auto rows = trace_of("cloth --steps 240" + with_script(folder, script));
    const auto lowest = [&](int tick) {
        double y = 9;
        for (const TraceRow& row : rows)
            if (row.tick == tick) y = std::min(y, row.y);
        return y;
    };
    EXPECT_GT(lowest(5), -0.9);
    EXPECT_LT(lowest(240), -1.6);  // on the ground, at -1.7 m, with a radius of 2 cm
    const std::string tape = "'" + (folder / "tape").string() + "'";
    for (const char* const game : {"cloth", "stability_map"}) {
        ASSERT_EQ(shell(fmt::format("{} --steps 240 --record {}", game, tape) +
                        with_script(folder, script))
                      .exit,
                  0);
        EXPECT_EQ(shell(fmt::format("{} --quiet --steps 240 --replay {}", game, tape)).exit, 0);
    }
}

}  // namespace
}  // namespace oiler::test
