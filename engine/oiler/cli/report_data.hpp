// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/core/json.hpp"
#include "oiler/lab/advice/advise.hpp"
#include "oiler/lab/rates.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::cli {

/// The measurements of a scene for its page.
struct ReportResults {
    lab::Tradeoff tradeoff;
    lab::Advice advice;
    lab::Rates rates;
};

/// Returns the data that report.html shows. Computes the stability limits and measures the ledger.
[[nodiscard]] Json report_json(const Scene& scene, const lab::Reference& reference,
                               const lab::Requirements& requirements, const ReportResults& results);

}  // namespace oiler::cli
