// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "oiler/app/stills.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::cli {

/// The places where a trade-off is shown.
struct TradeoffOutput {
    std::filesystem::path out;   ///< folder
    std::filesystem::path json;  ///< empty: no copy; "-": standard output instead of the table
    bool all;                    ///< print all rows
    bool quiet;
};

/// Writes tradeoff.json. Throws Error{io}.
void save(const lab::Tradeoff& tradeoff, const std::filesystem::path& path);

/// Writes the files and the diagrams, prints the table. Throws Error{io}.
void publish(const lab::Tradeoff& tradeoff, const TradeoffOutput& output, Stills& stills);

}  // namespace oiler::cli
