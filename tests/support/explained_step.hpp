// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/bodies.hpp"
#include "oiler/stability/preflight.hpp"
#include "support/test.hpp"

namespace oiler::test {

/// Steps bodies as a world does: a divergence is thrown with its likely cause.
inline void explained_step(Bodies& bodies, const Method& method, const Steps& steps) {
    if (const auto at = bodies.try_step(method, steps))
        fail_diverged(bodies, *at, method, steps,
                      [](std::size_t row) { return std::to_string(row); });
}

/// The warnings for a method with its default damping.
inline std::vector<std::string> warnings(const Bodies& bodies, const Method& method,
                                         const Rate& at) {
    const Steps steps{.rate = at};
    std::vector<std::string> lines;
    for (const Risk& risk : preflight(bodies, method, steps))
        lines.push_back(
            describe(risk, method, steps, [](std::size_t row) { return std::to_string(row); }));
    return lines;
}

/// The number after some words.
inline double number_after(const std::string& line, const std::string& words) {
    const std::size_t at = line.find(words);
    EXPECT_NE(at, std::string::npos) << words << ": " << line;
    return at == std::string::npos ? NAN : std::stod(line.substr(at + words.size()));
}

/// The n of "… rate ≥ n Hz …".
inline std::int64_t rate_in(const std::string& line) {
    const std::string before = "rate ≥ ";
    const std::size_t at = line.find(before);
    EXPECT_NE(at, std::string::npos) << line;
    return at == std::string::npos ? 1 : std::stoll(line.substr(at + before.size()));
}

}  // namespace oiler::test
