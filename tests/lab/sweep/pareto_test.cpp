// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff.hpp"

#include "support/test.hpp"

namespace oiler::test {
using namespace lab;
namespace {

TradeoffRow made_up(double error, double cost, bool stable = true) {
    TradeoffRow row{.stepping = {&find_method("rk4"), {1}, Precision::double_}};
    row.judgement.stable = stable;
    row.judgement.position_error = error;
    row.ns_per_second = cost;
    return row;
}

// A small generator with few different values, so that there are ties.
class Dice {
public:
    int roll(int sides) {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<int>((state_ >> 33) % static_cast<std::uint64_t>(sides));
    }

private:
    std::uint64_t state_ = 1;
};

using Point = std::pair<double, double>;  // cost, error

std::set<Point> undominated(const std::vector<Point>& points) {
    std::set<Point> best;
    for (const Point& one : points)
        if (std::none_of(points.begin(), points.end(), [&](const Point& other) {
                return other != one && other.first <= one.first && other.second <= one.second;
            }))
            best.insert(one);
    return best;
}

// Errors below the floor count as 0. Unstable and untimed rows do not count.
TEST(Pareto, HasTheRowsThatNoOtherBeats) {
    Dice dice;
    for (int round = 0; round < 300; ++round) {
        Tradeoff tradeoff;
        tradeoff.all_series.resize(2);
        std::vector<Point> points;
        for (int i = dice.roll(15); i > 0; --i) {
            const double error = dice.roll(6) == 0 ? unknown : 1 + dice.roll(5);
            const double cost = dice.roll(6) == 0 ? unknown : 1 + dice.roll(5);
            const bool stable = dice.roll(6) != 0;
            tradeoff.all_series[static_cast<std::size_t>(i % 2)].rows.push_back(
                made_up(error, cost, stable));
            if (stable && !std::isnan(cost))
                points.push_back({cost, std::isnan(error) ? 0 : error});
        }
        const auto front = pareto(tradeoff, time_of);
        std::vector<Point> found;
        for (const TradeoffRow* row : front)
            found.push_back({row->ns_per_second,
                             row->judgement.below_floor() ? 0 : row->judgement.position_error});
        const std::set<Point> expected = undominated(points);
        EXPECT_EQ(found, std::vector<Point>(expected.begin(), expected.end())) << round;
    }
}

TEST(Pareto, UsesTheGivenCost) {
    Tradeoff tradeoff;
    tradeoff.all_series.resize(1);
    tradeoff.all_series[0].rows = {made_up(1, 10), made_up(2, 20)};
    tradeoff.all_series[0].rows[0].judgement.evaluations = 5;
    tradeoff.all_series[0].rows[1].judgement.evaluations = 4;
    EXPECT_EQ(pareto(tradeoff, time_of).size(), 1U);
    EXPECT_EQ(pareto(tradeoff, evaluations_of).size(), 2U);
}

}  // namespace
}  // namespace oiler::test
