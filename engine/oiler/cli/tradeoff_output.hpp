// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "oiler/app/stills.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::cli {

inline constexpr const char* energy_picture = "energy_over_time.png";

/// Returns whether a trade-off may write a file of that name into its folder.
[[nodiscard]] bool is_tradeoff_file(std::string_view name);

/// The places where a trade-off is shown.
struct TradeoffOutput {
    std::filesystem::path out;   ///< folder
    std::filesystem::path json;  ///< empty: no copy; "-": standard output instead of the table
    bool all;                    ///< print all rows
    bool quiet;
};

/// The sweep in a file that is to be replaced; empty if there is none, or for standard output.
/// Throws Error{usage} if the file cannot be read, so that a damaged sweep is not lost.
[[nodiscard]] std::optional<lab::Tradeoff> find_earlier(const std::filesystem::path& path);

/// Writes the file of a sweep into its folder. Throws Error{io}.
void save(const lab::Tradeoff& tradeoff, const std::filesystem::path& path);

/// Removes a picture of an earlier sweep. Throws Error{io}.
void remove_picture(const std::filesystem::path& path);

/// Writes the files and the diagrams, prints the table. Throws Error{io}.
void publish(const lab::Tradeoff& tradeoff, const TradeoffOutput& output, Stills& stills);

}  // namespace oiler::cli
