// SPDX-License-Identifier: MIT
// Runs `oiler diverge` on hand-made traces and on traces of real runs.
#include <fmt/format.h>

#include <cstdlib>

#include "cli/desk.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

const std::string scenes = OILER_SOURCE "/assets/scenes/";

/// Compares two traces with one body of two axes at 100 ticks per second.
Outcome compare(const Desk& desk, const std::string& rows_a, const std::string& rows_b,
                const std::string& options = "") {
    desk.put("a.csv", "tick,time,body,x,y,vx,vy\n" + rows_a);
    desk.put("b.csv", "tick,time,body,x,y,vx,vy\n" + rows_b);
    return desk.run("oiler diverge a.csv b.csv " + options);
}

TEST(DivergeCommand, TellsWhereRunsInDoubleFirstDiffer) {
    const Desk desk;
    const Outcome run = compare(desk,
                                "40,0.4,2,0,0,0,0.1\n40,0.4,5,0,0,0,0\n"
                                "41,0.41,2,0,0,0,3.2041\n41,0.41,5,1,0,1,0\n",
                                "40,0.4,2,0,0,0,0.1\n40,0.4,5,0,0,0,0\n"
                                "41,0.41,2,0,0,0,3.204100000000001\n"
                                "41,0.41,5,1.0000000000000002,0,1,0\n");
    EXPECT_EQ(run.exit, 1);
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(
        run.out,
        "The runs first differ at tick 41 (0.41 s): body 2, vy: 3.2041 and 3.204100000000001, "
        "2 ulp (8.9e-16 m/s).\n"
        "The numbers of 2 bodies differ at tick 41.\n"
        "1 ulp is that of double: only b.csv has numbers with more digits than a float. The run "
        "of a.csv may be in float.\n\n"
        "      tick      time, s  distance, m                  ulp  body\n"
        "        41         0.41     2.22e-16                    1  5\n");
}

TEST(DivergeCommand, TellsWhereRunsInFloatFirstDiffer) {
    const Desk desk;
    const Outcome run = compare(desk, "0,0,0,0.1,0,0,0\n1,0.01,0,0.2,1,0,0\n2,0.02,0,0.4,-1,0,0\n",
                                "0,0,0,0.10000001,0,0,0\n1,0.01,0,0.2,1,0,0\n2,0.02,0,0.4,1,0,0\n");
    EXPECT_EQ(run.exit, 1);
    EXPECT_EQ(
        run.out,
        "The runs first differ at tick 0 (0 s): body 0, x: 0.1 and 0.10000001, 1 ulp (7.5e-09 m).\n"
        "1 ulp is that of float: all numbers of both files are shortest digits of floats.\n\n"
        "      tick      time, s  distance, m                  ulp  body\n"
        "         0            0     7.45e-09                    1  0\n"
        "         1         0.01            0                    0  0\n"
        "         2         0.02            2           2130706432  0\n");
}

TEST(DivergeCommand, WritesTheSameFactsAsJson) {
    const Desk desk;
    const std::string rows_a = "0,0,1,0,0,0,0\n1,0.01,1,3,0,1e-300,0\n1,0.01,3,0,0,0,0\n";
    const std::string rows_b =
        "0,0,1,0,0,0,0\n1,0.02,1,3,0.5,-0,0\n1,0.02,4,0,0,0,0\n2,3,4,5,6,7,8\n";
    const Outcome run = compare(desk, rows_a, rows_b, "--json -");
    EXPECT_EQ(run.exit, 1);
    EXPECT_EQ(run.err, "");
    const Json json = Json::parse(run.out);
    // 0.5 is 1022 binades of 2^52 doubles above 0; 1e-300 is closer.
    const Json expected = {
        {"same", false},
        {"a", {{"file", "a.csv"}, {"last_tick", 1}, {"precision", "double"}}},
        {"b", {{"file", "b.csv"}, {"last_tick", 2}, {"precision", "float"}}},
        {"first_tick", 0},
        {"last_tick", 1},
        {"last_time", 0.01},
        {"bodies", 3},
        {"precision", "double"},
        {"value",
         {{"tick", 1},
          {"time", 0.01},
          {"body", 1},
          {"field", "y"},
          {"a", 0.0},
          {"b", 0.5},
          {"ulps", std::uint64_t{1022} << 52},
          {"distance", 0.5},
          {"unit", "m"},
          {"bodies_that_differ", 1}}},
        {"presence", {{"tick", 1}, {"time", 0.01}, {"only_a", {3}}, {"only_b", {4}}}},
        {"times", {{"tick", 1}, {"a", 0.01}, {"b", 0.02}}},
        {"growth",
         {{{"tick", 1},
           {"time", 0.01},
           {"distance", 0.5},
           {"ulps", std::uint64_t{1022} << 52},
           {"body", 1}}}}};
    EXPECT_EQ(json, expected) << json.dump(2);
    EXPECT_EQ(compare(desk, rows_a, rows_b, "--json file.json").out,
              desk.run("oiler diverge a.csv b.csv").out);
    EXPECT_EQ(desk.json("file.json"), expected);
    const Json same = Json::parse(compare(desk, rows_a, rows_a, "--json -").out);
    EXPECT_EQ(same.at("same"), true);
    EXPECT_EQ(same.at("value"), nullptr);
    EXPECT_EQ(same.at("growth"), Json::array());
}

TEST(DivergeCommand, NamesBodiesAndTimesThatDiffer) {
    const Desk desk;
    std::string many;
    for (int body = 1; body <= 12; ++body) many += fmt::format("5,0.05,{},0,0,0,0\n", body);
    const Outcome run = compare(desk, "5,0.05,1,0,0,0,0\n6,0.06,1,0,0,0,1\n6,0.06,7,0,0,0,0\n",
                                many + "6,0.07,1,0,0,0,0\n");
    EXPECT_EQ(run.exit, 1);
    EXPECT_TRUE(run.out.starts_with(
        "The runs first differ at tick 5 (0.05 s): bodies 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 and 1 "
        "more are only in b.csv.\n"
        "At tick 6 (0.06 s): the time is 0.06 s in a.csv and 0.07 s in b.csv, because their rates "
        "differ.\n"
        "At tick 6 (0.06 s): body 1, vy: 1 and 0, 1065353216 ulp (1 m/s).\n"
        "1 ulp is that of float: "))
        << run.out;
    const Outcome swapped =
        compare(desk, "5,0.05,1,0,0,0,0\n5,0.05,3,0,0,0,0\n", "5,0.05,2,0,0,0,0\n");
    EXPECT_EQ(swapped.out,
              "The runs first differ at tick 5 (0.05 s): bodies 1, 3 are only in a.csv; body 2 is "
              "only in b.csv.\n");
}

TEST(DivergeCommand, TellsZerosOfDifferentSignsApart) {
    const Desk desk;
    const Outcome run = compare(desk, "0,0,0,0,1,1,1\n", "0,0,0,-0,1,1,1\n");
    EXPECT_EQ(run.exit, 1);
    EXPECT_TRUE(run.out.starts_with(
        "The runs first differ at tick 0 (0 s): body 0, x: 0 and -0, which differ only in their "
        "signs.\n"))
        << run.out;
}

TEST(DivergeCommand, ComparesRunsOfDifferentLengths) {
    const Desk desk;
    const std::string start = "0,0,0,1,1,1,1\n1,0.01,0,1,1,1,1\n";
    const std::string same = "The runs are the same: ticks 0 to 1 (0.01 s), 1 body.\n";
    const Outcome longer = compare(desk, start, start + "9,0.09,0,1,1,1,1\n");
    EXPECT_EQ(longer.exit, 0);
    EXPECT_EQ(longer.out,
              same + "b.csv continues to tick 9; its ticks after 1 are not compared.\n");
    const Outcome shorter = compare(desk, start + "9,0.09,0,1,1,1,1\n", start);
    EXPECT_EQ(shorter.out,
              same + "a.csv continues to tick 9; its ticks after 1 are not compared.\n");
    EXPECT_EQ(compare(desk, start, start).out, same);
}

TEST(DivergeCommand, ReadsPipes) {
    const Desk desk;
    compare(desk, "0,0,3,1,2,3,4\n", "0,0,3,1,2,3,4\n");
    desk.run("cat a.csv | oiler diverge /dev/stdin b.csv", 0);
}

TEST(DivergeCommand, RefusesMalformedAndMissingFiles) {
    const Desk desk;
    const Outcome cut = compare(desk, "0,0,3,1,2,3,4\n", "0,0,3,1,2,3,4");
    EXPECT_EQ(cut.exit, 2);
    EXPECT_EQ(cut.err,
              "oiler: b.csv:2: expected a complete line, got `0,0,3,1,2,3,4`; the file may be "
              "truncated\n");
    EXPECT_EQ(cut.out, "");
    desk.put("one.csv", "tick,time,body,x,vx\n0,0,0,1,2\n");
    const Outcome axes = desk.run("oiler diverge one.csv a.csv", 2);
    EXPECT_EQ(axes.err, "oiler: one.csv has 1 axis and a.csv has 2; give runs of the same scene\n");
    for (const char* files : {"none.csv a.csv", "a.csv none.csv"}) {
        const Outcome missing = desk.run(std::string("oiler diverge ") + files, 2);
        EXPECT_EQ(missing.err, "oiler: none.csv: cannot be read: No such file or directory\n");
    }
    desk.run("oiler diverge a.csv", 2);
    desk.run("oiler diverge a.csv a.csv a.csv", 2);
}

using Lines = std::vector<std::string>;

Lines split(const std::string& text, char at) {
    Lines parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
    return parts;
}

/// The distance of the positions in two rows of a trace with two axes.
double distance(const std::string& row_a, const std::string& row_b) {
    const Lines a = split(row_a, ',');
    const Lines b = split(row_b, ',');
    const auto along = [&](std::size_t column) {
        return std::strtod(a[column].c_str(), nullptr) - std::strtod(b[column].c_str(), nullptr);
    };
    return std::hypot(along(3), along(4));
}

/// Plays the orbit and one with another gm; returns the lines of their traces.
std::pair<Lines, Lines> play_orbits(const Desk& desk, const std::string& gm,
                                    const std::string& options) {
    std::string scene = text_of(scenes + "orbit.toml");
    desk.put("orbit.toml", scene);
    const std::string before = "gm = 1.0";
    desk.put("changed.toml", scene.replace(scene.find(before), before.size(), "gm = " + gm));
    for (const std::string name : {"orbit", "changed"}) {
        desk.run("oiler play " + name +
                     ".toml --steps 2000 --quiet --method velocity_verlet --trace " + name +
                     ".csv " + options,
                 0);
    }
    return {split(desk.text("orbit.csv"), '\n'), split(desk.text("changed.csv"), '\n')};
}

/// The planet has a row in each tick, so that line n + 1 of the traces is tick n.
void expect_first_difference_of_orbits(const std::string& gm, const std::string& precision) {
    const Desk desk;
    const auto [a, b] = play_orbits(desk, gm, "--precision " + precision);
    ASSERT_EQ(a.size(), 2002U);
    ASSERT_EQ(b.size(), a.size());
    std::size_t tick = 0;
    while (tick < 2000 && a[tick + 1] == b[tick + 1]) ++tick;
    const Outcome run = desk.run("oiler diverge orbit.csv changed.csv --json -", 1);
    const Json json = Json::parse(run.out);
    EXPECT_EQ(json.at("precision"), precision);
    const Json& value = json.at("value");
    EXPECT_EQ(value.at("tick"), tick);
    EXPECT_GE(value.at("ulps"), 1);
    const Lines names = split(a[0], ',');
    const auto column = static_cast<std::size_t>(
        std::find(names.begin(), names.end(), value.at("field").get<std::string>()) -
        names.begin());
    ASSERT_LT(column, names.size());
    const std::string number_a = split(a[tick + 1], ',')[column];
    const std::string number_b = split(b[tick + 1], ',')[column];
    EXPECT_NE(number_a, number_b);
    EXPECT_EQ(value.at("a"), std::strtod(number_a.c_str(), nullptr));
    EXPECT_EQ(value.at("b"), std::strtod(number_b.c_str(), nullptr));
    const Json& growth = json.at("growth");
    EXPECT_GE(growth.size(), 10U);
    EXPECT_EQ(growth.back().at("tick"), 2000);
    for (const Json& row : growth) {
        const std::size_t line = row.at("tick").get<std::size_t>() + 1;
        const double expected = distance(a[line], b[line]);
        EXPECT_NEAR(row.at("distance").get<double>(), expected,
                    precision == "float" ? 1e-7 : 1e-12 * expected);
    }
    desk.run("oiler diverge orbit.csv orbit.csv", 0);
}

TEST(DivergeCommand, FindsTheFirstDifferenceOfOrbits) {
    expect_first_difference_of_orbits("1.0000000000000002", "double");
    expect_first_difference_of_orbits("1.0000001", "float");
}

/// Frames of a spring at 120 Hz.
void capture(const Desk& desk, const std::string& folder, const std::string& options) {
    const Outcome run =
        desk.run("oiler play scene.toml --headless --quiet --size 32x18 --rate 120 --out " +
                 folder + " " + options);
    ASSERT_EQ(run.exit, 0) << run.err;
}

// Frames at 60 Hz show ticks 0, 2, 4, …, those at 40 Hz show 0, 3, 6, ….
TEST(DivergeCommand, ComparesFramesThatShowTheSameTick) {
    const Desk desk;
    capture(desk, "a", "--fps 60 --frames 10");
    capture(desk, "b", "--fps 40 --frames 10");
    const Outcome same = desk.run("oiler diverge a b", 0);
    EXPECT_TRUE(same.out.starts_with("The runs are the same: ticks 0 to 18 (0.15 s), 1 body.\n"))
        << same.out;
    EXPECT_TRUE(holds(same.out, "b continues to tick 27"));
    capture(desk, "c", "--fps 40 --frames 10 --method explicit_euler");
    const Outcome other = desk.run("oiler diverge a c/manifest.json", 1);
    EXPECT_TRUE(holds(other.out, "The hashes first differ at tick 1."));
    EXPECT_TRUE(holds(other.out, "The frames first differ at tick 6 (0.05 s): body '"));
}

// The frames show the same, but a tick between them does not.
TEST(DivergeCommand, FindsHashesThatDifferBetweenTheFrames) {
    const Desk desk;
    capture(desk, "a", "--fps 60 --frames 3");
    capture(desk, "b", "--fps 60 --frames 3");
    Json manifest = desk.json("b/manifest.json");
    std::string hashes = manifest.at("frames").at(2).at("tick_hashes");
    hashes[0] = hashes[0] == '0' ? '1' : '0';
    manifest.at("frames").at(2).at("tick_hashes") = hashes;
    desk.put("b/manifest.json", manifest.dump());
    const Outcome run = desk.run("oiler diverge a b", 1);
    EXPECT_EQ(run.out,
              "The hashes first differ at tick 3. States are those of the frames.\n"
              "The frames have the same positions and velocities.\n");
    EXPECT_EQ(Json::parse(desk.run("oiler diverge a b --json -").out).at("same"), false);
}

TEST(DivergeCommand, FindsHashesThatDifferAtTheStart) {
    const Desk desk;
    capture(desk, "a", "--fps 60 --frames 3");
    capture(desk, "b", "--fps 60 --frames 3 --precision float");
    EXPECT_TRUE(
        desk.run("oiler diverge a b").out.starts_with("The hashes first differ at tick 0."));
}

TEST(DivergeCommand, RefusesCapturesWithoutAStateInCommon) {
    const Desk desk;
    capture(desk, "a", "--fps 60 --frames 3");
    capture(desk, "none", "--fps 60 --frames 3 --png none");
    const Outcome run = desk.run("oiler diverge a none", 2);
    EXPECT_TRUE(holds(run.err, "none: no states there, because frames.jsonl.gz is missing"));
}

TEST(DivergeCommand, IsListedWithAnExample) {
    const Desk desk;
    EXPECT_TRUE(holds(desk.run("oiler --help").out, "\n  diverge "));
    EXPECT_TRUE(holds(desk.run("oiler diverge --help").out, "Example: oiler diverge "));
}

}  // namespace
}  // namespace oiler::test
