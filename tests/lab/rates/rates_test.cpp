// SPDX-License-Identifier: MIT
#include <cmath>

#include "lab/measured_rates.hpp"

namespace oiler::test {
namespace {

// A stopped call has quantities without values.
TEST(Rates, CanBeStopped) {
    const MeasuredScene measured(article_spring);
    const Rates rates = measure_rates(measured.scene, measured.reference, 0, {20, 30},
                                      {&find_method("rk4")}, [] { return true; });
    ASSERT_FALSE(rates.quantities.empty());
    for (const RatesQuantity& quantity : rates.quantities)
        for (const double value : quantity.lines[0].values) EXPECT_TRUE(std::isnan(value));
}

TEST(FindBody, ByNameOrNumber) {
    const Scene scene = parse_scene(
        "[scene]\naxes = 1\n[[body]]\nname = \"a\"\n[[body]]\nname = \"0\"\n[[body]]\n"
        "[[grid]]\ncount = [4, 1]\nspacing = 1.0\nstiffness = 1.0\n",
        "test.toml");
    EXPECT_EQ(find_body(scene, "a"), 0U);
    EXPECT_EQ(find_body(scene, "0"), 1U);
    EXPECT_EQ(find_body(scene, "1"), 1U);
    EXPECT_EQ(find_body(scene, "6"), 6U);
    for (const char* name : {"7", "-1", "b", "1x", " 1", "1.0", "99999999999999999999"}) {
        const std::string line = line_of_error(Exit::usage, [&] { (void)find_body(scene, name); });
        EXPECT_TRUE(holds(line, name));
        EXPECT_TRUE(holds(line, "from 0 to 6"));
    }
}

}  // namespace
}  // namespace oiler::test
