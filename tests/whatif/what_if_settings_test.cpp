// SPDX-License-Identifier: MIT
// The settings of --what-if, and its programs.
#include "oiler/whatif/what_if.hpp"

#include <nlohmann/json.hpp>

#include "support/oscillator.hpp"
#include "support/program.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

struct Still {
    static constexpr About about{.name = "still", .title = "Still"};
    World world;
    explicit Still(const Settings& settings) : world(1, settings) {}
    [[nodiscard]] Picture picture() const { return {}; }
};

TEST(WhatIfSettings, AreReadFromWords) {
    const Stepping recorded{.method = &find_method("rk4"), .rate = {60}};
    std::string list;
    for (const Stepping& stepping :
         parse_what_if("30,velocity_verlet@120@float,kick,exact", recorded))
        list += table_text(stepping) + "\n";
    EXPECT_EQ(list,
              "rk4, 30 Hz, double\nvelocity_verlet, 120 Hz, float\nrk4, 60 Hz, double, kick\n"
              "exact, 60 Hz, double\n");
    for (const char* wrong : {"", "30,", "30,,20", "30@", "30,rk4,30", "30@40", "rk4@rk4", "0",
                              "1000001", "1e3", "rk5", "-30"}) {
        const std::string line =
            line_of_error(Exit::usage, [&] { (void)parse_what_if(wrong, recorded); });
        EXPECT_TRUE(holds(line, "--what-if "));
        EXPECT_TRUE(holds(line, "give settings such as") || holds(line, "it comes twice")) << line;
    }
}

TEST(WhatIfSettings, ThatBeginWithADigitAreWholeRates) {
    for (const char* wrong : {"60.5", "1e3", "30,rk4@60Hz", "99999999999999999999"}) {
        const std::string line = line_of_error(
            Exit::usage, [&] { (void)parse_what_if(wrong, {.method = &find_method("rk4")}); });
        EXPECT_TRUE(holds(line, "': expected a whole rate in Hz, for example 60; ")) << line;
    }
}

TEST(WhatIfSettings, ThatAreUsualChangeOneThing) {
    const auto usual = [](const Stepping& recorded) {
        std::string list;
        for (const Stepping& stepping : usual_what_if(
                 Settings{.stepping = recorded},
                 [](const Settings& own) { return std::make_unique<AnyGameOf<Still>>(own); }))
            list += table_text(stepping) + "\n";
        return list;
    };
    EXPECT_EQ(usual({.method = &find_method("velocity_verlet"), .rate = {50}}),
              "velocity_verlet, 25 Hz, double\nvelocity_verlet, 100 Hz, double\n"
              "semi_implicit_euler, 50 Hz, double\nrk4, 50 Hz, double\n"
              "velocity_verlet, 50 Hz, float\n");
    EXPECT_FALSE(holds(usual({.rate = {75}}), " 37 Hz"));
}

TEST(WhatIfSettings, ArePrintedByPrograms) {
    const Folder folder;
    const auto path = [&](const char* name) { return "'" + (folder / name).string() + "' "; };
    put(folder / "kick.txt", "10 press Space\n");
    ASSERT_EQ(shell("hello --steps 60 --script " + path("kick.txt") + "--record " + path("a")).exit,
              0);
    const std::string replay = "hello --replay " + path("a") + "--what-if ";
    const Outcome run = shell(replay + "30,rk4 --json " + path("json"), 0);
    EXPECT_TRUE(holds(run.out, "\n  semi_implicit_euler, 60 Hz, double *"));
    EXPECT_TRUE(holds(run.out, "\n  rk4, 60 Hz, double "));
    const auto json = nlohmann::json::parse(text_of(folder / "json"));
    EXPECT_EQ(json.at("reference").at("rate"), 7680);
    EXPECT_EQ(json.at("settings").at(1).at("rate"), 30);
    EXPECT_GT(json.at("settings").at(1).at("ns_per_frame").at("draw"), 0);
    const Outcome usual = shell(replay + "--quiet --surface egl --json -", 0);
    EXPECT_EQ(nlohmann::json::parse(usual.out).at("settings").size(), 6U);
    for (const std::string& wrong : {replay + "30 --headless", replay + "--steps 9", replay + "31x",
                                     replay + "--surface window", std::string("hello --what-if")}) {
        const Outcome refused = shell(wrong, 2);
        EXPECT_EQ(lines(refused.err), 1) << refused.err;
    }
}

}  // namespace
}  // namespace oiler::test
