// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "oiler/app/console.hpp"
#include "oiler/cli/commands.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::cli {

// What the commands that measure scenes have in common.

/// The scene of a file, as long as it is to be measured.
[[nodiscard]] Scene read_measured(const Measured& measured);

/// The file's name without .toml.
[[nodiscard]] std::string name_of(const Measured& measured);

/// "splitting", "explicit", "all", or names with commas in between. Throws Error{usage}.
[[nodiscard]] std::vector<const Method*> parse_methods(const std::string& words);

/// A file's bytes. Throws Error{io}.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

void print(const std::string& text);

/// Shows a share of work on standard error, in percent.
class Percent {
public:
    Percent(bool quiet, const std::string& what) : progress_(quiet, "% " + what, whole) {}
    void operator()(double share) {
        progress_.show(static_cast<std::int64_t>(std::min(1.0, share) * double{whole}));
    }

private:
    static constexpr std::int64_t whole = 100;
    Progress progress_;
};

/// Climbs what is not done of the trade-off, then times all of it.
void measure_tradeoff(
    Tradeoff& tradeoff, const Scene& scene, const Reference& reference, const SweepPlan& plan,
    bool quiet, const std::function<void(const Tradeoff&)>& ladder_done = [](const auto&) {});

/// Makes the reference of a scene.
[[nodiscard]] Reference measure_reference(const Scene& scene, const SampleTimes& samples,
                                          double wanted, bool quiet);

}  // namespace oiler::cli
