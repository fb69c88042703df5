// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <functional>

#include "lab/measured_scenes.hpp"
#include "oiler/lab/sweep/tradeoff_file.hpp"
#include "support/test.hpp"

namespace oiler::test {
using namespace lab;

inline SweepPlan small_plan() {
    return {.methods = methods_of({"explicit_euler", "semi_implicit_euler", "velocity_verlet",
                                   "rk4", "exact", "kahan_li8_kdk"}),
            .max_rate = 800};
}

inline Tradeoff started(const MeasuredScene& measured, const SweepPlan& plan) {
    Tradeoff tradeoff = start_tradeoff(measured.scene, measured.reference, plan);
    tradeoff.scene = "test";
    tradeoff.fingerprint = fingerprint(measured.text, measured.scene, plan);
    return tradeoff;
}

// Numbers are compared to the bit. All NaNs are equal.
inline bool same(double a, double b) {
    return (std::isnan(a) && std::isnan(b)) ||
           std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

inline bool same_errors(const Judgement& a, const Judgement& b) {
    return a.stable == b.stable && same(a.position_error, b.position_error) &&
           same(a.step_error, b.step_error) && same(a.velocity_error, b.velocity_error) &&
           same(a.phase_error, b.phase_error) && same(a.energy_drift, b.energy_drift) &&
           same(a.evaluations, b.evaluations);
}

inline std::string named(const Stepping& choice) {
    return std::string(choice.method->name) + " at " + std::to_string(choice.rate.steps);
}

inline void expect_same_errors(const Tradeoff& a, const Tradeoff& b) {
    ASSERT_EQ(a.all_series.size(), b.all_series.size());
    for (std::size_t i = 0; i < a.all_series.size(); ++i) {
        const RateSeries& one = a.all_series[i];
        const RateSeries& other = b.all_series[i];
        EXPECT_EQ(one.method, other.method);
        EXPECT_EQ(one.precision, other.precision);
        EXPECT_EQ(one.end, other.end);
        EXPECT_EQ(one.done, other.done);
        ASSERT_EQ(one.rows.size(), other.rows.size()) << one.method->name;
        for (std::size_t row = 0; row < one.rows.size(); ++row) {
            EXPECT_EQ(one.rows[row].stepping, other.rows[row].stepping);
            EXPECT_TRUE(same_errors(one.rows[row].judgement, other.rows[row].judgement))
                << named(one.rows[row].stepping);
        }
    }
}

inline void expect_usage(const std::function<void()>& wrong, const std::string& words) {
    const std::string line = line_of_error(Exit::usage, [&] { wrong(); });
    EXPECT_TRUE(holds(line, words));
    EXPECT_FALSE(holds(line, "\n"));
}

}  // namespace oiler::test
