// SPDX-License-Identifier: MIT
// Plays the demos cannon, bounce, projectile, stability_map, cloth, platformer and galton, and
// films spring_damper.
#include <fmt/format.h>

#include "app/played.hpp"
#include "oiler/picture/theme.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using nlohmann::json;

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
    shell("cannon --steps 660 --record" + tape + with_script(folder, script), 0);
    shell("cannon --quiet --threads 2 --steps 660 --replay" + tape, 0);
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

// A ball comes every 0.08 s from 0 s on, and leaves after 7 s: by the step that begins at 59/60 s,
// 1 + ⌊0.983/0.08⌋ have come, and at 14.983 s those of 8 s to 14.96 s are there.
TEST(Bounce, BallsComeAndLeave) {
    const Folder folder;
    EXPECT_EQ(report_of("bounce --quiet --steps 60").at("bodies"), 13);
    EXPECT_EQ(report_of("bounce --steps 60" + with_script(folder, "30 press Space\n")).at("bodies"),
              13 + 40);
    EXPECT_EQ(report_of("bounce --quiet --steps 900").at("bodies"), 88);
}

// Plays the demos stability_map and cloth.

/// Moves the mouse to a place on the canvas of 640 × 360 units. Without a camera of its own, the
/// picture of a game is 10 m high around the origin, so that 36 units are 1 m.
std::string mouse(int step, double x, double y) {
    return fmt::format("{} mouse {} {}\n", step, (x - 320) / 36, (y - 180) / 36);
}
/// Drags the crosshair to a point of the map, which is 272 units wide and 252 high.
std::string drag_to(double omega_dt, double zeta) {
    return mouse(0, 44 + 272 * omega_dt / 3.2, 60 + 252 * zeta / 1.4) + "1 click left\n";
}
/// The texts of the map after 1 s.
std::string map_after(const std::string& script, const std::string& options = "") {
    const Folder folder;
    return texts_of("stability_map " + options + with_script(folder, script), 2).at(1);
}

struct Spring {
    double omega_dt, zeta;
};

// In units of dt a step of semi-implicit Euler has the determinant 1 − c and the trace 2 − c − q²,
// with q = ω·dt and c = 2ζq. Where its eigenvalues are complex, their modulus is the root of the
// determinant. It is stable up to 1 + trace + determinant = 0, q = 2(√(1 + ζ²) − ζ).
TEST(StabilityMap, SaysWhatTheTheoryOfSemiImplicitEulerSays) {
    for (const auto& [q, zeta] : {Spring{1.7, 0.1}, {0.5, 0.02}, {1, 0.04}, {1.2, 0.2}}) {
        const std::string text = map_after(drag_to(q, zeta));
        const double left = std::pow(1 - 2 * zeta * q, std::numbers::pi / q);
        EXPECT_TRUE(holds(text, fmt::format("{}: {:.0f} % left after a period\n",
                                            left < 0.1 ? "rests" : "rings", 100 * left)))
            << q << text;
        const double limit = 2 * (std::sqrt(1 + zeta * zeta) - zeta);
        EXPECT_TRUE(holds(text, fmt::format("1 kg on {:.0f} N/m needs ω·dt ≤ {:.2f}, so {:.0f} Hz.",
                                            std::pow(60 * q, 2), limit, std::ceil(60 * q / limit))))
            << q << text;
    }
}

// Its determinant is 1 − c + q²: it explodes beyond q = 2ζ.
TEST(StabilityMap, ExplicitEulerExplodesUnlessItIsDamped) {
    const std::string undamped = map_after(drag_to(1, 0), "--method explicit_euler");
    EXPECT_TRUE(holds(undamped, "explodes: × 1.41 per step\n"));
    EXPECT_TRUE(holds(undamped, "1 kg on 3600 N/m explodes at any rate.\n"));
    const std::string damped = map_after(drag_to(1, 0.3), "--method explicit_euler --rate 100");
    EXPECT_TRUE(holds(damped, "explodes: × 1.18 per step\n"));
    EXPECT_TRUE(holds(damped, "1 kg on 10000 N/m needs ω·dt ≤ 0.60, so 167 Hz.\n"));
}

// Implicit Euler multiplies the amplitude by 1/√(1 + c + q²).
TEST(StabilityMap, ImplicitEulerNeverExplodes) {
    const std::string text = map_after(drag_to(3, 0), "--method implicit_euler");
    const double left = 100 * std::pow(1 + 9, -std::numbers::pi / 3);
    EXPECT_TRUE(holds(text, fmt::format("rests: {:.0f} % left", left)));
    EXPECT_TRUE(holds(text, "the limit is off the map."));
}

// Undamped, velocity Verlet keeps the amplitude up to ω·dt = 2.
TEST(StabilityMap, TheMethodIsChosenByClickSpaceAndOption) {
    const std::string kept = "rings: 100 % left after a period\n";
    const std::string script = drag_to(1.5, 0);
    EXPECT_TRUE(holds(map_after(script, "--method velocity_verlet"), kept));
    EXPECT_TRUE(holds(map_after(script + mouse(5, 400, 72) + "6 click left\n"), kept))
        << "the fourth line from 117 down, 13 units each";
    EXPECT_FALSE(holds(map_after(script + mouse(5, 400, 46) + "6 click left\n"), kept));
    const std::string twice = "5 press Space\n6 press Space\n";
    EXPECT_TRUE(holds(map_after(script + twice), kept));
    EXPECT_TRUE(holds(map_after(script + "5 press Space\n", "--method implicit_euler"),
                      "explodes: × 1.8 per step\n"))
        << "explicit Euler, the first";
    EXPECT_TRUE(holds(map_after(script, "--method rk3_kutta"), "\nrk3_kutta\n"));
}

TEST(StabilityMap, KeysMoveTheCrosshairAndAReplayIsEqual) {
    const Folder folder;
    const std::string script = "0 hold Right\n30 release Right\n30 hold Up\n60 press Space\n";
    const std::string text = texts_of("stability_map" + with_script(folder, script), 3).at(2);
    EXPECT_TRUE(holds(text, "ω·dt = 1.90 at 60 Hz, ζ = 0.70"));
    const std::string tape = " '" + (folder / "tape").string() + "'";
    const std::string record = "stability_map --steps 120 --record" + tape;
    ASSERT_EQ(shell(record + with_script(folder, script)).exit, 0);
    shell("stability_map --quiet --steps 120 --replay" + tape, 0);
}

double threads_of(const std::string& command) {
    return report_of(command).at("readings").at("threads").get<double>();
}

// 19 × 12 bodies: 18·12 + 19·11 threads across and down, 2·18·11 diagonals.
constexpr int all_threads = 18 * 12 + 19 * 11 + 2 * 18 * 11;

// The fastest wave of the flat net has ω² = 8·k/m, k = 70 N/m, m = 0.02 kg, and velocity Verlet
// follows it from ω/2 on, 83.7 Hz. A net that hangs has up to 8.57·k/m in its first swing, for some
// tenths of a second, by the largest eigenvalue of its stiffness.
TEST(Cloth, TearsItselfToPiecesBelowTheRateOfItsFastestWave) {
    EXPECT_EQ(threads_of("cloth --quiet --steps 1000 --rate 100"), all_threads);
    EXPECT_LT(threads_of("cloth --quiet --steps 800 --rate 80"), all_threads / 2);
    EXPECT_EQ(threads_of("cloth --quiet --steps 160 --rate 40 --method implicit_midpoint"),
              all_threads);
}

// The rates of the line are those that were measured: a Hz less tears the hanging net.
TEST(Cloth, HangsFromTheNamedRateOn) {
    for (const auto& [method, rate] :
         {std::pair("velocity_verlet", 86), std::pair("semi_implicit_euler", 87)}) {
        const auto threads =
            [command = fmt::format("cloth --quiet --steps 1000 --method {}", method)](int at) {
                return threads_of(fmt::format("{} --rate {}", command, at));
            };
        EXPECT_EQ(threads(rate), all_threads) << method;
        EXPECT_LT(threads(rate - 1), all_threads) << method;
        const std::string text = texts_of(fmt::format("cloth --quiet --method {}", method), 1)[0];
        EXPECT_TRUE(holds(text, fmt::format("\nIt needs about {} Hz while it hangs, ", rate)))
            << text;
    }
}

constexpr double n_hanging = 8.4;  // between the n of 85 and of 86 Hz, 8.26 and 8.45

// Crumpled, ω² is at most 16·k/m. The limit of ω·dt is 2, and 2(√(1 + ζ²) − ζ) for semi-implicit
// Euler with damping in the kick, of 0.01 N·s/m in each thread and of as much drag.
TEST(Cloth, NamesTheRatesThatTheMethodNeeds) {
    const auto says = [](const std::string& options, const std::string& words) {
        const std::string text = texts_of("cloth --quiet " + options, 1).at(0);
        EXPECT_TRUE(holds(text, words));
    };
    const auto needs = [&](double limit, const char* verdict) {
        const auto rate = [&](double n) { return std::ceil(std::sqrt(n * 70 / 0.02) / limit); };
        return fmt::format(
            "\nIt needs about {:.0f} Hz while it hangs, up to {:.0f} Hz crumpled: {}.\n",
            rate(n_hanging), rate(16), verdict);
    };
    says("", "velocity_verlet at 120 Hz" + needs(2, "it holds"));
    says("--rate 100", needs(2, "do not crumple it"));
    says("--rate 80", needs(2, "it tears itself to pieces"));
    says("--rate 85", needs(2, "it may tear as it swings"));
    says("--rate 86", needs(2, "do not crumple it"));
    const auto in_kick = [](double n) {
        const double omega = std::sqrt(n * 70 / 0.02);
        const double zeta = (n * 0.01 + 0.01) / 0.02 / (2 * omega);
        return std::ceil(omega / (2 * (std::sqrt(1 + zeta * zeta) - zeta)));
    };
    says("--method semi_implicit_euler",
         fmt::format("\nIt needs about {:.0f} Hz while it hangs, up to {:.0f} Hz crumpled: do not "
                     "crumple it.\n",
                     in_kick(n_hanging), in_kick(16)));
    says("--method implicit_midpoint", "\nIt holds at any rate.\n");
}

// rk4 is stable up to ω·dt = 2√2, for √(8.4·k/m) from 60.6 Hz on, for √(7.5·k/m) from 57.3 Hz on
// and with the damping of the threads from 57 Hz on. It damps: the net that swings holds at 60 Hz.
TEST(Cloth, MayHoldBelowTheRateAtWhichItHangs) {
    const auto threads = [](int rate) {
        return threads_of(
            fmt::format("cloth --quiet --steps {} --method rk4 --rate {}", 60 * rate, rate));
    };
    const auto says = [](int rate, const char* words) {
        const std::string command = fmt::format("cloth --quiet --method rk4 --rate {}", rate);
        EXPECT_TRUE(holds(texts_of(command, 1).at(0), words)) << rate;
    };
    EXPECT_LT(threads(56), all_threads);
    says(56, "it tears itself to pieces");
    EXPECT_EQ(threads(60), all_threads);
    says(60, "it may tear as it swings");
}

TEST(Cloth, IsPulledCutPinnedAndHungAnew) {
    const Folder folder;
    const auto threads = [&](int steps, const std::string& script) {
        return threads_of(fmt::format("cloth --steps {}", steps) + with_script(folder, script));
    };
    const std::string knife =
        "0 mouse -3 0\n0 hold Mouse right\n1 mouse 3 0\n2 release Mouse right\n";
    // Between two rows: 19 threads down and 36 diagonals.
    EXPECT_EQ(threads(10, knife), all_threads - 19 - 36);
    EXPECT_EQ(threads(10, "0 mouse -3 0\n1 mouse 3 0\n"), all_threads);
    EXPECT_EQ(threads(30, knife + "20 press R\n"), all_threads);
    const auto lowest = [&](const std::string& script) {
        double low = 0;
        for (const TraceRow& row : trace_of("cloth --steps 120" + with_script(folder, script)))
            if (row.tick == 120) low = std::min(low, row.y);
        return low;
    };
    const double hanging = lowest("");
    EXPECT_LT(lowest("10 mouse 0 -0.3\n10 hold Mouse left\n20 mouse 0 -1\n"), hanging - 0.1);
    // Without its left nail, the corner falls.
    EXPECT_LT(lowest("10 mouse -1.53 1.25\n10 press Space\n"), hanging);
    const std::string unpinned = "10 mouse -1.53 1.25\n10 press Space\n11 mouse -3 0\n";
    EXPECT_EQ(lowest(unpinned + "12 press Space\n"), lowest(unpinned))
        << "Space is nothing where no cloth is";
}

TEST(Cloth, AReplayOfItsScriptIsEqual) {
    const Folder folder;
    const std::string script = text_of(OILER_SOURCE "/demos/scripts/cloth.txt");
    const std::string tape = " '" + (folder / "tape").string() + "'";
    ASSERT_EQ(shell("cloth --steps 340 --record" + tape + with_script(folder, script)).exit, 0);
    shell("cloth --quiet --threads 2 --steps 340 --replay" + tape, 0);
}

// Plays the demos platformer and galton.

/// The trace of the hero, who starts at (-12.5, 0.4) m.
std::vector<TraceRow> hero_of(int steps, const std::string& script) {
    const Folder folder;
    return trace_of(fmt::format("platformer --steps {}", steps) + with_script(folder, script));
}

TEST(Platformer, ItsScriptFindsAllCoins) {
    const Folder folder;
    const std::string script =
        with_script(folder, text_of(OILER_SOURCE "/demos/scripts/platformer.txt"));
    const std::string tape = " '" + (folder / "tape").string() + "'";
    EXPECT_EQ(report_of("platformer --steps 1800" + script).at("readings").at("coins"), 7);
    shell("platformer --steps 1800 --record" + tape + script, 0);
    shell("platformer --quiet --threads 2 --steps 1800 --replay" + tape, 0);
}

// A jump rises by 12.6²/(2·30) m; a step of the input's release keeps half of the speed. A trace
// has rows at the steps, at most half a step from the apex: 30/2·(1/240)² = 0.3 mm.
TEST(Platformer, JumpsAsHighAsTheButtonIsHeld) {
    const auto apex = [](const std::vector<TraceRow>& rows) {
        double top = 0;
        for (const TraceRow& row : rows) top = std::max(top, row.y - 0.4);
        return top;
    };
    const std::string to_open_ground = "0 hold Right\n50 release Right\n";
    EXPECT_NEAR(apex(hero_of(160, to_open_ground + "70 hold Space\n150 release Space\n")),
                12.6 * 12.6 / 60, 3e-4);
    // The first step rises 12.6/120 − 15/120² m, then half the speed is left.
    EXPECT_NEAR(apex(hero_of(160, to_open_ground + "70 press Space\n")),
                12.6 / 120 - 15.0 / 14400 + 6.3 * 6.3 / 60, 3e-4);
}

// He falls from the end of the ground at x = -1.5 m in a run. The press 0.05 s after that jumps,
// the one after 0.15 s does not.
TEST(Platformer, JumpsUpToATenthOfASecondAfterTheLedge) {
    const auto off_at = [] {
        for (const TraceRow& row : hero_of(240, "0 hold Right\n"))
            if (row.x > -1.6 && row.vy < 0) return row.tick;
        return 0;
    }();
    ASSERT_GT(off_at, 0);
    const auto speed_after = [&](int late) {
        return hero_of(off_at + late + 2,
                       fmt::format("0 hold Right\n{} hold Space\n", off_at + late))
            .back()
            .vy;
    };
    EXPECT_GT(speed_after(6), 12);
    EXPECT_LT(speed_after(18), 0);
}

// A jump whose button is pressed and released in the air, up to a tenth of a second before he
// lands, begins with half the speed. He jumps at step 10 and lands 2·12.6/30 s, 100.8 steps, later.
TEST(Platformer, ATapBeforeHeLandsIsASmallJump) {
    const auto apex_after = [](const std::string& tap) {
        double top = 0;
        for (const TraceRow& row : hero_of(240, "10 hold Space\n100 release Space\n" + tap))
            if (row.tick > 120) top = std::max(top, row.y - 0.4);
        return top;
    };
    EXPECT_NEAR(apex_after("104 press Space\n"), 6.3 * 6.3 / 60, 3e-4);
    EXPECT_LT(apex_after("97 press Space\n"), 1e-9);
}

// The rope is as long as the hero is away from the hook at (-5, 11) m. It holds: it is stretched by
// at most m·(g + v²/L)/k, and by v·√(m/k) as it becomes taut, with k = 1000 N/m. When he lets go he
// keeps his speed and flies a parabola, although no button of a jump is held.
TEST(Platformer, SwingsOnTheRopeAndFliesOffIt) {
    const auto rows = hero_of(1720, text_of(OILER_SOURCE "/demos/scripts/platformer.txt"));
    const auto away = [&](std::size_t tick) {
        return std::hypot(rows[tick].x + 5, rows[tick].y - 11);
    };
    double furthest = 0, fastest = 0;
    for (std::size_t i = 1576; i < 1672; ++i) {
        furthest = std::max(furthest, away(i));
        fastest = std::max(fastest, std::hypot(rows[i].vx, rows[i].vy));
    }
    const double length = away(1576);
    EXPECT_GT(furthest, length);
    EXPECT_LT(furthest,
              length + (30 + fastest * fastest / length) / 1000 + fastest * std::sqrt(1e-3));
    EXPECT_GT(rows[1672].vy, 6.3);
    for (std::size_t i = 1673; i < rows.size(); ++i)
        EXPECT_NEAR(rows[i].vy, rows[1672].vy - 30.0 * double(i - 1672) / 120, 1e-9);
}

// The platform swings by 2.6 m in 5 s: its friction holds him, so that both move alike.
TEST(Platformer, IsCarriedByThePlatform) {
    std::string script = text_of(OILER_SOURCE "/demos/scripts/platformer.txt");
    script = script.substr(0, script.find("720 hold Right"));
    const auto rows = hero_of(760, script);
    const auto place = [](double tick) {
        return 2.6 * std::sin(2 * std::numbers::pi * tick / 120 / 5);
    };
    for (std::size_t i = 680; i < rows.size(); ++i)
        EXPECT_NEAR(rows[i].x - rows[680].x, place(rows[i].tick) - place(rows[680].tick), 1e-12);
}

// 200 balls fall 0.1 s, 12 steps, apart. The law's deviation is 0.79 m; of 200 balls, the
// deviation is uncertain by 5 %, and bounces make the bell wider by some 4 %: within 20 %.
TEST(Galton, ItsBellIsAboutTheBinomialLaws) {
    const auto readings = report_of("galton --quiet --steps 3840").at("readings");
    EXPECT_GT(readings.at("balls"), 190);
    EXPECT_NEAR(readings.at("deviation").get<double>(), 0.7906, 0.16);
}

TEST(ProjectileDemo, StartsASalvoEveryEightSecondsAtEachRate) {
    for (const int rate : {10, 144}) {
        std::vector<int> bodies(static_cast<std::size_t>(17 * rate + 1));
        for (const TraceRow& row :
             trace_of(fmt::format("projectile --quiet --rate {0} --steps {1}", rate, 17 * rate)))
            ++bodies.at(static_cast<std::size_t>(row.tick));
        std::vector<int> starts;
        for (int tick = 1; tick <= 17 * rate; ++tick)
            if (bodies.at(tick) > bodies.at(tick - 1)) starts.push_back(tick - 1);
        EXPECT_EQ(starts, (std::vector{8 * rate, 16 * rate})) << rate;
    }
}

std::vector<json> pictures_of(const std::string& demo, const std::string& options) {
    const Folder folder;
    const std::string out = (folder / "film").string();
    std::istringstream lines(shell(demo + " --headless --quiet --size 16x9 --out '" + out + "' " +
                                   options + " && gzip -dc '" + out + "/frames.jsonl.gz'")
                                 .out);
    std::vector<json> pictures;
    for (std::string line; std::getline(lines, line);)
        pictures.push_back(json::parse(line).at("picture"));
    return pictures;
}

TEST(Demos, HaveTextsThatCanBeRead) {
    constexpr double least = 4.5;
    const auto colour = [](const json& rgba) {
        return Colour{rgba.at(0), rgba.at(1), rgba.at(2), rgba.at(3)};
    };
    for (const char* const demo :
         {"bounce", "cannon", "cloth", "galton", "integrator_race", "jump", "jump_rates",
          "platformer", "projectile", "spring_damper", "stability_map"})
        for (const json& picture : pictures_of(demo, "--fps 3 --frames 4")) {
            const Colour ground = colour(picture.at("background"));
            for (const json& label : picture.value("labels", json::array()))
                EXPECT_GE(contrast(colour(label.at("colour")), ground), least)
                    << demo << ": " << label.at("text");
        }
}

// Films the demo spring_damper, whose wall, mass and curves stay beside each other.

/// The left end of a line.
double left_of(const json& line) {
    double left = INFINITY;
    for (std::size_t i = 0; i < line["points"].size(); i += 2)
        left = std::min(left, line["points"][i].get<double>());
    return left;
}

/// The only line of that width.
const json& line_of(const json& picture, const char* space, double width) {
    const auto& lines = picture.at("lines");
    return *std::ranges::find_if(
        lines, [&](const json& one) { return one["space"] == space && one["width"] == width; });
}

const char* const settings[] = {"--fps 10 --frames 40",
                                "--method explicit_euler --rate 8 --fps 4 --frames 80",
                                "--method explicit_euler --rate 1 --fps 1 --frames 50"};

TEST(SpringDamperDemo, ItsMassStaysOnOneSideOfTheWallAndInThePicture) {
    for (const char* const options : settings) {
        const std::vector<json> pictures = pictures_of("spring_damper", options);
        ASSERT_GE(pictures.size(), 40U);
        for (const json& picture : pictures) {
            const double wall = left_of(line_of(picture, "world", 3));
            const double exact = left_of(line_of(picture, "world", 2));
            const json& mass = picture.at("discs").at(0);
            const double half_width = picture.at("height").get<double>() * 16 / 9 / 2;
            const double x = mass["centre"][0];
            const double radius = mass["radius"];
            EXPECT_GT(wall, -half_width) << options;
            EXPECT_GT(x - radius, wall) << options;
            EXPECT_GT(exact, wall) << options;
            EXPECT_LT(x + radius, half_width) << options;
        }
    }
}

// The positions are in a box from 152 to 256 units. A curve that leaves it is cut at its edges.
TEST(SpringDamperDemo, ItsCurveStaysWithinItsPlot) {
    constexpr int part = 12;  // of the key: the simulated positions
    for (const char* const options : settings) {
        std::size_t curves = 0;
        for (const json& picture : pictures_of("spring_damper", options))
            for (const json& line : picture.at("lines")) {
                if (line["key"][1] != part) continue;
                ++curves;
                for (std::size_t i = 1; i < line["points"].size(); i += 2) {
                    EXPECT_GT(line["points"][i], 152) << options;
                    EXPECT_LT(line["points"][i], 256) << options;
                }
            }
        EXPECT_GE(curves, 39U) << options;
    }
}

}  // namespace
}  // namespace oiler::test
