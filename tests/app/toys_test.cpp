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
    EXPECT_TRUE(holds(undamped, "explodes: × 1.41 per step\n")) << undamped;
    EXPECT_TRUE(holds(undamped, "1 kg on 3600 N/m explodes at any rate.\n")) << undamped;
    const std::string damped = map_after(drag_to(1, 0.3), "--method explicit_euler --rate 100");
    EXPECT_TRUE(holds(damped, "explodes: × 1.18 per step\n")) << damped;
    EXPECT_TRUE(holds(damped, "1 kg on 10000 N/m needs ω·dt ≤ 0.60, so 167 Hz.\n")) << damped;
}

// Implicit Euler multiplies the amplitude by 1/√(1 + c + q²).
TEST(StabilityMap, ImplicitEulerNeverExplodes) {
    const std::string text = map_after(drag_to(3, 0), "--method implicit_euler");
    const double left = 100 * std::pow(1 + 9, -std::numbers::pi / 3);
    EXPECT_TRUE(holds(text, fmt::format("rests: {:.0f} % left", left))) << text;
    EXPECT_TRUE(holds(text, "the limit is off the map.")) << text;
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
    EXPECT_TRUE(holds(text, "ω·dt = 1.90 at 60 Hz, ζ = 0.70")) << text;
    const std::string tape = " '" + (folder / "tape").string() + "'";
    const std::string record = "stability_map --steps 120 --record" + tape;
    ASSERT_EQ(shell(record + with_script(folder, script)).exit, 0);
    const Outcome replay = shell("stability_map --quiet --steps 120 --replay" + tape);
    EXPECT_EQ(replay.exit, 0) << replay.err;
}

double threads_of(const std::string& command) {
    return report_of(command).at("readings").at("threads").get<double>();
}

// 19 × 12 bodies: 18·12 + 19·11 threads across and down, 2·18·11 diagonals.
constexpr int all_threads = 18 * 12 + 19 * 11 + 2 * 18 * 11;

// The fastest wave of the flat net has ω² = 8·k/m, k = 70 N/m, m = 0.02 kg, and velocity Verlet
// follows it from ω/2 on, 83.7 Hz.
TEST(Cloth, TearsItselfToPiecesBelowTheRateOfItsFastestWave) {
    EXPECT_EQ(threads_of("cloth --quiet --steps 1000 --rate 100"), all_threads);
    EXPECT_LT(threads_of("cloth --quiet --steps 800 --rate 80"), all_threads / 2);
    EXPECT_EQ(threads_of("cloth --quiet --steps 160 --rate 40 --method implicit_midpoint"),
              all_threads);
}

// Crumpled, ω² is at most 16·k/m. The limit of ω·dt is 2, and 2(√(1 + ζ²) − ζ) for semi-implicit
// Euler with damping in the kick, of 0.01 N·s/m in each thread.
TEST(Cloth, NamesTheRatesThatTheMethodNeeds) {
    const auto says = [](const std::string& options, const std::string& words) {
        const std::string text = texts_of("cloth --quiet " + options, 1).at(0);
        EXPECT_TRUE(holds(text, words)) << text;
    };
    const double flat = std::sqrt(8 * 70 / 0.02);
    const auto needs = [&](double limit, const char* verdict) {
        return fmt::format("\nIt needs {:.0f} Hz while flat, up to {:.0f} Hz crumpled: {}.\n",
                           std::ceil(flat / limit), std::ceil(std::sqrt(2) * flat / limit),
                           verdict);
    };
    says("", "velocity_verlet at 120 Hz" + needs(2, "it holds"));
    says("--rate 100", needs(2, "do not crumple it"));
    says("--rate 80", needs(2, "it tears itself to pieces"));
    const auto in_kick = [](double n) {
        const double omega = std::sqrt(n * 70 / 0.02);
        const double zeta = n * 0.01 / 0.02 / (2 * omega);
        return std::ceil(omega / (2 * (std::sqrt(1 + zeta * zeta) - zeta)));
    };
    says("--method semi_implicit_euler",
         fmt::format(
             "\nIt needs {:.0f} Hz while flat, up to {:.0f} Hz crumpled: do not crumple it.\n",
             in_kick(8), in_kick(16)));
    says("--method implicit_midpoint", "\nIt holds at any rate.\n");
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
    const Outcome replay = shell("cloth --quiet --threads 2 --steps 340 --replay" + tape);
    EXPECT_EQ(replay.exit, 0) << replay.err;
}

}  // namespace
}  // namespace oiler::test
