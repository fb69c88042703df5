// SPDX-License-Identifier: MIT
// The table of --what-if: lengths have the unit of their size, other readings their own.
#include "oiler/whatif/what_if.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

WhatIfRun run_at(int rate, double distance, double at_steps) {
    WhatIfRun run;
    run.stepping = {.method = &find_method("rk4"), .rate = {rate}};
    run.distance = distance;
    run.distance_at_steps = at_steps;
    run.read_at = 2;
    return run;
}

std::string printed() {
    WhatIf result;
    result.duration = result.certain_until = 2;
    result.uncertainty = 6.4e-13;
    result.reference = run_at(7680, 0, 0);
    result.check = run_at(3780, 0, 0);
    result.runs = {run_at(60, 0.0079, 0), run_at(30, 12.5, 3e-5)};
    const std::vector<Reading> truth{{"apex", 2.025, "m"}, {"speed", 5, "m/s"}, {"score", 300}};
    result.reference.readings = result.check.readings = result.check.true_readings = truth;
    for (WhatIfRun& run : result.runs) run.readings = run.true_readings = truth;
    result.runs[1].readings = {{"apex", 1.95, "m"}, {"speed", 5.25, "m/s"}, {"score", 200}};
    return text_of(result, "jump");
}

TEST(WhatIfText, LengthsHaveTheUnitOfTheirSize) {
    const std::string text = printed();
    EXPECT_TRUE(holds(text, "; at 3780 Hz it differs by 6e-13 m\n")) << text;
    EXPECT_TRUE(holds(text, "rk4, 60 Hz, double *                       7.9 mm < 0.0064 nm "))
        << text;
    EXPECT_TRUE(holds(text, "rk4, 30 Hz, double                         12.5 m      30 µm "))
        << text;
}

TEST(WhatIfText, ReadingsHaveTheirUnitInEachCell) {
    const std::string text = printed();
    EXPECT_TRUE(holds(text, "\napex at the end: 2.025 m\n")) << text;
    EXPECT_TRUE(holds(text, "rk4, 60 Hz, double *                        2.025 m        0 m\n"))
        << text;
    EXPECT_TRUE(holds(text, "rk4, 30 Hz, double                           1.95 m    -7.5 cm\n"))
        << text;
    EXPECT_TRUE(holds(text, "  5.25 m/s  +0.25 m/s\n")) << text;
    EXPECT_TRUE(holds(text, "  200       -100\n")) << text;
}

}  // namespace
}  // namespace oiler::test
