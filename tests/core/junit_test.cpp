// SPDX-License-Identifier: MIT
#include "oiler/core/markup.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

using Outcome = JunitSuite::Outcome;

TEST(Junit, HasEachOutcome) {
    JunitSuite suite("oiler check");
    suite.add("jump.toml", "position_error", Outcome::passed, "0.1 of 0.25 m");
    suite.add("jump.toml", "energy_drift", Outcome::failed, "2 of 1");
    suite.add("orbit.toml", "energy_drift", Outcome::failed, "3 of 1");
    suite.add("bad.toml", "read", Outcome::error, "no such file");
    suite.add("chain.toml", "budget", Outcome::skipped, "none");
    EXPECT_EQ(suite.xml(), R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuite name="oiler check" tests="5" failures="2" errors="1" skipped="1">
  <testcase classname="jump.toml" name="position_error"><system-out>0.1 of 0.25 m</system-out></testcase>
  <testcase classname="jump.toml" name="energy_drift"><failure message="2 of 1"/></testcase>
  <testcase classname="orbit.toml" name="energy_drift"><failure message="3 of 1"/></testcase>
  <testcase classname="bad.toml" name="read"><error message="no such file"/></testcase>
  <testcase classname="chain.toml" name="budget"><skipped message="none"/></testcase>
</testsuite>
)");
}

TEST(Junit, OfNoCaseIsValid) {
    EXPECT_EQ(JunitSuite("empty").xml(),
              "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"empty\" tests=\"0\" "
              "failures=\"0\" errors=\"0\" skipped=\"0\">\n</testsuite>\n");
}

// U+2192, U+1F600, a control of ASCII, one of Latin 1, and bytes that are not UTF-8.
TEST(Junit, ReplacesWhatXmlDoesNotAllow) {
    JunitSuite suite("\"<&>\"");
    suite.add("a\nb", "c\x01\xC2\x85", Outcome::failed, "1 \xE2\x86\x92 2 \xF0\x9F\x98\x80 \xff");
    const std::string xml = suite.xml();
    EXPECT_NE(xml.find("<testsuite name=\"&quot;&lt;&amp;&gt;&quot;\" "), xml.npos) << xml;
    EXPECT_NE(
        xml.find("classname=\"a?b\" name=\"c??\"><failure message=\"1 &#8594; 2 &#128512; ?\""),
        xml.npos)
        << xml;
}

// Any bytes in any text leave as many tags and quotes as there were.
TEST(Junit, KeepsItsShapeWithAnyByte) {
    const auto count = [](const std::string& xml, char what) {
        return std::count(xml.begin(), xml.end(), what);
    };
    for (int first = 0; first < 256; ++first)
        for (int second = 0; second < 256; ++second) {
            const std::string text{static_cast<char>(first), static_cast<char>(second)};
            JunitSuite suite(text);
            suite.add(text, text, Outcome::error, text);
            const std::string xml = suite.xml();
            EXPECT_EQ(count(xml, '<'), 6) << first << ' ' << second;
            EXPECT_EQ(count(xml, '>'), 6) << first << ' ' << second;
            EXPECT_EQ(count(xml, '"'), 4 + 2 * 5 + 2 * 3) << first << ' ' << second;
            EXPECT_TRUE(std::all_of(xml.begin(), xml.end(),
                                    [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }))
                << first << ' ' << second;
        }
}

}  // namespace
}  // namespace oiler::test
