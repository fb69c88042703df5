// SPDX-License-Identifier: MIT
#include "oiler/compare/runs/state_log.hpp"

#include <fmt/format.h>

#include <bit>
#include <random>

#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Numbers = std::vector<double>;
using Bodies = std::vector<std::uint32_t>;

StateLog read(const std::string& text) {
    const Folder folder;
    put(folder / "t.csv", text);
    return read_trace(folder / "t.csv");
}

TEST(TraceFile, IsReadWithOneTwoAndThreeAxes) {
    const StateLog one = read("tick,time,body,x,vx\n0,0,7,1,-2\n1,0.5,7,3e-7,-0\n");
    EXPECT_EQ(one.axes, 1);
    EXPECT_EQ(one.values, (Numbers{1, -2, 3e-7, 0}));
    EXPECT_TRUE(std::signbit(one.values[3]));
    EXPECT_EQ(one.bodies, (Bodies{7, 7}));
    ASSERT_EQ(one.ticks.size(), 2U);
    EXPECT_EQ(one.ticks[1].tick, 1);
    EXPECT_EQ(one.ticks[1].time, 0.5);
    EXPECT_EQ(one.ticks[1].first_row, 1U);
    EXPECT_EQ(one.end_row(1), 2U);
    const StateLog two = read("tick,time,body,x,y,vx,vy\n3,1,0,1,2,3,4\n3,1,1,5,6,7,8\n");
    EXPECT_EQ(two.axes, 2);
    EXPECT_EQ(two.ticks.size(), 1U);
    EXPECT_EQ(two.values, (Numbers{1, 2, 3, 4, 5, 6, 7, 8}));
    const StateLog three = read("tick,time,body,x,y,z,vx,vy,vz\n0,0,4294967295,1,2,3,4,5,6\n");
    EXPECT_EQ(three.axes, 3);
    EXPECT_EQ(three.bodies, (Bodies{4294967295U}));
    EXPECT_EQ(three.values, (Numbers{1, 2, 3, 4, 5, 6}));
}

TEST(TraceFile, RowsOfATickAreSortedByBody) {
    const StateLog log = read(
        "tick,time,body,x,vx\n0,0,5,50,51\n0,0,2,20,21\n0,0,9,90,91\n"
        "1,1,2,22,23\n1,1,5,52,53\n2,2,9,94,95\n2,2,2,24,25\n");
    EXPECT_EQ(log.bodies, (Bodies{2, 5, 9, 2, 5, 2, 9}));
    EXPECT_EQ(log.values, (Numbers{20, 21, 50, 51, 90, 91, 22, 23, 52, 53, 24, 25, 94, 95}));
}

/// A trace of these numbers as positions of a body at rest.
template <class Real>
std::string trace_of(const std::vector<Real>& numbers) {
    std::string text = "tick,time,body,x,vx\n";
    for (std::size_t i = 0; i < numbers.size(); ++i)
        text += fmt::format("{0},{0},0,{1},0\n", i, numbers[i]);
    return text;
}

/// Finite numbers with random bits, so of all magnitudes, and whole numbers.
template <class Real, class Bits>
std::vector<Real> random_numbers() {
    std::mt19937_64 random(1);
    std::vector<Real> numbers{0, Real(-0.0), Real(123456789), Real(16777217), Real(1e20), -1};
    while (numbers.size() < 20'000) {
        const Real number = std::bit_cast<Real>(static_cast<Bits>(random()));
        if (std::isfinite(number)) numbers.push_back(number);
    }
    return numbers;
}

TEST(TraceFile, NumbersReadBackToTheSameBits) {
    const auto doubles = random_numbers<double, std::uint64_t>();
    const StateLog log = read(trace_of(doubles));
    ASSERT_EQ(log.ticks.size(), doubles.size());
    for (std::size_t i = 0; i < doubles.size(); ++i)
        EXPECT_EQ(std::bit_cast<std::uint64_t>(log.values[2 * i]),
                  std::bit_cast<std::uint64_t>(doubles[i]));
    EXPECT_FALSE(log.floats);
    const auto floats = random_numbers<float, std::uint32_t>();
    const StateLog in_float = read(trace_of(floats));
    for (std::size_t i = 0; i < floats.size(); ++i)
        EXPECT_EQ(std::bit_cast<std::uint32_t>(static_cast<float>(in_float.values[2 * i])),
                  std::bit_cast<std::uint32_t>(floats[i]));
    EXPECT_TRUE(in_float.floats);
}

// 0.10000000149011612 is exactly a float, whose shortest digits are 0.1.
TEST(TraceFile, OneNumberWithMoreDigitsThanAFloatIsOfARunInDouble) {
    for (const char* digits : {"0.30000000000000004", "0.10000000149011612", "0.123456789", "1e39",
                               "1e-46", "0.10000000000000002"}) {
        EXPECT_FALSE(
            read(fmt::format("tick,time,body,x,vx\n0,0,0,0.1,1\n1,1,0,{},1\n", digits)).floats)
            << digits;
        EXPECT_FALSE(
            read(fmt::format("tick,time,body,x,vx\n0,0,0,0.1,{}\n1,1,0,1,1\n", digits)).floats)
            << digits;
    }
    EXPECT_TRUE(read("tick,time,body,x,vx\n0,0,0,0.1,1\n1,0.30000000000000004,0,1e-7,1\n").floats)
        << "times are in double in every run";
}

// Rows cross the ends of the buffer at all places.
TEST(TraceFile, LongFilesAreReadCompletely) {
    constexpr std::size_t ticks = 30'000;
    std::string text = "tick,time,body,x,y,vx,vy\n";
    for (std::size_t i = 0; i < ticks; ++i)
        for (std::size_t body = 0; body < 3; ++body)
            text += fmt::format("{},{},{},{},{},{},{}\n", i, i, body, i,
                                std::string(i % 50 + 1, '7'), i * body, -1);
    ASSERT_GT(text.size(), std::size_t{3} << 20);
    const StateLog log = read(text);
    ASSERT_EQ(log.ticks.size(), ticks);
    ASSERT_EQ(log.bodies.size(), 3 * ticks);
    for (std::size_t row = 0; row < log.bodies.size(); ++row) {
        EXPECT_EQ(log.row(row)[0], static_cast<double>(row / 3));
        EXPECT_EQ(log.row(row)[2], static_cast<double>(row / 3 * (row % 3)));
        EXPECT_EQ(log.bodies[row], row % 3);
    }
}

std::string refusal_of(const std::string& text) {
    const Folder folder;
    const std::string path = folder / "t.csv";
    put(path, text);
    const std::string line = line_of_error(Exit::usage, [&] { (void)read_trace(path); });
    EXPECT_TRUE(line.starts_with(path + ":")) << line;
    return line.starts_with(path) ? line.substr(path.size() + 1) : line;
}

TEST(TraceFile, RefusesOtherHeaders) {
    const std::string expected =
        "1: expected the header of a trace, for example `tick,time,body,x,y,vx,vy`, got `";
    EXPECT_EQ(refusal_of(""), expected + "`");
    EXPECT_EQ(refusal_of("\n"), expected + "`");
    for (const char* header :
         {"tick,time,body", "tick,time,body,x,y,vx", "tick,time,kinetic,potential,total",
          "tick, time,body,x,vx", "0,0,0,1,2"})
        EXPECT_EQ(refusal_of(std::string(header) + "\n0,0,0,1,2\n"), expected + header + "`");
    EXPECT_EQ(refusal_of("tick,time,body,x,vx\r\n"), expected + "tick,time,body,x,vx?`");
    EXPECT_EQ(refusal_of(std::string(70, 'x') + "\n"), expected + std::string(60, 'x') + "…`");
}

/// The refusal of these lines below the header of one axis.
std::string refusal_of_rows(const std::string& rows) {
    return refusal_of("tick,time,body,x,vx\n" + rows);
}

TEST(TraceFile, RefusesMalformedCells) {
    const std::string whole = "expected a whole number, 0 or more, got `";
    const std::string finite = "expected a finite number, got `";
    for (const char* bad : {"", "-1", "1.5", "+1", " 1", "1 ", "x", "99999999999999999999"}) {
        EXPECT_EQ(refusal_of_rows(std::string(bad) + ",0,0,1,2\n"),
                  "2: tick: " + whole + bad + "`");
        EXPECT_EQ(refusal_of_rows("0,0,0,1,2\n0,0," + std::string(bad) + ",1,2\n"),
                  "3: body: " + whole + bad + "`");
    }
    for (const char* bad :
         {"", "nan", "-nan", "inf", "-inf", "1e999", "1e", "0x10", "1.2.3", "--1", "1 ", "1\r"}) {
        std::string shown = bad;
        if (shown == "1\r") shown = "1?";
        EXPECT_EQ(refusal_of_rows("0," + std::string(bad) + ",0,1,2\n"),
                  "2: time: " + finite + shown + "`");
        EXPECT_EQ(refusal_of_rows("0,0,0," + std::string(bad) + ",2\n"),
                  "2: x: " + finite + shown + "`");
        EXPECT_EQ(refusal_of_rows("0,0,0,1," + std::string(bad) + "\n"),
                  "2: vx: " + finite + shown + "`");
    }
    EXPECT_EQ(refusal_of_rows("0,0,4294967296,1,2\n"), "2: body: " + whole + "4294967296`");
}

TEST(TraceFile, RefusesOtherNumbersOfColumns) {
    EXPECT_EQ(refusal_of_rows("0,0,0,1\n"), "2: expected 5 columns, got 4");
    EXPECT_EQ(refusal_of_rows("0,0,0,1,2,3\n"), "2: expected 5 columns, got 6");
    EXPECT_EQ(refusal_of_rows("0,0,0,1,2,\n"), "2: expected 5 columns, got 6");
    EXPECT_EQ(refusal_of_rows("0,0,0,1,2\n\n"), "3: expected 5 columns, got 1");
}

TEST(TraceFile, RefusesTruncatedFiles) {
    for (const char* end : {"1,1,0,1,2", "1,1,0,1", "1", "1,1,0,1,2\r"}) {
        std::string shown = end;
        if (shown.back() == '\r') shown.back() = '?';
        EXPECT_EQ(refusal_of_rows("0,0,0,1,2\n" + std::string(end)),
                  "3: expected a complete line, got `" + shown + "`; the file may be truncated");
    }
    EXPECT_EQ(refusal_of_rows(""), "2: expected a row of numbers, got the end of the file");
    EXPECT_TRUE(refusal_of(std::string(3 << 20, ',') + "\n").starts_with("1: expected a complete"));
}

TEST(TraceFile, RefusesTicksOutOfOrder) {
    EXPECT_EQ(refusal_of_rows("0,0,0,1,2\n2,2,0,1,2\n1,1,0,1,2\n"),
              "4: tick: expected 2 or a later one, got 1");
    EXPECT_EQ(refusal_of_rows("0,0,0,1,2\n1,0,0,1,2\n"),
              "3: time: expected more than the 0 of tick 0, got 0");
    EXPECT_EQ(refusal_of_rows("0,0,0,1,2\n0,0.5,1,1,2\n"),
              "3: time: expected 0 as in the row above, got 0.5");
}

TEST(TraceFile, RefusesDoubledRows) {
    EXPECT_EQ(refusal_of_rows("0,0,4,1,2\n0,0,4,1,2\n"),
              "3: expected one row of body 4 in tick 0, got two");
    EXPECT_EQ(refusal_of_rows("0,0,4,1,2\n1,1,3,1,2\n1,1,9,1,2\n1,1,5,1,2\n1,1,3,1,2\n2,2,0,1,2\n"),
              "6: expected one row of body 3 in tick 1, got two");
}

TEST(TraceFile, NamesTheReasonWhyItCannotBeRead) {
    const Folder folder;
    for (const auto& [path, reason] : {std::pair(folder / "none", "No such file or directory"),
                                       std::pair(folder.path(), "Is a directory")})
        EXPECT_EQ(line_of_error(Exit::usage, [&file = path] { (void)read_trace(file); }),
                  path.string() + ": cannot be read: " + reason);
}

}  // namespace
}  // namespace oiler::test
