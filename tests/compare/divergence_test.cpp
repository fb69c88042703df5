// SPDX-License-Identifier: MIT
#include "oiler/compare/runs/divergence.hpp"

#include <charconv>
#include <cstdlib>
#include <random>

#include "oiler/core/floating_point.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

struct Row {
    std::int64_t tick;
    std::uint32_t body;
    std::vector<double> values;
};

/// A log at 8 ticks per second.
StateLog log_of(const std::vector<Row>& rows, bool floats = false) {
    StateLog log;
    log.floats = floats;
    log.axes = static_cast<int>(rows.front().values.size() / 2);
    for (const Row& row : rows) {
        if (log.ticks.empty() || log.ticks.back().tick != row.tick)
            log.ticks.push_back({row.tick, static_cast<double>(row.tick) / 8, log.bodies.size()});
        log.bodies.push_back(row.body);
        log.values.insert(log.values.end(), row.values.begin(), row.values.end());
    }
    return log;
}

template <class Real>
Real moved(Real value, int ulps) {
    for (; ulps > 0; --ulps) value = std::nextafter(value, Real{1000});
    return value;
}

/// The shortest decimal of a float, read as a double.
double decimal_of(float value) {
    char digits[64] = {};
    std::to_chars(digits, digits + sizeof digits, value);
    return std::strtod(digits, nullptr);
}

double stored(double value) { return value; }
double stored(float value) { return decimal_of(value); }

/// Numbers of bodies 3 and 5 at ticks 0 to 3, all different and none exact.
template <class Real>
std::vector<Row> rows_of(std::size_t axes) {
    std::vector<Row> rows;
    Real value = Real{1} / 3;
    for (const std::int64_t tick : {0, 1, 2, 3})
        for (const std::uint32_t body : {3U, 5U}) {
            rows.push_back({tick, body, {}});
            for (std::size_t i = 0; i < 2 * axes; ++i)
                rows.back().values.push_back(stored(value = -value * Real{1.1F}));
        }
    return rows;
}

/// Changes the field of body 5 at tick 2, and all later numbers of body 3 by more.
template <class Real>
void expect_found(std::size_t axes, std::size_t field, int ulps) {
    const bool floats = sizeof(Real) == sizeof(float);
    std::vector<Row> rows = rows_of<Real>(axes);
    const StateLog a = log_of(rows, floats);
    const auto from = static_cast<Real>(rows[5].values[field]);
    const Real to = moved(from, ulps);
    rows[5].values[field] = stored(to);
    for (double& value : rows[6].values) value += 1;
    const RunDivergence found = find_divergence(a, log_of(rows, floats));
    ASSERT_TRUE(found.value);
    EXPECT_FALSE(found.same());
    EXPECT_EQ(found.floats, floats);
    EXPECT_EQ(found.value->tick, 2);
    EXPECT_EQ(found.value->time, 0.25);
    EXPECT_EQ(found.value->body, 5U);
    EXPECT_EQ(found.value->bodies, 1U);
    EXPECT_EQ(found.value->field, static_cast<int>(field));
    EXPECT_EQ(found.value->a, stored(from));
    EXPECT_EQ(found.value->b, stored(to));
    EXPECT_EQ(found.value->ulps, static_cast<std::uint64_t>(ulps));
    EXPECT_EQ(found.value->distance, double{to} - double{from});
}

TEST(Divergence, IsFoundInEveryField) {
    for (const std::size_t axes : {1U, 2U, 3U})
        for (std::size_t field = 0; field < 2 * axes; ++field)
            for (const int ulps : {1, 2, 7}) {
                SCOPED_TRACE(testing::Message() << axes << " axes, field " << field);
                expect_found<double>(axes, field, ulps);
                expect_found<float>(axes, field, ulps);
            }
}

TEST(Divergence, NamesFields) {
    const auto names = [](int axes) {
        std::string all;
        for (int field = 0; field < 2 * axes; ++field)
            all += field_name(axes, field) + " " + field_unit(axes, field) + " ";
        return all;
    };
    EXPECT_EQ(names(1), "x m vx m/s ");
    EXPECT_EQ(names(2), "x m y m vx m/s vy m/s ");
    EXPECT_EQ(names(3), "x m y m z m vx m/s vy m/s vz m/s ");
}

TEST(Divergence, IsAbsentInEqualRuns) {
    const StateLog log = log_of(rows_of<double>(2));
    const RunDivergence found = find_divergence(log, log);
    EXPECT_TRUE(found.same());
    EXPECT_EQ(std::tuple(found.first_tick, found.last_tick, found.last_time, found.bodies),
              std::tuple(0, 3, 0.375, 2U));
    EXPECT_TRUE(found.growth.empty());
}

// 0.1 and the next float, 0.10000001, are far apart in double.
TEST(Divergence, CountsUlpsOfDoubleIfEitherRunIsInDouble) {
    const double next = decimal_of(std::nextafter(0.1F, 1.0F));
    const auto ulps = [&](bool floats_a, bool floats_b) {
        const RunDivergence found = find_divergence(log_of({{0, 0, {0.1, 0}}}, floats_a),
                                                    log_of({{0, 0, {next, 0}}}, floats_b));
        return std::pair(found.floats, found.value->ulps);
    };
    // An ulp of 0.1 is 2^-56 m, and the decimals are 1e-8 m apart.
    EXPECT_EQ(ulps(true, true), std::pair(true, std::uint64_t{1}));
    for (const auto& [a, b] : {std::pair(true, false), {false, true}, {false, false}}) {
        EXPECT_FALSE(ulps(a, b).first);
        EXPECT_NEAR(static_cast<double>(ulps(a, b).second), std::ldexp(1e-8, 56), 1);
    }
}

// 4 ulps of 512 are more metres than 5 ulps of 1. The first of two equal distances is named.
TEST(Divergence, NamesTheNumberWithTheMostUlps) {
    std::vector<Row> rows{
        {7, 1, {1, 1}}, {7, 2, {1, 512}}, {7, 4, {1, 1}}, {7, 6, {1, 1}}, {7, 9, {1, 1}}};
    const StateLog a = log_of(rows);
    rows[0].values[1] = moved(1.0, 3);
    rows[1].values[1] = moved(512.0, 4);
    rows[2].values = {moved(1.0, 4), moved(1.0, 5)};
    rows[3].values[0] = moved(1.0, 5);
    const RunDivergence found = find_divergence(a, log_of(rows));
    EXPECT_EQ(std::tuple(found.value->body, found.value->field, found.value->ulps),
              std::tuple(4U, 1, 5U));
    EXPECT_EQ(found.value->bodies, 4U);
}

RunDivergence::Value value_of(double a, double b) {
    return *find_divergence(log_of({{0, 0, {a, 1}}}), log_of({{0, 0, {b, 1}}})).value;
}

TEST(Divergence, TellsZerosOfDifferentSignsApart) {
    const RunDivergence::Value value = value_of(0.0, -0.0);
    EXPECT_EQ(value.ulps, 0U);
    EXPECT_EQ(value.distance, 0.0);
    EXPECT_TRUE(std::signbit(value.b) && !std::signbit(value.a));
}

TEST(Divergence, HasInfiniteDistanceFromNaN) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [a, b] : {std::pair(nan, 1.0), {1.0, nan}}) {
        EXPECT_EQ(value_of(a, b).ulps, not_in_ulps);
        EXPECT_EQ(value_of(a, b).distance, std::numeric_limits<double>::infinity());
    }
    const StateLog same = log_of({{0, 0, {nan, 1}}});
    EXPECT_TRUE(find_divergence(same, same).same());
}

TEST(Divergence, ComparesUpToTheEndOfTheShorterRun) {
    const StateLog longer = log_of({{0, 1, {1, 2}}, {1, 1, {3, 4}}, {4, 1, {5, 6}}});
    const StateLog shorter = log_of({{0, 1, {1, 2}}, {1, 1, {3, 4}}});
    for (const auto& [a, b] : {std::pair(&longer, &shorter), {&shorter, &longer}}) {
        const RunDivergence found = find_divergence(*a, *b);
        EXPECT_TRUE(found.same());
        EXPECT_EQ(std::tuple(found.last_tick, found.last_time, found.bodies),
                  std::tuple(1, 0.125, 1U));
    }
}

using Bodies = std::vector<std::uint32_t>;

// At tick 1 body 2 is only in the first run, and bodies 3 and 4 only in the second. Body 1 differs
// from tick 2 on, body 9 of tick 2 is only in the second.
TEST(Divergence, NamesBodiesThatOnlyOneRunHas) {
    const StateLog a = log_of({{0, 1, {1, 2}}, {1, 1, {3, 4}}, {1, 2, {5, 6}}, {2, 1, {7, 8}}});
    const StateLog b = log_of({{0, 1, {1, 2}},
                               {1, 1, {3, 4}},
                               {1, 3, {5, 6}},
                               {1, 4, {5, 6}},
                               {2, 1, {7, 9}},
                               {2, 9, {0, 0}}});
    const RunDivergence found = find_divergence(a, b);
    ASSERT_TRUE(found.presence && found.value);
    EXPECT_EQ(std::pair(found.presence->tick, found.presence->time), std::pair(1L, 0.125));
    EXPECT_EQ(found.presence->only_a, (Bodies{2}));
    EXPECT_EQ(found.presence->only_b, (Bodies{3, 4}));
    EXPECT_EQ(std::tuple(found.value->tick, found.value->body, found.value->field),
              std::tuple(2, 1U, 1));
    EXPECT_EQ(found.bodies, 5U);
    EXPECT_EQ(find_divergence(b, a).presence->only_a, (Bodies{3, 4}));
    EXPECT_EQ(find_divergence(b, a).bodies, 5U);
}

// All bodies of a tick are missing in one run, at the start or in between.
TEST(Divergence, NamesTheBodiesOfATickThatOnlyOneRunHas) {
    const StateLog whole = log_of({{0, 1, {1, 2}}, {1, 1, {3, 4}}, {2, 1, {5, 6}}});
    for (const std::int64_t missing : {0, 1}) {
        const StateLog part = missing == 0 ? log_of({{1, 1, {3, 4}}, {2, 1, {5, 6}}})
                                           : log_of({{0, 1, {1, 2}}, {2, 1, {5, 6}}});
        const RunDivergence found = find_divergence(part, whole);
        ASSERT_TRUE(found.presence);
        EXPECT_EQ(found.presence->tick, missing);
        EXPECT_EQ(found.presence->time, static_cast<double>(missing) / 8);
        EXPECT_EQ(found.presence->only_a, Bodies());
        EXPECT_EQ(found.presence->only_b, (Bodies{1}));
        EXPECT_FALSE(found.value || found.times);
        EXPECT_EQ(std::pair(found.first_tick, found.last_tick), std::pair(0L, 2L));
    }
}

TEST(Divergence, FindsOtherTimes) {
    const StateLog a = log_of({{0, 1, {1, 2}}, {1, 1, {1, 2}}, {2, 1, {1, 2}}});
    StateLog b = a;
    b.ticks[1].time = 0.25;
    b.ticks[2].time = 0.5;
    const RunDivergence found = find_divergence(a, b);
    ASSERT_TRUE(found.times);
    EXPECT_FALSE(found.same() || found.value || found.presence);
    EXPECT_EQ(std::tuple(found.times->tick, found.times->a, found.times->b),
              std::tuple(1, 0.125, 0.25));
}

TEST(Divergence, RefusesRunsWithOtherAxes) {
    StateLog a = log_of({{0, 1, {1, 2}}});
    StateLog b = log_of({{0, 1, {1, 2, 3, 4}}});
    a.name = "a.csv";
    b.name = "b.csv";
    EXPECT_EQ(line_of_error(Exit::usage, [&] { static_cast<void>(find_divergence(a, b)); }),
              "a.csv has 1 axis and b.csv has 2; give runs of the same scene");
}

/// Two bodies for `last` ticks after tick 5. From there, body 2 is n·(3, 4, 0)·2^-20 m away in the
/// second run, n ticks later, and body 1 four times as far at even n only.
std::pair<StateLog, StateLog> drifting(std::int64_t last) {
    std::vector<Row> rows;
    std::vector<Row> moved_rows;
    for (std::int64_t tick = 0; tick <= 5 + last; ++tick)
        for (const std::uint32_t body : {1U, 2U}) {
            rows.push_back({tick, body, {1, 1, 1, 0, 0, 0}});
            moved_rows.push_back(rows.back());
            const std::int64_t steps = std::max<std::int64_t>(tick - 5, 0);
            const double far = body == 2 ? 1 : steps % 2 == 0 ? 4 : 0;
            const double unit = std::ldexp(far * static_cast<double>(steps), -20);
            moved_rows.back().values[0] += 3 * unit;
            moved_rows.back().values[1] += 4 * unit;
            if (tick >= 5) moved_rows.back().values[5] = 1;
        }
    return {log_of(rows), log_of(moved_rows)};
}

// 1024^(1/10) is 2, so that the steps from the divergence are powers of 2. Between 1 and 2, 2^-20
// are 2^32 ulps, between 2 and 4 they are 2^31.
TEST(Divergence, GrowsAtTicksInEqualRatios) {
    const auto [a, b] = drifting(1024);
    const RunDivergence found = find_divergence(a, b);
    ASSERT_EQ(found.value->tick, 5);
    ASSERT_EQ(found.growth.size(), 12U);
    for (std::size_t i = 0; i < found.growth.size(); ++i) {
        const auto steps = static_cast<double>(i == 0 ? 0 : 1 << (i - 1));
        const bool even = i != 1;
        const RunDivergence::Growth& growth = found.growth[i];
        EXPECT_EQ(growth.tick, 5 + static_cast<std::int64_t>(steps));
        EXPECT_EQ(growth.time, (5 + steps) / 8);
        EXPECT_EQ(growth.body, even ? 1U : 2U);
        EXPECT_EQ(growth.distance, std::ldexp(steps * (even ? 20 : 5), -20));
        EXPECT_EQ(static_cast<double>(growth.ulps), std::ldexp(steps * (even ? 16 : 4), 32));
    }
}

TEST(Divergence, GrowsAtEveryTickOfAShortRun) {
    for (const std::int64_t last : {0, 1, 3}) {
        const auto [a, b] = drifting(last);
        const RunDivergence found = find_divergence(a, b);
        ASSERT_EQ(found.growth.size(), static_cast<std::size_t>(last) + 1);
        for (std::int64_t i = 0; i <= last; ++i)
            EXPECT_EQ(found.growth[static_cast<std::size_t>(i)].tick, 5 + i);
    }
}

// A tick that one run lacks has no distance.
TEST(Divergence, GrowsOverTheTicksOfBothRuns) {
    const StateLog a = log_of({{0, 1, {1, 2}}, {1, 1, {1, 2}}, {2, 1, {1, 2}}, {3, 1, {1, 2}}});
    const StateLog b = log_of({{0, 1, {2, 2}}, {2, 1, {3, 2}}, {3, 2, {3, 2}}});
    const RunDivergence found = find_divergence(a, b);
    ASSERT_EQ(found.growth.size(), 2U);
    EXPECT_EQ(std::tuple(found.growth[1].tick, found.growth[1].distance), std::tuple(2, 2.0));
}

TEST(Ulps, AreStepsOfNextafter) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-30, 30);
    for (int i = 0; i < 300; ++i) {
        const double from = std::exp2(exponent(random)) * (i % 2 == 0 ? 1 : -1);
        const auto single = static_cast<float>(from);
        EXPECT_EQ(ulps_between(from, moved(from, i)), static_cast<std::uint64_t>(i));
        EXPECT_EQ(ulps_between(moved(from, i), from), static_cast<std::uint64_t>(i));
        EXPECT_EQ(ulps_between(single, moved(single, i)), static_cast<std::uint64_t>(i));
        EXPECT_EQ(ulps_between(moved(single, i), single), static_cast<std::uint64_t>(i));
    }
}

// A binade has 2^52 doubles and 2^23 floats. 1 is the start of binade 1023 or 127 above zero.
TEST(Ulps, CountAcrossBinadesAndZero) {
    constexpr std::uint64_t doubles = std::uint64_t{1} << 52;
    constexpr std::uint64_t floats = std::uint64_t{1} << 23;
    constexpr double tiny = std::numeric_limits<double>::denorm_min();
    constexpr float tiny_float = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ(ulps_between(1.0, 2.0), doubles);
    EXPECT_EQ(ulps_between(1.0F, 2.0F), floats);
    EXPECT_EQ(ulps_between(-1.0, 1.0), 2 * 1023 * doubles);
    EXPECT_EQ(ulps_between(1.0F, -1.0F), 2 * 127 * floats);
    EXPECT_EQ(ulps_between(-tiny, tiny), 2U);
    EXPECT_EQ(ulps_between(-0.0, tiny), 1U);
    EXPECT_EQ(ulps_between(tiny_float, -tiny_float), 2U);
    EXPECT_EQ(ulps_between(0.0F, -0.0F), 0U);
    EXPECT_EQ(ulps_between(-0.0, 0.0), 0U);
}

}  // namespace
}  // namespace oiler::test
