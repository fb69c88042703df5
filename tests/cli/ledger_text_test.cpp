// SPDX-License-Identifier: MIT
#include "oiler/cli/ledger_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "oiler/scene/read.hpp"

namespace oiler::test {
namespace {

using lab::LedgerPass;

// Shares of 25 ± 0.5 %, 0.4 ± 0.5 %, −30 ± 2 % and none.
std::string printed() {
    lab::Ledger ledger;
    ledger.bodies = 1;
    ledger.steps = ledger.samples = 40;
    ledger.timed_steps = 19;
    ledger.rounds = 300;
    ledger.ns = 20;
    ledger.spread_ns = 0.1;
    const auto add = [&](const char* name, double percent, double spread) {
        ledger.passes.push_back({.name = name,
                                 .ns = std::max(0.0, 20 * percent / 100),
                                 .saves_ns = 20 * percent / 100,
                                 .saves_percent = percent,
                                 .spread_percent = spread,
                                 .changes_position = 1.5});
    };
    add("spring", 25, 0.5);
    add("linear_drag", 0.4, 0.5);
    add("gravity", -30, 2);
    ledger.passes.push_back({.name = "attractor", .diverged = "diverged at step 7"});
    ledger.passes.push_back({.name = "moving", .ns = 12});
    const Scene scene = parse_scene("[scene]\naxes = 1\nrate = 100\n[[body]]\n", "test.toml");
    return cli::ledger_text(scene, "test", ledger, 40);
}

bool has_line(const std::string& text, const std::string& line) {
    return text.find("\n" + line + "\n") != std::string::npos;
}

TEST(LedgerText, HasASpreadInEachRow) {
    const std::string text = printed();
    EXPECT_NE(text.find("A step takes 20 ± 0.1 ns per body."), std::string::npos) << text;
    EXPECT_TRUE(has_line(text, "  spring                 5 ns,   25.0 ±  0.5 %  1.5 m")) << text;
    EXPECT_TRUE(has_line(text, "  linear_drag      within the spread, ±  0.5 %  1.5 m")) << text;
    EXPECT_TRUE(has_line(text, "  gravity               -6 ns,  -30.0 ±    2 %  1.5 m")) << text;
    EXPECT_TRUE(has_line(text, "  attractor                                  -  diverges")) << text;
    EXPECT_NE(text.find(" 300 rounds of 19 steps"), std::string::npos) << text;
}

}  // namespace
}  // namespace oiler::test
