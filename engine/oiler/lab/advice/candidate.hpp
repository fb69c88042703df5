// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "oiler/lab/advice/advise.hpp"

namespace oiler::lab {

/// A method in one precision, as far as a search has tried its rates.
struct Candidate {
    const Method* method = nullptr;
    Precision precision = Precision::double_;
    std::optional<Damping> damping{};
    double first = unknown;    ///< ns, of the first step of a frame, with the frame's impacts
    double further = unknown;  ///< ns, of each further step of a frame
    std::size_t next = 0;      ///< index of the next rate to try
    Convergence convergence;
    std::int64_t tried = 0;  ///< the last stable rate
    double error = unknown;  ///< m, at that rate
    bool rounded = false;    ///< only round-off causes the error
    bool over = false;

    [[nodiscard]] Stepping at(std::int64_t rate) const {
        return {method, {rate}, precision, damping};
    }
    /// The computing time for a second of the scene at a rate, ns.
    [[nodiscard]] double cost(std::int64_t rate) const;
    /// The lowest rate above that of `row` which can meet the tolerances, by the method's order.
    /// `excess` is that of the row.
    [[nodiscard]] std::int64_t least_rate(const TradeoffRow& row, double excess,
                                          const Requirements& requirements, double extent) const;

private:
    [[nodiscard]] double least_factor(const Judgement& judgement, double excess,
                                      const Requirements& requirements) const;
};

}  // namespace oiler::lab
