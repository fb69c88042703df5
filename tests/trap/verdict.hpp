// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "trap/scene.hpp"

namespace oiler::trap {

enum class Verdict {
    honest,        ///< the advice holds
    cannot,        ///< no setting meets the tolerance, and none was found
    refused,       ///< exit 2
    lie,           ///< a told error is less than 0.95 of the truth
    over,          ///< the advice does not meet the tolerance
    false_cannot,  ///< a setting meets the tolerance
    crash,         ///< any other exit, or an answer that cannot be read
};
inline constexpr std::size_t verdict_count = 7;

[[nodiscard]] std::string_view name_of(Verdict verdict);
[[nodiscard]] bool is_failure(Verdict verdict);

struct Judgement {
    Verdict verdict = Verdict::honest;
    std::string words{};
};

/// Steps what was advised and compares it with the truth.
[[nodiscard]] Judgement judge(const Trap& trap, const Answer& answer);

}  // namespace oiler::trap
