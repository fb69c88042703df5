// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/growth.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace oiler::test {
namespace {

using namespace lab;

/// The largest errors up to the ends of 64 parts of 10 s.
template <class Error>
std::vector<double> grown(Error error) {
    std::vector<double> errors;
    double most = 0;
    for (int part = 1; part <= 64; ++part) {
        most = std::max(most, error(10.0 * part / 64));
        errors.push_back(most);
    }
    return errors;
}

TEST(FitGrowth, FindsTheLaw) {
    const auto law = [](auto error) { return fit_growth(grown(error), 10).law; };
    EXPECT_EQ(law([](double t) { return std::abs(std::sin(5 * t)); }), Growth::Law::bounded);
    EXPECT_EQ(law([](double t) { return std::exp(-t) * t; }), Growth::Law::bounded);
    EXPECT_EQ(law([](double t) { return 1e-3 * t; }), Growth::Law::linear);
    EXPECT_EQ(law([](double t) { return 1e-3 * t * std::abs(std::sin(9 * t)); }),
              Growth::Law::linear);
    EXPECT_EQ(law([](double t) { return 1e-5 * t * t; }), Growth::Law::quadratic);
    EXPECT_EQ(law([](double t) { return 1e-9 * std::exp(2 * t); }), Growth::Law::exponential);
    EXPECT_EQ(law([](double) { return 0.0; }), Growth::Law::unfit);
}

// 1 mm after 10 s. 2 mm are passed at twice the time if the error grows with t, at √2 times if with
// t², and ln 2/2 s later if with e^(2t).
TEST(FitGrowth, HoldsUntilTheLawPassesTheTolerance) {
    const auto until = [](auto error) { return fit_growth(grown(error), 10).holds_until(2e-3); };
    EXPECT_NEAR(until([](double t) { return 1e-4 * t; }), 20, 1e-9);
    EXPECT_NEAR(until([](double t) { return 1e-5 * t * t; }), 10 * std::sqrt(2), 1e-9);
    EXPECT_NEAR(until([](double t) { return 1e-3 * std::exp(2 * (t - 10)); }), 10 + std::log(2) / 2,
                1e-9);
    EXPECT_TRUE(std::isinf(until([](double) { return 1e-3; })));
}

}  // namespace
}  // namespace oiler::test
