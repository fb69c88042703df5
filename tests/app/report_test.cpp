// SPDX-License-Identifier: MIT
#include "oiler/app/report.hpp"

#include <nlohmann/json.hpp>

#include "oiler/app/run_game.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

Json report_of(const RunReport& report, const World& world) {
    const Folder folder;
    File file(folder / "report");
    write_report(file, report, world);
    return Json::parse(text_of(folder / "report"));
}

// After 3 steps at 4 Hz a free body of 2 kg at 3 m/s has ½·2·3² = 9 J.
TEST(Report, HasEachNumberUnderItsName) {
    World world(1, {.stepping = {.rate = {4}, .damping = Damping::in_drift}, .seed = 5});
    world.spawn(Body{.mass = 2, .velocity = {3}});
    world.spawn(Body{});
    world.step(2);  // one was held
    const Json json = report_of({.steps = 3,
                                 .scene = "s",
                                 .first = {.kinetic = 1, .potential = 2},
                                 .last = world.bodies().energy(),
                                 .dropped = 1500ms,
                                 .wall = 2250ms},
                                world);
    EXPECT_EQ(json["scene"], "s");
    EXPECT_EQ(json["method"], "semi_implicit_euler");
    EXPECT_EQ(json["damping"], "drift");
    EXPECT_EQ(json["rate"], 4);
    EXPECT_EQ(json["precision"], "double");
    EXPECT_EQ(json["threads"], 1);
    EXPECT_EQ(json["seed"], 5);
    EXPECT_EQ(json["steps"], 3);
    EXPECT_EQ(json["time"], 0.75);
    EXPECT_EQ(json["bodies"], 2);
    EXPECT_EQ(json["energy"]["first"], (Json{{"kinetic", 1}, {"potential", 2}, {"total", 3}}));
    EXPECT_EQ(json["energy"]["last"], (Json{{"kinetic", 9}, {"potential", 0}, {"total", 9}}));
    EXPECT_EQ(json["dropped_time"], 1.5);
    EXPECT_EQ(json["wall_seconds"], 2.25);
    EXPECT_FALSE(json.contains("budget"));
}

TEST(Report, OfADivergenceHasItsMessageAndNullForUnknownNumbers) {
    const World world(1);
    const Json lost = report_of({.scene = "s", .first = {1, 2}, .divergence = "at step 3"}, world);
    EXPECT_EQ(lost["diverged"], "at step 3");
    EXPECT_EQ(lost["state_hash"], nullptr);
    EXPECT_EQ(lost["energy"]["first"]["total"], 3);
    EXPECT_EQ(lost["energy"]["last"], nullptr);
    const Json overflown = report_of(
        {.scene = "s", .first = {}, .last = Energy{1, INFINITY}, .divergence = "energy"}, world);
    EXPECT_TRUE(overflown["state_hash"].is_string());
    EXPECT_EQ(overflown["energy"]["last"],
              (Json{{"kinetic", 1}, {"potential", nullptr}, {"total", nullptr}}));
    EXPECT_EQ(report_of({.scene = "s", .first = {}, .last = Energy{}}, world)["diverged"], nullptr);
}

// Only splitting methods can put damping elsewhere.
TEST(Report, HasNoDampingForAMethodWithoutAChoice) {
    const auto damping = [](const char* method) {
        const World world(1, {.stepping = {.method = &find_method(method)}});
        return report_of({.scene = "s", .first = {}}, world)["damping"];
    };
    EXPECT_EQ(damping("velocity_verlet"), "drift");
    EXPECT_EQ(damping("semi_implicit_euler"), "kick");
    for (const char* const method : {"rk4", "exact", "implicit_midpoint"})
        EXPECT_EQ(damping(method), nullptr) << method;
}

TEST(Report, HasEachEntryOfTheBudget) {
    const Json json = report_of({.scene = "s",
                                 .first = {},
                                 .budget = {{"position_error", 1, 0.5, true, ""},
                                            {"energy_drift", 2, INFINITY, false, ""}}},
                                World(1));
    EXPECT_EQ(json["budget"]["position_error"],
              (Json{{"budget", 1}, {"measured", 0.5}, {"kept", true}}));
    EXPECT_EQ(json["budget"]["energy_drift"],
              (Json{{"budget", 2}, {"measured", "infinite"}, {"kept", false}}));
}

struct Empty {
    static constexpr About about{.name = "empty", .title = "Empty"};
    World world;
    explicit Empty(const Settings& settings) : world(1, settings) {}
    Picture picture() const { return {}; }
};

/// Exit code of a run of one step whose budget entries are kept or exceeded.
Exit end_of(const std::vector<bool>& kept, Options options) {
    options.steps = 1;
    options.quiet = true;
    const auto make = [](const Settings& settings) {
        return std::make_unique<AnyGameOf<Empty>>(settings);
    };
    const auto measure = [&](double seconds) {
        EXPECT_EQ(seconds, 0.01);  // one step at 100 Hz
        std::vector<BudgetEntry> entries;
        for (const bool is_kept : kept) entries.push_back({"error", 1, 0, is_kept, "error 0 of 1"});
        return entries;
    };
    return run_game(options, Empty::about, make, measure);
}

TEST(Budget, FailsTheRunIfAnyEntryIsExceeded) {
    const Folder folder;
    Options options;
    options.json = folder / "report";
    EXPECT_EQ(end_of({true, true}, options), Exit::done);
    EXPECT_EQ(end_of({false, true}, options), Exit::comparison_failed);
    EXPECT_EQ(end_of({true, false}, options), Exit::comparison_failed);
    EXPECT_EQ(end_of({false, false}, options), Exit::comparison_failed);
}

TEST(Budget, IsMeasuredOnlyForJsonOrHeadlessRuns) {
    EXPECT_EQ(end_of({false}, {}), Exit::done);
    Options headless;
    headless.headless = true;
    EXPECT_EQ(end_of({false}, headless), Exit::comparison_failed);
}

TEST(Budget, PrintsExceededEntriesInQuietRunsToo) {
    Options options;
    options.headless = true;
    testing::internal::CaptureStderr();
    EXPECT_EQ(end_of({true, false}, options), Exit::comparison_failed);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "[budget] error 0 of 1\n");
}

}  // namespace
}  // namespace oiler::test
