// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>
#include <thread>

#include "oiler/core/markup.hpp"
#include "oiler/core/profile.hpp"
#include "oiler/core/utf8.hpp"
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

using namespace std::chrono_literals;
using Json = nlohmann::json;

Json events_of(const Profile& profile) {
    const Json json = Json::parse(profile.to_json());
    EXPECT_EQ(json.at("displayTimeUnit"), "ms");
    return json.at("traceEvents");
}

// What a terminal or a CI reads as a command: ESC of ASCII and the same of Latin 1, text that runs
// backwards, a byte outside UTF-8, and lines of GitHub and Azure.
TEST(ForTerminal, ShowsWhatWouldBeACommand) {
    EXPECT_EQ(for_terminal("\x1b[2J \xc2\x9b[2J \r\t\x7f"), "\\x1b[2J \\x9b[2J \\x0d\\x09\\x7f");
    EXPECT_EQ(for_terminal("\xe2\x80\xae\xe2\x81\xa6 \xff"), "\\u202e\\u2066 \\xff");
    EXPECT_EQ(for_terminal("::error::a\n \xe3\x80\x80::debug"),
              "\\x3a:error::a\n \xe3\x80\x80\\x3a:debug");
    EXPECT_EQ(for_terminal("a ##vso[task.complete]\n##[group]"),
              "a \\x23#vso[task.complete]\n\\x23#[group]");
}

TEST(ForTerminal, KeepsTexts) {
    for (const std::string text : {"", "µ · — ω√\U0001F600 \xef\xbf\xbd\n", "a::b: #1 #f0f0f0\n\n",
                                   "C:\\x", "oiler: std::error::x"})
        EXPECT_EQ(for_terminal(text), text);
}

TEST(JsonText, HasNoCommandOfATerminalOrACi) {
    EXPECT_EQ(oiler::Json("\xc2\x9b[2J\x7f ##vso[x] #a").dump(-1),
              "\"\\u009b[2J\\u007f #\\u0023vso[x] #a\"");
    JunitSuite suite("a");
    suite.add("##vso[x]", "#1", Outcome::passed, "");
    EXPECT_NE(suite.xml().find("classname=\"#&#35;vso[x]\" name=\"#1\""), std::string::npos);
}

TEST(Profile, HasTimesInMicroseconds) {
    Profile profile;
    const auto begin = Profile::Clock::now();
    profile.add("draw", begin + 2s, begin + 2s + 1500us);
    profile.add("read", begin + 3s, begin + 3s);
    const Json events = events_of(profile);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].at("name"), "draw");
    EXPECT_EQ(events[0].at("ph"), "X");
    EXPECT_EQ(events[0].at("pid"), 1);
    EXPECT_EQ(events[0].at("tid"), 1);
    EXPECT_EQ(events[0].at("dur"), 1500);
    EXPECT_EQ(events[1].at("dur"), 0);
    EXPECT_NEAR(events[1].at("ts").get<double>() - events[0].at("ts").get<double>(), 1e6, 1e-3);
    EXPECT_GE(events[0].at("ts"), 2e6) << "since the profile was made";
}

TEST(Profile, TakesSpansOfManyThreads) {
    Profile profile;
    std::vector<std::thread> threads;
    for (const char* name : {"a", "b", "c"})
        threads.emplace_back([&profile, name] {
            for (int i = 0; i < 1000; ++i) const Span span(&profile, name);
        });
    for (std::thread& thread : threads) thread.join();
    std::map<std::string, int> counts;
    std::map<std::string, int> numbers;
    for (const Json& event : events_of(profile)) {
        const std::string name = event.at("name");
        ++counts[name];
        EXPECT_EQ(numbers.try_emplace(name, event.at("tid")).first->second, event.at("tid"));
    }
    EXPECT_EQ(counts, (std::map<std::string, int>{{"a", 1000}, {"b", 1000}, {"c", 1000}}));
    EXPECT_EQ(numbers["a"] + numbers["b"] + numbers["c"], 1 + 2 + 3);
}

TEST(Profile, HasTheValuesOfCounters) {
    Profile profile;
    profile.count("shown step", 2.25);
    profile.add("draw", Profile::Clock::now(), Profile::Clock::now());
    profile.count("shown step", 3);
    std::vector<double> values;
    double last = 0;
    for (const Json& event : events_of(profile)) {
        if (event.at("ph") != "C") continue;
        EXPECT_EQ(event.at("name"), "shown step");
        EXPECT_EQ(event.at("pid"), 1);
        EXPECT_GE(event.at("ts"), last);
        last = event.at("ts");
        values.push_back(event.at("args").at("shown step"));
    }
    EXPECT_EQ(values, (std::vector<double>{2.25, 3}));
    EXPECT_GT(last, 0) << "since the profile was made";
    EXPECT_LT(last, 60e6) << "in µs";
}

TEST(Span, LastsFromItsConstructionToItsDestruction) {
    Profile profile;
    const auto begin = Profile::Clock::now();
    {
        const Span span(&profile, "sleep");
        std::this_thread::sleep_for(3ms);
    }
    const std::chrono::duration<double, std::micro> whole = Profile::Clock::now() - begin;
    const double measured = events_of(profile).at(0).at("dur");
    EXPECT_GE(measured, 3000);
    EXPECT_LE(measured, whole.count());
}

TEST(Span, OfNoProfileMeasuresNothing) { const Span span(nullptr, "draw"); }

}  // namespace
}  // namespace oiler::test
