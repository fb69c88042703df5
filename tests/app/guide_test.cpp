// SPDX-License-Identifier: MIT
// Plays the programs of the guide in demos/guide.md. Expected motions are parabolas:
// velocity_verlet is exact without drag.
#include <fmt/format.h>

#include <map>
#include <regex>

#include "app/played.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double g = 9.81;      // m/s²
constexpr double speed = 20;    // m/s
constexpr double radius = 0.3;  // m, of a ball
constexpr double exact = 1e-9;  // m, far above round-off
const double first_angle = std::atan2(0.6, 0.8);
const double turn_per_step = std::atan(0.01);  // at 100 Hz

/// The height of a ball that has flown to a distance of the muzzle, m.
double height_at(double x, double angle) {
    const double t = (x - 2 - 2 * std::cos(angle)) / (speed * std::cos(angle));
    return 1 + 2 * std::sin(angle) + speed * std::sin(angle) * t - g / 2 * t * t;
}

/// The number of turns down from the first angle that hits best.
int turns_down_to(double x, double y) {
    int best = 0;
    for (int turns = 0; turns < 60; ++turns)
        if (std::abs(height_at(x, first_angle - turns * turn_per_step) - y) <
            std::abs(height_at(x, first_angle - best * turn_per_step) - y))
            best = turns;
    return best;
}

/// Hits both targets of the first level, restarts, and opens the menu. Targets hang 2 m and
/// m·g/k = 0.65 m below their hooks, and swing by 0.35 m.
std::string play_through() {
    const int turns = turns_down_to(26, 8 - 2 - 2 * g / 30);
    return fmt::format(
        "10 press Space\n20 hold Down\n{} release Down\n210 press Space\n650 press R\n"
        "750 press Escape\n",
        20 + turns);
}

TEST(Guide, Step1FliesAParabola) {
    const TraceRow last = trace_of("step1 --quiet --steps 100").back();
    EXPECT_NEAR(last.x, 2 + 12, exact);
    EXPECT_NEAR(last.y, 1 + 14 - g / 2, exact);
}

TEST(Guide, Step2FiresWhereItAims) {
    const Folder folder;
    const TraceRow last =
        trace_of("step2 --steps 110" +
                 with_script(folder, "0 hold Up\n10 release Up\n10 press Space\n"))
            .back();
    const double angle = first_angle + 10 * turn_per_step;
    EXPECT_NEAR(last.x, 2 + (2 + speed) * std::cos(angle), exact);
    EXPECT_NEAR(last.y, 1 + (2 + speed) * std::sin(angle) - g / 2, exact);
}

TEST(Guide, Step3BouncesOffGroundAndWallAndDisappears) {
    const Folder folder;
    const auto rows = trace_of("step3 --steps 700" + with_script(folder, "10 press Space\n"));
    const double landing_speed =
        std::sqrt(std::pow(speed * 0.6, 2) + 2 * g * (1 + 2 * 0.6 - radius));
    const double second_apex = radius + std::pow(0.6 * landing_speed, 2) / (2 * g);
    bool has_landed = false;
    double apex = 0;
    for (const TraceRow& row : rows) {
        EXPECT_GE(row.y, radius - exact);
        EXPECT_LE(row.x, 32 - radius + exact);
        if (row.y < 1) has_landed = true;
        if (has_landed) apex = std::max(apex, row.y);
    }
    // A sample is at most half a step from the apex.
    EXPECT_NEAR(apex, second_apex, g / 2 * 0.005 * 0.005 + exact);
    EXPECT_EQ(rows.front().tick, 11);
    EXPECT_EQ(rows.back().tick, 610) << "6 s after the shot";
}

TEST(Guide, Step4DestroysATarget) {
    const Folder folder;
    EXPECT_EQ(report_of("step4 --quiet --steps 200").at("bodies"), 2);
    EXPECT_EQ(report_of("step4 --steps 200" + with_script(folder, "10 press Space\n")).at("bodies"),
              2)
        << "a target and a ball";
    EXPECT_EQ(report_of("step4 --steps 700" + with_script(folder, "10 press Space\n")).at("bodies"),
              0)
        << "after a bounce it meets the other one";
    EXPECT_EQ(report_of("step4 --steps 700" +
                        with_script(folder, "0 hold Up\n50 release Up\n50 press Space\n"))
                  .at("bodies"),
              2)
        << "it misses";
}

TEST(Guide, Steps5And6HaveScoreLevelsRestartAndMenu) {
    for (const std::string step : {"step5", "step6"}) {
        const Folder folder;
        const auto texts = texts_of(step + with_script(folder, play_through()), 9);
        ASSERT_EQ(texts.size(), 9U);
        EXPECT_EQ(texts[0], "Level 1   Score 0\n");
        EXPECT_EQ(texts[2], "Level 1   Score 100\n");
        EXPECT_EQ(texts[6], "Level 2   Score 200\n");
        EXPECT_EQ(texts[7], "Level 1   Score 0\n");
        EXPECT_EQ(texts[8], "Escape: resume   R: restart   Q: quit\n");
    }
}

TEST(Guide, OnlyTheHashOfStep6CoversTheAim) {
    const Folder folder;
    for (const std::string step : {"step5", "step6"}) {
        const std::string run = step + " --quiet --steps 30";
        const auto idle = report_of(run).at("state_hash");
        const auto aimed =
            report_of(run + with_script(folder, "0 hold Up\n9 release Up\n")).at("state_hash");
        EXPECT_EQ(idle == aimed, step == "step5");
    }
}

TEST(Guide, Step6IsRecordedReplayedAndComparedWithGoldenFrames) {
    const Folder folder;
    const std::string tape = " '" + (folder / "tape").string() + "'";
    const std::string script = with_script(folder, play_through());
    shell("step6 --steps 800 --record" + tape + script, 0);
    shell("step6 --quiet --threads 2 --steps 800 --replay" + tape, 0);
    const std::string film = "step6 --headless --fps 1 --frames 3 --size 64x36 --golden '" +
                             (folder / "golden").string() + "'";
    const std::string now = " --out '" + (folder / "now").string() + "'";
    shell(film + script + "--update-golden --force", 0);
    shell(film + script + now, 0);
    shell(film + with_script(folder, "11 press Space\n") + now, 1);
}

std::string trimmed(const std::string& line) {
    return line.substr(std::min(line.find_first_not_of(' '), line.size()));
}

// Each line of code in the guide is in the file that the paragraph before it names.
TEST(Guide, ReadmeShowsTheLinesOfItsPrograms) {
    const std::string readme = text_of(OILER_SOURCE "/demos/guide.md");
    const std::size_t begin = readme.find("## Cannon in six steps");
    std::istringstream lines(
        readme.substr(begin, readme.find("## What does the timestep cost") - begin));
    const std::regex link(R"(\]\(([a-z0-9_/]+\.cpp)\))");
    std::string line, file;
    bool in_code = false;
    std::map<std::string, int> checked;
    while (std::getline(lines, line)) {
        std::smatch found;
        if (std::regex_search(line, found, link)) file = found[1];
        if (line.starts_with("```")) {
            in_code = line == "```cpp";
        } else if (in_code) {
            EXPECT_TRUE(holds(text_of(OILER_SOURCE "/demos/" + file), trimmed(line)))
                << file << ": " << line;
            ++checked[file];
        }
    }
    EXPECT_EQ(checked.size(), 6U + 1);
    EXPECT_GT(checked["guide/step6.cpp"], 0);
    EXPECT_GT(checked["platformer.cpp"], 25);
}

/// The height of the platformer's jump and the time of its flight, as drawn, on straight lines
/// between steps.
struct Jump {
    double height = 0;  // m
    double time = 0;    // s
};
Jump jump_with(const std::string& method, int rate) {
    const Folder folder;
    const auto rows = trace_of(
        fmt::format("platformer --method {} --rate {} --steps {}", method, rate, 2 * rate) +
        with_script(folder, "0.2s hold Space\n1.5s release Space\n"));
    const double dt = 1.0 / rate;
    const auto in_air = [](const TraceRow& row) { return row.y > 0.4 + 1e-9; };
    const auto first = std::ranges::find_if(rows, in_air);
    Jump jump;
    auto last = first;
    for (; last + 1 != rows.end() && in_air(*(last + 1)); ++last)
        jump.height = std::max(jump.height, last->y - 0.4);
    const double fall = last->vy * dt - 30 * dt * dt / (method == "velocity_verlet" ? 2 : 1);
    jump.time = double(last - first) * dt + dt + dt * (last->y - 0.4) / -fall;
    return jump;
}

// The guide tells, in cm, by how much a jump with 12.6 m/s and 30 m/s² at 7 m/s is too low and too
// short.
TEST(Guide, ReadmeTellsWhatTheTimestepTakesFromAJump) {
    const std::string readme = text_of(OILER_SOURCE "/demos/guide.md");
    for (const std::string method : {"semi_implicit_euler", "velocity_verlet"}) {
        std::string height, width;
        for (const int rate : {30, 60, 120, 240}) {
            const Jump jump = jump_with(method, rate);
            height += fmt::format(" | {:.0f}", 100 * std::abs(12.6 * 12.6 / 60 - jump.height));
            width += fmt::format(" | {:.0f}", 100 * std::abs(7 * (2 * 12.6 / 30 - jump.time)));
        }
        EXPECT_TRUE(holds(readme, fmt::format("| height, `{}`{} |\n", method, height))) << height;
        EXPECT_TRUE(holds(readme, fmt::format("| width, `{}`{} |\n", method, width))) << width;
    }
}

TEST(Guide, ReadmeTellsHowManyCoinsTheSameKeysFindAtOtherRates) {
    const Folder folder;
    const std::string tape = " '" + (folder / "tape").string() + "'";
    const std::string script =
        with_script(folder, text_of(OILER_SOURCE "/demos/scripts/platformer.txt"));
    shell("platformer --steps 1800 --record" + tape + script, 0);
    const auto report = nlohmann::json::parse(
        shell("platformer --quiet --replay" + tape + " --what-if 30,60,240 --json -", 0).out);
    std::vector<double> coins;
    for (const auto& setting : report.at("settings"))
        coins.push_back(setting.at("readings").at(0).at("value"));
    EXPECT_EQ(coins, (std::vector<double>{7, 3, 7, 7}));
    EXPECT_TRUE(holds(text_of(OILER_SOURCE "/demos/guide.md"),
                      "seven coins at 60, 120 and 240 Hz find three at 30 Hz"));
}

}  // namespace
}  // namespace oiler::test
