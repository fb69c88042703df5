// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace oiler {

/// One limit of a budget, compared with a run.
struct BudgetEntry {
    std::string name;     ///< "position_error"
    double most = 0;      ///< the limit
    double measured = 0;  ///< infinite for an unstable run, `floor` for an error below it
    bool kept = true;
    std::string words{};  ///< the entry as a sentence
    double floor = 0;     ///< the smallest error that can be measured

    /// Whether the error is only known to be below `measured`. Where the floor is 0, it is 0.
    [[nodiscard]] bool is_limit() const { return measured == floor && floor > 0; }
};

}  // namespace oiler
